import earcut from 'earcut';
import { GLSL3, Mesh, ShaderMaterial, type DataTexture } from 'three';
import { rgb, type Rgb } from '../colour/palette.ts';
import type { Line, Marking, Scene } from '../protocol/scene.ts';
import { atmosphere, LIGHT_CHUNK } from '../stage/atmosphere.ts';
import { LIGHT_STATES_CHUNK } from './light_states.ts';
import { MeshBuilder } from './mesh_builder.ts';
import { stations } from './ribbon.ts';

const LIFT_M = 0.02;
const THIN_M = 0.12;
const THICK_M = 0.25;
const STOP_LINE_M = 0.4;
const EDGE_M = 0.08;
/** Distance of the middle of each half of a double line from its middle. */
const DOUBLE_M = 0.11;
const NO_LIGHT = -1;

const SOLID = 0;
const DASHED = 1;
const ZEBRA = 2;
const BROKEN_STOP = 3;

const WHITE = rgb('#f4f5f2');
const GREY = rgb('#7b8087');

const VERTEX = /* glsl */ `
${LIGHT_STATES_CHUNK}
uniform float pixel;
in vec2 left;
in float halfWidth;
in vec3 tone;
/** x: metres along the line, y: its pattern, z: its light or -1 */
in vec3 style;
out vec3 paint;
out float along;
out float depth;
out float cover;
flat out int pattern;
void main() {
  vec4 middle = modelViewMatrix * vec4(position, 1.0);
  float leastHalf = 0.6 * pixel * -middle.z;
  float wide = max(abs(halfWidth), leastHalf);
  cover = halfWidth == 0.0 ? 1.0 : clamp(abs(halfWidth) / wide * 1.4, 0.25, 1.0);
  vec4 seen = halfWidth == 0.0 ? middle : modelViewMatrix * vec4(position + vec3(left * sign(halfWidth) * wide, 0.0), 1.0);
  vec4 shown = lightShown(style.z);
  paint = mix(tone, shown.rgb, shown.a);
  along = style.x;
  pattern = int(style.y + 0.5);
  depth = -seen.z;
  gl_Position = projectionMatrix * seen;
}
`;

const FRAGMENT = /* glsl */ `
${LIGHT_CHUNK}
in vec3 paint;
in float along;
in float depth;
in float cover;
flat in int pattern;
out vec4 colour;

/** How much of a pixel a dash covers. */
float dashes(float on, float period) {
  float blur = fwidth(along);
  float at = mod(along, period);
  float edge = min(blur, on) * 0.5 + 1e-4;
  float here = smoothstep(-edge, edge, at) * (1.0 - smoothstep(on - edge, on + edge, at)) + smoothstep(period - edge, period + edge, at);
  return mix(here, on / period, smoothstep(0.25, 0.7, blur / period));
}

void main() {
  float share = cover;
  if (pattern == ${DASHED}) share *= dashes(3.0, 9.0);
  if (pattern == ${ZEBRA}) share *= dashes(0.5, 1.0);
  if (pattern == ${BROKEN_STOP}) share *= dashes(0.6, 0.9);
  vec3 tone = mix(lit(paint, vec3(0.0, 0.0, 1.0)), paint, 0.35 * night);
  colour = vec4(fogged(tone, depth), share * 0.92);
}
`;

type Builder = MeshBuilder<'position' | 'left' | 'halfWidth' | 'tone' | 'style'>;

interface Stroke {
  width: number;
  pattern: number;
  offset: number;
  tone: Rgb;
  light: number;
}

/** Everything that is painted on the road, in one mesh. Stop lines of lights have the colour that the light shows. */
export function paintMesh(scene: Scene, lightStates: DataTexture): Mesh {
  const builder: Builder = new MeshBuilder({ position: 3, left: 2, halfWidth: 1, tone: 3, style: 3 });
  for (const marking of scene.markings) {
    for (const stroke of strokes(marking)) addStroke(builder, marking.line, stroke);
  }
  for (const stop of scene.stop_lines) {
    const pattern = stop.kind === 'line' ? BROKEN_STOP : SOLID;
    const light = stop.light ?? NO_LIGHT;
    addStroke(builder, stop.line, { width: STOP_LINE_M, pattern, offset: 0, tone: WHITE, light });
  }
  for (const crosswalk of scene.crosswalks) addZebra(builder, crosswalk);
  const mesh = new Mesh(builder.geometry(), paintMaterial(lightStates));
  mesh.frustumCulled = false;
  mesh.renderOrder = -2;
  return mesh;
}

function paintMaterial(lightStates: DataTexture): ShaderMaterial {
  return new ShaderMaterial({
    glslVersion: GLSL3,
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms: { ...atmosphere, lightStates: { value: lightStates } },
    transparent: true,
    depthWrite: false,
    side: 2,
    polygonOffset: true,
    polygonOffsetFactor: -1,
    polygonOffsetUnits: -4,
  });
}

/** The lines that a kind of paint consists of; the first word of a double one is its left half. */
function strokes({ paint, is_thick }: Marking): Stroke[] {
  const width = is_thick ? THICK_M : THIN_M;
  const stroke = (word: string, offset: number): Stroke => ({
    width,
    pattern: word === 'dashed' ? DASHED : SOLID,
    offset,
    tone: WHITE,
    light: NO_LIGHT,
  });
  switch (paint) {
    case 'dashed':
    case 'solid':
      return [stroke(paint, 0)];
    case 'dashed_solid':
    case 'solid_dashed':
    case 'solid_solid':
    case 'dashed_dashed': {
      const [left, right] = paint.split('_');
      return [stroke(left, DOUBLE_M), stroke(right, -DOUBLE_M)];
    }
    case 'edge':
      return [{ width: EDGE_M, pattern: SOLID, offset: 0, tone: GREY, light: NO_LIGHT }];
    default:
      return [];
  }
}

function addStroke(builder: Builder, line: Line, { width, pattern, offset, tone, light }: Stroke): void {
  let before: [number, number] | null = null;
  for (const { x, y, z, leftX, leftY, along } of stations(line)) {
    const vertex = (half: number) =>
      builder.vertex({
        position: [x + leftX * offset, y + leftY * offset, z + LIFT_M],
        left: [leftX, leftY],
        halfWidth: [half],
        tone,
        style: [along, pattern, light],
      });
    const here: [number, number] = [vertex(width / 2), vertex(-width / 2)];
    if (before) builder.quad(before[0], before[1], here[1], here[0]);
    before = here;
  }
}

/** Stripes across the way of those who walk, which is the longest side of the outline. */
function addZebra(builder: Builder, outline: Line): void {
  const corners = stations(outline);
  if (corners.length > 3 && Math.hypot(corners[0].x - corners.at(-1)!.x, corners[0].y - corners.at(-1)!.y) < 0.05) corners.pop();
  if (corners.length < 3) return;
  let longest = { x: 1, y: 0, length: 0 };
  corners.forEach((corner, index) => {
    const next = corners[(index + 1) % corners.length];
    const length = Math.hypot(next.x - corner.x, next.y - corner.y);
    if (length > longest.length) longest = { x: (next.x - corner.x) / length, y: (next.y - corner.y) / length, length };
  });
  const first = builder.vertexCount;
  for (const { x, y, z } of corners) {
    const along = (x - corners[0].x) * longest.x + (y - corners[0].y) * longest.y + 1000;
    builder.vertex({
      position: [x, y, z + LIFT_M],
      left: [0, 0],
      halfWidth: [0],
      tone: WHITE,
      style: [along, ZEBRA, NO_LIGHT],
    });
  }
  const triangles = earcut(corners.flatMap(({ x, y }) => [x, y]));
  for (let at = 0; at < triangles.length; at += 3) {
    const [a, b, c] = triangles.slice(at, at + 3);
    builder.triangle(first + a, first + b, first + c);
  }
}
