import { BufferAttribute, BufferGeometry, DynamicDrawUsage, GLSL3, LineSegments, ShaderMaterial } from 'three';
import { rgb, styleColour } from '../colour/palette.ts';
import { classOf, heightOf, isGhost, RECORD_WORDS, styleOf, twinOf } from '../protocol/frame.ts';
import type { Point } from '../protocol/scene.ts';
import type { Trails as Which } from '../state.ts';
import type { Traffic } from '../traffic/traffic.ts';
import { AS_GHOSTS, shown, SHOWN_CHUNK } from '../vehicles/shown.ts';

const CAPACITY = 120_000;
const SHOWN_FOR_S = 40;
const EVERY_S = 0.45;
/** No vehicle goes so far between two points of its trail; one that did was put elsewhere. */
const LONGEST_M = 150;
const VALUES = 4;
const LIFT_M = 0.25;

const VERTEX = /* glsl */ `
${SHOWN_CHUNK}
uniform float now;
/** x, y, z, time */
in vec4 spot;
/** red, green, blue, and 1 for a vehicle of the twin */
in vec4 tone;
out vec3 paint;
out float strength;
void main() {
  float age = now - spot.w;
  bool isOfTwin = tone.a > 0.5;
  bool isHidden = age < 0.0 || isLeftOut(isOfTwin) || (isOfTwin && ${AS_GHOSTS});
  strength = isHidden ? 0.0 : 1.0 - age / ${SHOWN_FOR_S}.0;
  paint = tone.rgb;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(spot.xyz, 1.0);
}
`;

const FRAGMENT = /* glsl */ `
in vec3 paint;
in float strength;
out vec4 colour;
void main() {
  if (strength <= 0.0) discard;
  colour = vec4(paint, 0.85 * strength);
}
`;

/** Lines behind vehicles: where they were in the last seconds, in the colours of their styles. */
export class TrailLines {
  readonly mesh: LineSegments<BufferGeometry, ShaderMaterial>;
  private readonly spots = new BufferAttribute(new Float32Array(CAPACITY * 2 * VALUES), VALUES);
  private readonly tones = new BufferAttribute(new Float32Array(CAPACITY * 2 * VALUES), VALUES);
  private readonly palette = Array.from({ length: 64 }, (_, style) => rgb(styleColour(style)));
  private last = new Float64Array(0);
  private written = 0;
  private lastTime_s = -Infinity;

  constructor() {
    const geometry = new BufferGeometry();
    this.spots.setUsage(DynamicDrawUsage);
    this.tones.setUsage(DynamicDrawUsage);
    geometry.setAttribute('spot', this.spots);
    geometry.setAttribute('tone', this.tones);
    geometry.setDrawRange(0, 0);
    const material = new ShaderMaterial({
      glslVersion: GLSL3,
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms: { ...shown, now: { value: 0 } },
      transparent: true,
      depthWrite: false,
    });
    this.mesh = new LineSegments(geometry, material);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = 1;
    this.mesh.visible = false;
  }

  clear(): void {
    this.written = 0;
    this.lastTime_s = -Infinity;
    this.last.fill(NaN);
    this.mesh.geometry.setDrawRange(0, 0);
  }

  /** Adds a piece to the trails of all or of the chosen vehicles, if enough time has gone by. */
  add(traffic: Traffic, zero: Point, which: Which, chosen: string[]): void {
    const { next } = traffic.playback;
    this.mesh.visible = which !== 'none';
    if (!next || which === 'none') return;
    if (next.time_s < this.lastTime_s) this.clear();
    if (next.time_s - this.lastTime_s < EVERY_S) return;
    this.lastTime_s = next.time_s;
    this.remember(next.slotCount);
    const from = this.written;
    const one = (slot: number) => this.extend(traffic, slot, zero);
    if (which === 'all') for (let slot = 0; slot < next.slotCount; slot += 1) one(slot);
    else for (const id of chosen) [id, twinOf(id)].forEach((either) => one(traffic.slots.find(either, -1)));
    this.send(from);
  }

  update(time_s: number): void {
    this.mesh.material.uniforms.now.value = time_s;
  }

  private extend(traffic: Traffic, slot: number, zero: Point): void {
    const { next } = traffic.playback;
    if (!next || slot < 0 || slot >= next.slotCount) return;
    const at = slot * 3;
    if (classOf(next.words, slot) === 0) {
      this.last[at] = NaN;
      return;
    }
    const x = next.floats[slot * RECORD_WORDS] + next.origin[0] - zero[0];
    const y = next.floats[slot * RECORD_WORDS + 1] + next.origin[1] - zero[1];
    const z = heightOf(next.words, slot) + next.origin[2] - zero[2] + LIFT_M;
    const [lx, ly, lz] = [this.last[at], this.last[at + 1], this.last[at + 2]];
    this.last[at] = x;
    this.last[at + 1] = y;
    this.last[at + 2] = z;
    if (!(Math.abs(x - lx) + Math.abs(y - ly) < LONGEST_M) || traffic.slots.hasJustCome(slot)) return;
    const [red, green, blue] = this.palette[styleOf(next.words, slot)];
    const vertex = (this.written % CAPACITY) * 2;
    this.spots.setXYZW(vertex, lx, ly, lz, next.time_s - EVERY_S);
    this.spots.setXYZW(vertex + 1, x, y, z, next.time_s);
    const isOfTwin = isGhost(next.words, slot) ? 1 : 0;
    this.tones.setXYZW(vertex, red, green, blue, isOfTwin);
    this.tones.setXYZW(vertex + 1, red, green, blue, isOfTwin);
    this.written += 1;
  }

  /** Sends only what was added, unless it went around the end of the buffer. */
  private send(from: number): void {
    const added = this.written - from;
    if (added === 0) return;
    const start = from % CAPACITY;
    for (const attribute of [this.spots, this.tones]) {
      attribute.clearUpdateRanges();
      const size = 2 * attribute.itemSize;
      if (start + added <= CAPACITY) attribute.addUpdateRange(start * size, added * size);
      attribute.needsUpdate = true;
    }
    this.mesh.geometry.setDrawRange(0, Math.min(this.written, CAPACITY) * 2);
  }

  private remember(slots: number): void {
    if (slots * 3 <= this.last.length) return;
    const grown = new Float64Array(slots * 6).fill(NaN);
    grown.set(this.last);
    this.last = grown;
  }
}
