import { PATTERNS } from '../colour/palette.ts';
import { LIGHT_CHUNK } from '../stage/atmosphere.ts';
import { PART } from './bodies.ts';
import { AS_GHOSTS, SHOWN_CHUNK } from './shown.ts';

/** Reads the two records of an instance: where it is now, and what its flags say. */
export const RECORD_CHUNK = /* glsl */ `
${SHOWN_CHUNK}
in uvec4 before;
in uvec4 after;
in uint size;
uniform vec3 beforeShift;
uniform vec3 afterShift;
uniform float mixing;

const float TURN = 6.283185307179586;

vec3 centreOf(uvec4 record, vec3 shift) {
  float height = float(record.z >> 16u) / 20.0 - 1638.4;
  return vec3(uintBitsToFloat(record.x), uintBitsToFloat(record.y), height) + shift;
}

vec3 centreNow() {
  return mix(centreOf(before, beforeShift), centreOf(after, afterShift), mixing);
}

/** The direction ahead; it turns the short way round. */
vec2 aheadNow() {
  int from = int(before.z & 65535u);
  int turned = int(after.z & 65535u) - from;
  turned = turned > 32767 ? turned - 65536 : (turned < -32768 ? turned + 65536 : turned);
  float angle = (float(from) + float(turned) * mixing) / 65536.0 * TURN;
  return vec2(cos(angle), sin(angle));
}

vec2 sizeNow() {
  return vec2(float(size & 65535u), float(size >> 16u)) / 100.0;
}

bool isOfTwin() {
  return (after.w & 0xc00000u) == 0xc00000u;
}

/** The vehicles of the twin are ghosts, or else usual ones, which nobody records or drives. */
uint flagsNow() {
  uint flags = (after.w >> 16u) & 255u;
  return isOfTwin() && !(${AS_GHOSTS}) ? flags & 63u : flags;
}
`;

/** The colour and the mark of an instance, by what the page shows. */
const COLOUR_CHUNK = /* glsl */ `
uniform int colourBy;
uniform vec3 styleColours[8];
uniform vec3 phaseColours[4];
uniform sampler2D byteColours;

vec3 paintNow() {
  uint styleAndPhase = (after.w >> 8u) & 255u;
  if (colourBy == 0) return styleColours[int(styleAndPhase & 63u) % 8];
  if (colourBy == 2) return phaseColours[int(styleAndPhase >> 6u)];
  uint value = colourBy == 1 ? after.w & 255u : after.w >> 24u;
  return texelFetch(byteColours, ivec2(int(value), 0), 0).rgb;
}

int patternNow() {
  uint styleAndPhase = (after.w >> 8u) & 255u;
  int style = int(styleAndPhase & 63u);
  if (colourBy == 0) return (style + style / 8) % ${PATTERNS.length};
  return colourBy == 2 ? int(styleAndPhase >> 6u) : 0;
}
`;

export const BODY_VERTEX = /* glsl */ `
${RECORD_CHUNK}
${COLOUR_CHUNK}
uniform float pixel;
uniform float leastPixels;
in vec2 anchor;
in float part;
in vec2 roof;
out vec3 upright;
out float depth;
out vec2 roofPlace;
flat out vec2 roofHalf;
flat out vec3 paint;
flat out int pattern;
flat out int piece;
flat out uint flags;

void main() {
  vec2 ahead = aheadNow();
  vec2 across = vec2(-ahead.y, ahead.x);
  vec3 centre = centreNow();
  vec2 extent = sizeNow();
  if (leastPixels > 0.0) {
    float metres = leastPixels * pixel * -(modelViewMatrix * vec4(centre, 1.0)).z;
    extent = max(extent, vec2(metres * 1.5, metres));
  }
  vec3 local = position + vec3(anchor * extent, 0.0);
  vec3 place = centre + vec3(ahead * local.x + across * local.y, local.z);
  upright = vec3(ahead * normal.x + across * normal.y, normal.z);
  roofHalf = extent * 0.5;
  roofPlace = roof;
  paint = paintNow();
  pattern = patternNow();
  piece = int(part + 0.5);
  flags = flagsNow();
  vec4 seen = modelViewMatrix * vec4(place, 1.0);
  depth = -seen.z;
  gl_Position = isLeftOut(isOfTwin()) ? vec4(2.0, 2.0, 2.0, 1.0) : projectionMatrix * seen;
}
`;

/** Whether a place on the roof is on the mark of a pattern. Places are from -1 to 1. */
const PATTERN_CHUNK = /* glsl */ `
float onMark(int pattern, vec2 place, vec2 half_) {
  vec2 metres = place * half_;
  float reach = min(half_.x, half_.y);
  vec2 at = metres / reach;
  vec2 side = abs(at);
  if (pattern == 1) return step(side.y, 0.28);
  if (pattern == 2) return step(0.25, side.x) * step(side.x, 0.65);
  if (pattern == 3) return step(length(at), 0.62);
  if (pattern == 4) return step(abs(side.x - side.y), 0.25) * step(max(side.x, side.y), 0.85);
  if (pattern == 5) return step(0.3, side.y) * step(side.y, 0.62);
  if (pattern == 6) return step(abs(at.x + side.y * 0.9 - 0.3), 0.26) * step(side.y, 0.85);
  if (pattern == 7) return step(0.66, max(abs(place.x) - (1.0 - reach / half_.x) * sign(half_.x - reach), abs(place.y)));
  return 0.0;
}
`;

export const BODY_FRAGMENT = /* glsl */ `
${LIGHT_CHUNK}
${PATTERN_CHUNK}
uniform float blink;
uniform float isFlat;
in vec3 upright;
in float depth;
in vec2 roofPlace;
flat in vec2 roofHalf;
flat in vec3 paint;
flat in int pattern;
flat in int piece;
flat in uint flags;
out vec4 colour;

bool has(uint bit) {
  return (flags & bit) != 0u;
}

vec3 roofColour() {
  float bright = dot(paint, vec3(0.3, 0.6, 0.1));
  vec3 ink = bright > 0.5 ? vec3(0.09, 0.1, 0.12) : vec3(1.0);
  vec2 blur = fwidth(roofPlace);
  // Marks that are smaller than pixels would only flicker.
  float seen = 1.0 - smoothstep(0.2, 0.55, max(blur.x, blur.y));
  vec3 tone = mix(paint, ink, 0.85 * seen * onMark(pattern, roofPlace, roofHalf));
  if (isFlat < 0.5) return tone;
  if (has(8u) && roofPlace.x < -0.72) return vec3(1.0, 0.12, 0.1);
  float side = has(16u) ? roofPlace.y : (has(32u) ? -roofPlace.y : 0.0);
  if (blink > 0.5 && side > 0.6 && abs(roofPlace.x) > 0.55) return vec3(1.0, 0.7, 0.1);
  bool isRim = max(abs(roofPlace.x), abs(roofPlace.y)) > 0.8;
  if ((flags & 192u) == 192u) return tone;
  if (has(64u) && isRim) return vec3(1.0, 0.2, 0.75);
  if (has(128u) && isRim) return mix(tone, vec3(1.0), seen);
  return tone;
}

/** A ghost is pale, and every other pixel is missing. */
bool isHole() {
  ivec2 at = ivec2(gl_FragCoord.xy) / 2;
  return ((at.x + at.y) & 1) == 0;
}

void main() {
  bool isGhost = (flags & 192u) == 192u;
  if (isGhost && isHole()) discard;
  vec3 facing = normalize(upright);
  vec3 tone = paint;
  float shines = 0.0;
  if (piece == ${PART.glass}) tone = mix(vec3(0.13, 0.17, 0.22), vec3(0.45, 0.55, 0.64), clamp(facing.z, 0.0, 1.0) * 0.8);
  if (piece == ${PART.dark}) tone = vec3(0.12, 0.125, 0.14);
  if (piece == ${PART.light}) tone = mix(paint, vec3(0.97, 0.975, 0.98), 0.86);
  if (piece == ${PART.roof}) tone = roofColour();
  if (piece == ${PART.tail}) {
    tone = has(8u) ? vec3(1.0, 0.13, 0.1) : mix(vec3(0.42, 0.05, 0.06), vec3(0.66, 0.07, 0.07), night);
    shines = has(8u) ? 1.0 : 0.6 * night;
  }
  if (piece == ${PART.head}) {
    tone = mix(vec3(0.86, 0.88, 0.9), vec3(1.0, 0.97, 0.86), night);
    shines = night;
  }
  if (piece == ${PART.left} || piece == ${PART.right}) {
    bool isLit = blink > 0.5 && has(piece == ${PART.left} ? 16u : 32u);
    tone = isLit ? vec3(1.0, 0.68, 0.08) : vec3(0.62, 0.36, 0.12);
    shines = isLit ? 1.0 : 0.0;
  }
  // Colours tell things, so that they must be seen at night, too.
  bool isColoured = piece == ${PART.paint} || piece == ${PART.roof} || piece == ${PART.light};
  vec3 shaded = mix(lit(tone, facing), tone, max(shines, isColoured ? 0.35 * night : 0.0));
  if (isGhost) shaded = mix(shaded, vec3(0.86, 0.9, 1.0), 0.7);
  colour = vec4(fogged(shaded, depth), 1.0);
}
`;
