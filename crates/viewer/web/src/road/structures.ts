import { GLSL3, Mesh, ShaderMaterial } from 'three';
import { rgb, type Rgb } from '../colour/palette.ts';
import type { Line, Scene } from '../protocol/scene.ts';
import { atmosphere, LIGHT_CHUNK } from '../stage/atmosphere.ts';
import { addBanks } from './banks.ts';
import type { LaneletIndex } from './lanelet_index.ts';
import { LIGHT_STATES_CHUNK, type LightStates } from './light_states.ts';
import { MeshBuilder } from './mesh_builder.ts';
import { stations } from './ribbon.ts';
import type { SignalPlace } from './signal_places.ts';

const CURB = { height: 0.13, foot: 0, width: 0.18, tone: rgb('#b3b6b5') };
const BARRIER = { height: 0.8, foot: 0.35, width: 0.14, tone: rgb('#c5ccd2') };
const METAL = rgb('#6c737b');
const HOUSING = rgb('#23272c');
const LAMP_OFF = rgb('#33373c');
const LAMP_RADIUS_M = 0.16;
const LAMP_STEP_M = 0.4;
const LAMP_CORNERS = 10;

const VERTEX = /* glsl */ `
${LIGHT_STATES_CHUNK}
in vec3 tone;
/** x: the light, y: which of its lamps, or -1 where nothing shines */
in vec2 lamp;
out vec3 paint;
out vec3 upright;
out float depth;
out float shines;
void main() {
  vec4 shown = lightShown(lamp.x);
  shines = lamp.y >= 0.0 && lampOf(shown) == lamp.y ? 1.0 : 0.0;
  paint = mix(tone, shown.rgb, shines);
  upright = normal;
  vec4 seen = modelViewMatrix * vec4(position, 1.0);
  depth = -seen.z;
  gl_Position = projectionMatrix * seen;
}
`;

const FRAGMENT = /* glsl */ `
${LIGHT_CHUNK}
in vec3 paint;
in vec3 upright;
in float depth;
in float shines;
out vec4 colour;
void main() {
  vec3 tone = shines > 0.5 ? paint : lit(paint, normalize(upright));
  colour = vec4(fogged(tone, depth), 1.0);
}
`;

type Builder = MeshBuilder<'position' | 'normal' | 'tone' | 'lamp'>;
type Vector = [x: number, y: number, z: number];

/** Curbs, barriers, banks, and signals with their posts, in one mesh. */
export function structuresMesh(scene: Scene, index: LaneletIndex, signals: SignalPlace[], lights: LightStates): Mesh {
  const builder: Builder = new MeshBuilder({ position: 3, normal: 3, tone: 3, lamp: 2 });
  for (const { line, paint } of scene.markings) {
    if (paint === 'curb') addWall(builder, line, CURB);
    if (paint === 'barrier') addWall(builder, line, BARRIER);
  }
  addBanks(builder, scene, index);
  for (const signal of signals) addSignal(builder, signal);
  const material = new ShaderMaterial({
    glslVersion: GLSL3,
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms: { ...atmosphere, lightStates: { value: lights.texture } },
    side: 2,
  });
  const mesh = new Mesh(builder.geometry(), material);
  mesh.frustumCulled = false;
  return mesh;
}

interface Wall {
  height: number;
  foot: number;
  width: number;
  tone: Rgb;
}

/** A body along a line: two sides and a top. */
function addWall(builder: Builder, line: Line, { height, foot, width, tone }: Wall): void {
  const points = stations(line);
  const faces: [from: [number, number], to: [number, number], normal: (x: number, y: number) => Vector][] = [
    [[width / 2, foot], [width / 2, height], (x, y) => [x, y, 0]],
    [[width / 2, height], [-width / 2, height], () => [0, 0, 1]],
    [[-width / 2, height], [-width / 2, foot], (x, y) => [-x, -y, 0]],
  ];
  for (const [from, to, normal] of faces) {
    let before: [number, number] | null = null;
    for (const { x, y, z, leftX, leftY } of points) {
      const corner = ([across, up]: [number, number]) =>
        builder.vertex({
          position: [x + leftX * across, y + leftY * across, z + up],
          normal: normal(leftX, leftY),
          tone,
          lamp: [-1, -1],
        });
      const here: [number, number] = [corner(from), corner(to)];
      if (before) builder.quad(before[0], here[0], here[1], before[1]);
      before = here;
    }
  }
}

function addSignal(builder: Builder, { light, head, foot, facing }: SignalPlace): void {
  const [hx, hy, hz] = head;
  const ahead: Vector = [facing[0], facing[1], 0];
  const side: Vector = [-facing[1], facing[0], 0];
  if (foot) {
    const top = Math.max(hz, foot[2] + 1);
    addBeam(builder, [foot[0], foot[1], foot[2]], [foot[0], foot[1], top + 0.5], 0.07, METAL);
    if (Math.hypot(foot[0] - hx, foot[1] - hy) > 0.5) addBeam(builder, [foot[0], foot[1], top + 0.4], [hx, hy, top + 0.4], 0.06, METAL);
  }
  const behind: Vector = [hx - ahead[0] * 0.12, hy - ahead[1] * 0.12, hz];
  addBox(builder, behind, ahead, side, [0.12, 0.24, LAMP_STEP_M * 1.5 + 0.06], HOUSING);
  for (let lamp = 0; lamp < 3; lamp += 1) {
    const centre: Vector = [hx + ahead[0] * 0.02, hy + ahead[1] * 0.02, hz + LAMP_STEP_M * (1 - lamp)];
    addDisc(builder, centre, ahead, side, light, lamp);
  }
}

/** A box around a point, with its half sizes ahead, sideways and upwards. */
function addBox(builder: Builder, centre: Vector, ahead: Vector, side: Vector, half: Vector, tone: Rgb): void {
  const up: Vector = [0, 0, 1];
  const axes: [Vector, number, Vector, number, Vector, number][] = [
    [ahead, half[0], side, half[1], up, half[2]],
    [side, half[1], up, half[2], ahead, half[0]],
    [up, half[2], ahead, half[0], side, half[1]],
  ];
  for (const [out, outBy, a, aBy, b, bBy] of axes) {
    for (const sign of [1, -1]) {
      const corner = (u: number, v: number) =>
        builder.vertex({
          position: [0, 1, 2].map((axis) => centre[axis] + out[axis] * outBy * sign + a[axis] * aBy * u + b[axis] * bBy * v),
          normal: out.map((part) => part * sign),
          tone,
          lamp: [-1, -1],
        });
      builder.quad(corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1));
    }
  }
}

/** A straight square beam. */
function addBeam(builder: Builder, from: Vector, to: Vector, half: number, tone: Rgb): void {
  const length = Math.hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
  const isUpright = Math.abs(to[2] - from[2]) > length / 2;
  const centre: Vector = [(from[0] + to[0]) / 2, (from[1] + to[1]) / 2, (from[2] + to[2]) / 2];
  if (isUpright) {
    addBox(builder, centre, [1, 0, 0], [0, 1, 0], [half, half, length / 2], tone);
    return;
  }
  const along: Vector = [(to[0] - from[0]) / length, (to[1] - from[1]) / length, 0];
  addBox(builder, centre, along, [-along[1], along[0], 0], [length / 2, half, half], tone);
}

function addDisc(builder: Builder, centre: Vector, ahead: Vector, side: Vector, light: number, lamp: number): void {
  const rim: number[] = [];
  for (let corner = 0; corner < LAMP_CORNERS; corner += 1) {
    const angle = (corner / LAMP_CORNERS) * 2 * Math.PI;
    const across = Math.cos(angle) * LAMP_RADIUS_M;
    const position = [centre[0] + side[0] * across, centre[1] + side[1] * across, centre[2] + Math.sin(angle) * LAMP_RADIUS_M];
    rim.push(builder.vertex({ position, normal: ahead, tone: LAMP_OFF, lamp: [light, lamp] }));
  }
  for (let corner = 1; corner + 1 < LAMP_CORNERS; corner += 1) builder.triangle(rim[0], rim[corner], rim[corner + 1]);
}
