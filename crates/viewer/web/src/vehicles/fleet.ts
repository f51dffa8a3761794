import { DataTexture, GLSL3, Group, ShaderMaterial, Vector3, type IUniform, type PerspectiveCamera } from 'three';
import { PHASES, rgb, styleColour, STYLE_COLOUR_COUNT } from '../colour/palette.ts';
import { byteColours, type VehicleColour } from '../colour/scales.ts';
import { HEIGHT_STEPS_PER_METRE, RECORD_WORDS, type Frame } from '../protocol/frame.ts';
import type { Point } from '../protocol/scene.ts';
import { atmosphere } from '../stage/atmosphere.ts';
import type { Playback } from '../traffic/playback.ts';
import type { Slots } from '../traffic/slots.ts';
import { AURA_FRAGMENT, AURA_VERTEX, auraForm } from './aura.ts';
import { Batch } from './batch.ts';
import { busBody, carBody, flatBody, motorcycleBody, otherBody, truckBody } from './bodies.ts';
import { BODY_FRAGMENT, BODY_VERTEX } from './shader.ts';
import { shown } from './shown.ts';

/** A vehicle that is shown shorter than this, in pixels, becomes a rectangle. */
const LEAST_BODY_PIXELS = 9;
const TYPICAL_LENGTH_M = 5;
const FLAT_LEAST_PIXELS = 3.2;
/** How many vehicles have bodies at most. A slow machine draws fewer. */
const MOST_BODIES = 2500;
const FEWEST_BODIES = 250;
const SLOW_FPS = 24;
const QUICK_FPS = 45;

/** All vehicles in view: a batch for each form, one for those far away, and one for what lies on the road around them. */
export class Fleet {
  readonly group = new Group();
  private readonly shared: Record<string, IUniform> = {
    ...atmosphere,
    ...shown,
    beforeShift: { value: new Vector3() },
    afterShift: { value: new Vector3() },
    mixing: { value: 1 },
    colourBy: { value: 0 },
    styleColours: { value: Array.from({ length: STYLE_COLOUR_COUNT }, (_, style) => new Vector3(...rgb(styleColour(style)))) },
    phaseColours: { value: PHASES.map(({ colour }) => new Vector3(...rgb(colour))) },
    byteColours: { value: new DataTexture(byteColours('speed'), 256, 1) },
  };
  private readonly bodies: Batch[];
  private readonly flat: Batch;
  private readonly aura: Batch;
  private readonly standing = new Uint32Array(RECORD_WORDS);
  private readonly standingPlace = new Float32Array(this.standing.buffer);
  private budget = MOST_BODIES;
  private nearShare = 1;

  constructor() {
    const body = this.material(BODY_VERTEX, BODY_FRAGMENT, { leastPixels: { value: 0 }, isFlat: { value: 0 } });
    const far = this.material(BODY_VERTEX, BODY_FRAGMENT, { leastPixels: { value: FLAT_LEAST_PIXELS }, isFlat: { value: 1 } });
    const around = this.material(AURA_VERTEX, AURA_FRAGMENT, {});
    around.transparent = true;
    around.depthWrite = false;
    around.polygonOffset = true;
    around.polygonOffsetFactor = -2;
    around.polygonOffsetUnits = -8;
    this.bodies = [carBody(), truckBody(), busBody(), motorcycleBody(), otherBody()].map((form) => new Batch(form, body));
    this.flat = new Batch(flatBody(), far);
    this.aura = new Batch(auraForm(), around);
    this.aura.mesh.renderOrder = -1;
    for (const { mesh } of [...this.bodies, this.flat, this.aura]) {
      mesh.visible = false;
      this.group.add(mesh);
    }
  }

  /** Chooses what the colours of vehicles tell. */
  colourBy(what: VehicleColour): void {
    const modes: Record<VehicleColour, number> = { style: 0, speed: 1, state: 2, desire: 3, delay: 3, since_change: 3, difference: 3 };
    this.shared.colourBy.value = modes[what];
    if (what === 'style' || what === 'state') return;
    const old = this.shared.byteColours.value as DataTexture;
    old.dispose();
    const texture = new DataTexture(byteColours(what), 256, 1);
    texture.needsUpdate = true;
    this.shared.byteColours.value = texture;
  }

  /** Sorts the vehicles of the present two frames into near and far ones. `zero` is the point of the map where the scene has its zero. */
  sort(playback: Playback, slots: Slots, camera: PerspectiveCamera, zero: Point, fps: number): void {
    const { previous, next } = playback;
    const batches = [...this.bodies, this.flat, this.aura];
    const reach = this.reach(fps);
    for (const batch of batches) batch.clear();
    if (next) {
      this.fill(previous, next, slots, [camera.position.x + zero[0], camera.position.y + zero[1], camera.position.z + zero[2]], reach);
    }
    for (const batch of batches) batch.send();
  }

  /** Sets where vehicles are between the two frames. Positions are measured from a point near the camera. */
  place(playback: Playback, anchor: Vector3, zero: Point): void {
    this.group.position.copy(anchor);
    const shift = (frame: Frame | null, uniform: IUniform) => {
      if (!frame) return;
      const [x, y, z] = frame.origin;
      (uniform.value as Vector3).set(x - zero[0] - anchor.x, y - zero[1] - anchor.y, z - zero[2] - anchor.z);
    };
    shift(playback.previous ?? playback.next, this.shared.beforeShift);
    shift(playback.next, this.shared.afterShift);
    this.shared.mixing.value = playback.mix();
  }

  private material(vertexShader: string, fragmentShader: string, own: Record<string, IUniform>): ShaderMaterial {
    return new ShaderMaterial({
      glslVersion: GLSL3,
      vertexShader,
      fragmentShader,
      uniforms: { ...this.shared, ...own },
      side: 2,
    });
  }

  /** Up to which distance vehicles have bodies. */
  private reach(fps: number): number {
    if (fps < SLOW_FPS) this.budget = Math.max(this.budget * 0.9, FEWEST_BODIES);
    else if (fps > QUICK_FPS) this.budget = Math.min(this.budget * 1.05, MOST_BODIES);
    const drawn = this.bodies.reduce((sum, batch) => sum + batch.count, 0);
    this.nearShare = drawn > this.budget ? this.nearShare * 0.85 : Math.min(this.nearShare * 1.05, 1);
    return (TYPICAL_LENGTH_M / (LEAST_BODY_PIXELS * atmosphere.pixel.value)) * this.nearShare;
  }

  private fill(previous: Frame | null, next: Frame, slots: Slots, eye: Point, reach: number): void {
    const { words, floats, origin } = next;
    const [ex, ey, ez] = [eye[0] - origin[0], eye[1] - origin[1], eye[2] - origin[2]];
    const square = reach * reach;
    const known = previous ? previous.slotCount : 0;
    for (let slot = 0; slot < next.slotCount; slot += 1) {
      const at = slot * RECORD_WORDS;
      const form = (words[at + 3] >>> 16) & 7;
      if (form === 0) continue;
      const isNew = !previous || slot >= known || slots.hasJustCome(slot);
      if (isNew) this.standStill(next, previous ?? next, at);
      const before = isNew ? this.standing : previous.words;
      const earlier = isNew ? 0 : at;
      const dx = floats[at] - ex;
      const dy = floats[at + 1] - ey;
      const near = dx * dx + dy * dy + ez * ez < square;
      const size = slots.sizes[slot];
      (near ? this.bodies[Math.min(form, 5) - 1] : this.flat).add(before, earlier, words, at, size);
      if (near) this.aura.add(before, earlier, words, at, size);
    }
  }

  /** A vehicle that has just come stands where it came: its record, measured from the origin of the frame before. */
  private standStill(next: Frame, previous: Frame, at: number): void {
    this.standing.set(next.words.subarray(at, at + RECORD_WORDS));
    this.standingPlace[0] += next.origin[0] - previous.origin[0];
    this.standingPlace[1] += next.origin[1] - previous.origin[1];
    this.standing[2] += Math.round((next.origin[2] - previous.origin[2]) * HEIGHT_STEPS_PER_METRE) << 16;
  }
}
