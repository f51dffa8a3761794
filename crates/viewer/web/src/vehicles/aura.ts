import type { BufferGeometry } from 'three';
import { MeshBuilder } from '../road/mesh_builder.ts';
import { RECORD_CHUNK } from './shader.ts';

const SHADOW = 0;
const BEAM = 1;
const BRAKES = 2;
const LEFT = 3;
const RIGHT = 4;
const USER = 5;
const RECORDED = 6;

/** What lies on the road around a vehicle: its shadow, its light, and rings that tell who drives it. */
export function auraForm(): BufferGeometry {
  const builder = new MeshBuilder({ position: 3, anchor: 2, kind: 1, inside: 2 });
  const quad = (kind: number, x: [number, number, number, number], y: [number, number, number, number], lift: number) => {
    const corner = (u: 0 | 1, v: 0 | 1) =>
      builder.vertex({
        position: [x[u * 2 + 1], y[v * 2 + 1], lift],
        anchor: [x[u * 2], y[v * 2]],
        kind: [kind],
        inside: [u * 2 - 1, v * 2 - 1],
      });
    builder.quad(corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1));
  };
  quad(SHADOW, [-0.5, -0.35, 0.5, 0.35], [-0.5, -0.35, 0.5, 0.35], 0.03);
  quad(BEAM, [0.5, 0, 0.5, 24], [-0.5, -1.6, 0.5, 1.6], 0.04);
  quad(BRAKES, [-0.5, -2.2, -0.5, 0.3], [-0.5, -0.7, 0.5, 0.7], 0.05);
  quad(LEFT, [-0.5, -0.6, 0.5, 0.6], [0.5, -0.3, 0.5, 1.1], 0.05);
  quad(RIGHT, [-0.5, -0.6, 0.5, 0.6], [-0.5, -1.1, -0.5, 0.3], 0.05);
  quad(USER, [-0.5, -0.9, 0.5, 0.9], [-0.5, -0.9, 0.5, 0.9], 0.06);
  quad(RECORDED, [-0.5, -0.45, 0.5, 0.45], [-0.5, -0.45, 0.5, 0.45], 0.06);
  return builder.geometry();
}

export const AURA_VERTEX = /* glsl */ `
${RECORD_CHUNK}
uniform float night;
uniform float blink;
in vec2 anchor;
in float kind;
in vec2 inside;
out vec2 place;
out float depth;
flat out vec2 halfSize;
flat out int what;

bool isShown(int kind, uint flags) {
  // A ghost has no light and no shadow.
  if ((flags & 192u) == 192u) return false;
  if (kind == ${BEAM}) return night > 0.5;
  if (kind == ${BRAKES}) return (flags & 8u) != 0u;
  if (kind == ${LEFT}) return (flags & 16u) != 0u && blink > 0.5;
  if (kind == ${RIGHT}) return (flags & 32u) != 0u && blink > 0.5;
  if (kind == ${USER}) return (flags & 64u) != 0u;
  if (kind == ${RECORDED}) return (flags & 128u) != 0u;
  return true;
}

void main() {
  what = int(kind + 0.5);
  place = inside;
  vec2 extent = sizeNow();
  halfSize = extent * 0.5 + 0.9;
  vec2 ahead = aheadNow();
  vec2 local = position.xy + anchor * extent;
  vec3 point = centreNow() + vec3(ahead * local.x + vec2(-ahead.y, ahead.x) * local.y, position.z);
  vec4 seen = modelViewMatrix * vec4(point, 1.0);
  depth = -seen.z;
  gl_Position = isShown(what, flagsNow()) && !isLeftOut(isOfTwin()) ? projectionMatrix * seen : vec4(2.0, 2.0, 2.0, 1.0);
}
`;

export const AURA_FRAGMENT = /* glsl */ `
uniform vec2 fogRange;
uniform float night;
in vec2 place;
in float depth;
flat in vec2 halfSize;
flat in int what;
out vec4 colour;

float rim(float width) {
  vec2 fromEdge = (1.0 - abs(place)) * halfSize;
  return step(min(fromEdge.x, fromEdge.y), width);
}

vec4 tone() {
  if (what == ${SHADOW}) {
    vec2 soft = smoothstep(vec2(1.0), vec2(0.72), abs(place));
    return vec4(0.0, 0.0, 0.02, 0.34 * soft.x * soft.y);
  }
  if (what == ${BEAM}) {
    float way = place.x * 0.5 + 0.5;
    float spread = abs(place.y) / mix(0.45, 1.0, way);
    float glow = (1.0 - smoothstep(0.3, 1.0, spread)) * (1.0 - way) * (1.0 - way) * smoothstep(0.0, 0.06, way);
    return vec4(1.0, 0.95, 0.8, 0.34 * glow);
  }
  float round_ = max(1.0 - length(place), 0.0);
  if (what == ${BRAKES}) return vec4(1.0, 0.12, 0.08, mix(0.55, 0.8, night) * round_);
  if (what == ${LEFT} || what == ${RIGHT}) {
    float ends = smoothstep(0.25, 0.8, abs(place.x)) * (1.0 - smoothstep(0.85, 1.0, abs(place.x)));
    return vec4(1.0, 0.68, 0.05, 0.85 * ends * (1.0 - smoothstep(0.2, 1.0, abs(place.y))));
  }
  if (what == ${USER}) return vec4(1.0, 0.16, 0.72, 0.95 * rim(0.28));
  vec2 along = abs(place) * halfSize;
  float dash = step(0.5, fract(max(along.x, along.y) / 1.1));
  return vec4(1.0, 1.0, 1.0, 0.9 * rim(0.16) * dash);
}

void main() {
  colour = tone();
  colour.a *= 1.0 - smoothstep(fogRange.x, fogRange.y, depth);
  if (colour.a < 0.01) discard;
}
`;
