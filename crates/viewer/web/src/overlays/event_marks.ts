import { DynamicDrawUsage, GLSL3, InstancedBufferAttribute, InstancedBufferGeometry, Mesh, ShaderMaterial, Float32BufferAttribute } from 'three';
import { lookOf, SHAPES } from '../colour/events.ts';
import { rgb } from '../colour/palette.ts';
import type { TrafficEvent } from '../protocol/messages.ts';
import type { Point } from '../protocol/scene.ts';
import { atmosphere } from '../stage/atmosphere.ts';
import { shown, SHOWN_CHUNK } from '../vehicles/shown.ts';

const CAPACITY = 4096;
export const SHOWN_FOR_S = 60;
const IMPORTANT_SIZE = 1.6;
const LIFT_M = 1.2;

const VERTEX = /* glsl */ `
${SHOWN_CHUNK}
uniform float pixel;
uniform float now;
in vec3 spot;
in vec3 tone;
/** x: shape, y: time, z: size */
in vec3 mark;
out vec2 place;
out vec3 paint;
out float strength;
flat out int shape;
void main() {
  float age = now - mark.y;
  strength = age < 0.0 || age > ${SHOWN_FOR_S}.0 ? 0.0 : 1.0 - age / ${SHOWN_FOR_S}.0 * 0.75;
  vec4 seen = modelViewMatrix * vec4(spot, 1.0);
  float radius = max(0.9, 7.0 * pixel * -seen.z) * mark.z;
  seen.xy += position.xy * radius * 1.3;
  place = position.xy * 1.3;
  paint = tone;
  shape = int(mark.x + 0.5);
  // What happens in the twin is not told.
  gl_Position = strength > 0.0 && !isLeftOut(false) ? projectionMatrix * seen : vec4(2.0, 2.0, 2.0, 1.0);
}
`;

const FRAGMENT = /* glsl */ `
in vec2 place;
in vec3 paint;
in float strength;
flat in int shape;
out vec4 colour;

/** How far a place is inside of the outline; negative outside. */
float inside() {
  vec2 side = abs(place);
  if (shape == 1) return 1.1 - side.x - side.y;
  if (shape == 2) return 0.82 - max(side.x, side.y);
  if (shape == 3) {
    float turn = atan(place.x, place.y);
    float wave = abs(fract(turn / 6.2832 * 5.0 + 0.5) - 0.5) * 2.0;
    return mix(0.62, 1.2, 1.0 - wave) - length(place) - 0.12;
  }
  if (shape == 4) return min(place.y + 0.72, (0.95 - place.y) * 0.5 - side.x + 0.08);
  if (shape == 5) return min(1.0 - length(place), length(place) - 0.45);
  return 0.95 - length(place);
}

void main() {
  float depth = inside();
  float blur = fwidth(depth) + 1e-4;
  float share = smoothstep(-blur, blur, depth);
  float rim = 1.0 - smoothstep(0.12, 0.12 + blur * 2.0, depth);
  colour = vec4(mix(paint, vec3(1.0), rim), share * strength);
  if (colour.a < 0.02) discard;
}
`;

/** Marks on the road where something has happened in the last minute. */
export class EventMarks {
  readonly mesh: Mesh<InstancedBufferGeometry, ShaderMaterial>;
  private readonly spots = new InstancedBufferAttribute(new Float32Array(CAPACITY * 3), 3);
  private readonly tones = new InstancedBufferAttribute(new Float32Array(CAPACITY * 3), 3);
  private readonly marks = new InstancedBufferAttribute(new Float32Array(CAPACITY * 3), 3);
  private written = 0;

  constructor() {
    const geometry = new InstancedBufferGeometry();
    geometry.setAttribute('position', new Float32BufferAttribute([-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0], 3));
    geometry.setIndex([0, 1, 2, 0, 2, 3]);
    for (const attribute of [this.spots, this.tones, this.marks]) attribute.setUsage(DynamicDrawUsage);
    geometry.setAttribute('spot', this.spots);
    geometry.setAttribute('tone', this.tones);
    geometry.setAttribute('mark', this.marks);
    geometry.instanceCount = 0;
    const material = new ShaderMaterial({
      glslVersion: GLSL3,
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms: { ...atmosphere, ...shown, now: { value: 0 } },
      transparent: true,
      depthTest: false,
      depthWrite: false,
    });
    this.mesh = new Mesh(geometry, material);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = 4;
    this.mesh.visible = false;
  }

  show(isShown: boolean): void {
    this.mesh.visible = isShown;
  }

  clear(): void {
    this.written = 0;
    this.mesh.geometry.instanceCount = 0;
  }

  /** Adds events; the oldest marks give way. `zero` is the point of the map where the page has its zero. */
  add(events: TrafficEvent[], zero: Point, heightAt: (x: number, y: number) => number): void {
    for (const event of events) {
      const at = this.written % CAPACITY;
      const [x, y] = [event.x - zero[0], event.y - zero[1]];
      const look = lookOf(event);
      this.spots.setXYZ(at, x, y, heightAt(x, y) + LIFT_M);
      this.tones.setXYZ(at, ...rgb(look.colour));
      this.marks.setXYZ(at, SHAPES.indexOf(look.shape), event.time_s, event.kind === 'lane_change' ? 1 : IMPORTANT_SIZE);
      this.written += 1;
    }
    this.mesh.geometry.instanceCount = Math.min(this.written, CAPACITY);
    for (const attribute of [this.spots, this.tones, this.marks]) attribute.needsUpdate = true;
  }

  update(time_s: number): void {
    this.mesh.material.uniforms.now.value = time_s;
  }
}
