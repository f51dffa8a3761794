import { classOf, headingOf, heightOf, isGhost, readFrame, RECORD_WORDS, SAME, twinOf, valueOf, type Frame } from '../protocol/frame.ts';
import type { Point } from '../protocol/scene.ts';
import { Playback } from './playback.ts';
import { Slots } from './slots.ts';

/** Where a vehicle is at the present time, in the coordinates of the page. */
export interface Placed {
  slot: number;
  x: number;
  y: number;
  z: number;
  heading: number;
  length: number;
  width: number;
  form: number;
}

/** Margin around a vehicle within which a click still means it. */
const CLICK_MARGIN_M = 0.8;

/** The vehicles in view, now. */
export class Traffic {
  readonly playback = new Playback();
  slots = new Slots();
  private readonly guesses = new Map<string, number>();

  /** `zero` is the point of the map at which the page has its zero. */
  constructor(private readonly zero: Point) {}

  push(bytes: ArrayBuffer, wall_s: number): void {
    this.playback.push(readFrame(bytes), wall_s);
  }

  /** Moves on to the present. It returns the frame that has become the next one, if any. */
  advance(wall_s: number): Frame | null {
    const frame = this.playback.advance(wall_s);
    if (frame) this.slots.take(frame);
    return frame;
  }

  /** Forgets all vehicles; the next frame brings them anew. */
  clear(): void {
    this.playback.clear();
    this.slots = new Slots();
    this.guesses.clear();
  }

  /** How many vehicles of the traffic or of its twin are in view. */
  count(isInTwin: boolean): number {
    return this.countWhere((words, slot) => isGhost(words, slot) === isInTwin);
  }

  /** How many vehicles in view, of both, are not where their twins are. Their colours must tell it. */
  countDifferent(): number {
    return this.countWhere((words, slot) => valueOf(words, slot) > SAME);
  }

  private countWhere(test: (words: Uint32Array, slot: number) => boolean): number {
    const { next } = this.playback;
    let vehicles = 0;
    for (let slot = 0; next && slot < next.slotCount; slot += 1) vehicles += classOf(next.words, slot) > 0 && test(next.words, slot) ? 1 : 0;
    return vehicles;
  }

  locate(id: string): Placed | null {
    const slot = this.slots.find(id, this.guesses.get(id) ?? -1);
    this.guesses.set(id, slot);
    return slot < 0 ? null : this.placed(slot);
  }

  placed(slot: number): Placed | null {
    const { previous, next } = this.playback;
    if (!next || slot >= next.slotCount || classOf(next.words, slot) === 0) return null;
    const isNew = !previous || slot >= previous.slotCount || this.slots.hasJustCome(slot);
    const from = isNew ? next : previous;
    const mix = this.playback.mix();
    const at = (frame: Frame, axis: number): number => {
      const part = axis === 2 ? heightOf(frame.words, slot) : frame.floats[slot * RECORD_WORDS + axis];
      return part + frame.origin[axis] - this.zero[axis];
    };
    const between = (axis: number): number => at(from, axis) + (at(next, axis) - at(from, axis)) * mix;
    const before = headingOf(from.words, slot);
    const turned = headingOf(next.words, slot) - before;
    return {
      slot,
      x: between(0),
      y: between(1),
      z: between(2),
      heading: before + Math.atan2(Math.sin(turned), Math.cos(turned)) * mix,
      length: this.slots.length(slot),
      width: this.slots.width(slot),
      form: classOf(next.words, slot),
    };
  }

  /** All vehicles in view, with their places. */
  all(): { id: string; x: number; y: number }[] {
    const slots = Array.from({ length: this.playback.next?.slotCount ?? 0 }, (_, slot) => this.placed(slot));
    return slots.flatMap((it) => (it ? [{ id: this.slots.id(it.slot), x: it.x, y: it.y }] : []));
  }

  /** The id of the vehicle of the traffic or of its twin at a point of the road, or of the nearest one within a reach. */
  pick(x: number, y: number, reach: number, isInTwin: boolean): string | null {
    const { next } = this.playback;
    if (!next) return null;
    let best = { slot: -1, distance: Infinity };
    const [cx, cy] = [x + this.zero[0] - next.origin[0], y + this.zero[1] - next.origin[1]];
    const furthest = reach + 60;
    for (let slot = 0; slot < next.slotCount; slot += 1) {
      const roughX = Math.abs(next.floats[slot * RECORD_WORDS] - cx);
      const roughY = Math.abs(next.floats[slot * RECORD_WORDS + 1] - cy);
      if (roughX > furthest || roughY > furthest || isGhost(next.words, slot) !== isInTwin) continue;
      const vehicle = this.placed(slot);
      if (!vehicle) continue;
      const distance = distanceTo(vehicle, x, y);
      if (distance < best.distance) best = { slot, distance };
    }
    if (best.distance > Math.max(reach, CLICK_MARGIN_M)) return null;
    // A vehicle has the same id in both.
    const id = this.slots.id(best.slot);
    return isInTwin ? twinOf(id) : id;
  }
}

/** From a point to the outline of a vehicle; 0 inside. */
function distanceTo({ x, y, heading, length, width }: Placed, px: number, py: number): number {
  const [dx, dy] = [px - x, py - y];
  const along = Math.abs(dx * Math.cos(heading) + dy * Math.sin(heading)) - length / 2;
  const across = Math.abs(dy * Math.cos(heading) - dx * Math.sin(heading)) - width / 2;
  return Math.hypot(Math.max(along, 0), Math.max(across, 0));
}
