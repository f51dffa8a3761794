import { classOf, RECORD_WORDS, type Frame } from '../protocol/frame.ts';

const CENTIMETRES = 100;

/** Who is in which slot, and how large it is. A slot keeps its vehicle for as long as it is in view. */
export class Slots {
  /** Length in the low half and width in the high half, in centimetres. */
  sizes = new Uint32Array(0);
  private low = new Uint32Array(0);
  private high = new Int32Array(0);
  private cameWith = new Uint32Array(0);
  private taken = 0;
  private present: Frame | null = null;

  /** Takes the vehicles that have come with the next frame. */
  take(frame: Frame): void {
    this.taken += 1;
    this.present = frame;
    this.grow(frame.slotCount);
    for (let at = 0; at < frame.came.length; at += RECORD_WORDS) {
      const slot = frame.came[at];
      this.low[slot] = frame.came[at + 1];
      this.high[slot] = frame.came[at + 2];
      this.sizes[slot] = frame.came[at + 3];
      this.cameWith[slot] = this.taken;
    }
  }

  /** Whether the vehicle of a slot has come with the frame that was taken last. */
  hasJustCome(slot: number): boolean {
    return this.cameWith[slot] === this.taken;
  }

  id(slot: number): string {
    return ((BigInt(this.high[slot]) << 32n) | BigInt(this.low[slot])).toString();
  }

  /** The slot of a vehicle that is in view, or -1. `guess` is tried first. */
  find(id: string, guess: number): number {
    const wanted = BigInt(id);
    const low = Number(BigInt.asUintN(32, wanted));
    const high = Number(BigInt.asIntN(32, wanted >> 32n));
    if (guess >= 0 && this.holds(guess, low, high)) return guess;
    const count = this.present?.slotCount ?? 0;
    for (let slot = 0; slot < count; slot += 1) if (this.holds(slot, low, high)) return slot;
    return -1;
  }

  /** A slot that a vehicle has left still has its id, but is empty. */
  private holds(slot: number, low: number, high: number): boolean {
    const { present } = this;
    if (this.low[slot] !== low || this.high[slot] !== high || !present) return false;
    return slot < present.slotCount && classOf(present.words, slot) > 0;
  }

  length(slot: number): number {
    return (this.sizes[slot] & 0xffff) / CENTIMETRES;
  }

  width(slot: number): number {
    return (this.sizes[slot] >>> 16) / CENTIMETRES;
  }

  private grow(count: number): void {
    if (count <= this.low.length) return;
    const capacity = Math.max(count, this.low.length * 2, 256);
    const grown = new Uint32Array(capacity);
    grown.set(this.low);
    this.low = grown;
    const grownHigh = new Int32Array(capacity);
    grownHigh.set(this.high);
    this.high = grownHigh;
    const grownSizes = new Uint32Array(capacity);
    grownSizes.set(this.sizes);
    this.sizes = grownSizes;
    const grownCame = new Uint32Array(capacity);
    grownCame.set(this.cameWith);
    this.cameWith = grownCame;
  }
}
