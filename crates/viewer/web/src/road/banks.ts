import { rgb } from '../colour/palette.ts';
import type { Line, Scene } from '../protocol/scene.ts';
import type { LaneletIndex } from './lanelet_index.ts';
import type { MeshBuilder } from './mesh_builder.ts';
import { stations, type Station } from './ribbon.ts';
import { SHOULDER_DROP_M, SHOULDER_M } from './surface.ts';

/** A bank goes down so far; what is below the ground is not seen. */
const BANK_M = 9;
const DECK_M = 1;
/** A road that is so far below passes under a bridge. */
const CLEARANCE_M = 3;
const TONE = rgb('#a9aca6');
const BESIDE_M = 0.25;
const PIECE_M = 3;

type Builder = MeshBuilder<'position' | 'normal' | 'tone' | 'lamp'>;

/** Sides of roads: a bank down to the ground, or the side of a deck where another road passes below. */
export function addBanks(builder: Builder, scene: Scene, index: LaneletIndex): void {
  for (const { left, right } of scene.lanelets) {
    addBank(builder, left, 1, index);
    addBank(builder, right, -1, index);
  }
}

/** `sign` is 1 at a left border, -1 at a right one. Where another lane is beside there is no bank. */
function addBank(builder: Builder, border: Line, sign: 1 | -1, index: LaneletIndex): void {
  const points = stations(border);
  for (let at = 0; at + 1 < points.length; at += 1) {
    const [from, to] = [points[at], points[at + 1]];
    const middle = beside(between(from, to, 0.5), sign * BESIDE_M);
    if (index.hasRoadNear(middle.x, middle.y, from.z, CLEARANCE_M)) continue;
    addPieces(builder, from, to, sign, index);
  }
}

/** Goes along a straight part; where a road begins or ends to pass below, another side begins. */
function addPieces(builder: Builder, from: Station, to: Station, sign: 1 | -1, index: LaneletIndex): void {
  const count = Math.max(Math.ceil((to.along - from.along) / PIECE_M), 1);
  let [begun, depth] = [0, 0];
  for (let piece = 0; piece < count; piece += 1) {
    const { z } = between(from, to, (piece + 0.5) / count);
    const { x, y } = beside(between(from, to, (piece + 0.5) / count), sign * SHOULDER_M);
    const here = index.hasRoadBelow(x, y, z - CLEARANCE_M) ? DECK_M : BANK_M;
    if (piece > 0 && here !== depth) {
      addSide(builder, between(from, to, begun / count), between(from, to, piece / count), sign, depth);
      begun = piece;
    }
    depth = here;
  }
  addSide(builder, between(from, to, begun / count), to, sign, depth);
}

function between(from: Station, to: Station, share: number): Station {
  const part = (name: keyof Station): number => from[name] + (to[name] - from[name]) * share;
  return { x: part('x'), y: part('y'), z: part('z'), leftX: part('leftX'), leftY: part('leftY'), along: part('along') };
}

const beside = (point: Station, way: number): { x: number; y: number } => ({ x: point.x + point.leftX * way, y: point.y + point.leftY * way });

function addSide(builder: Builder, from: Station, to: Station, sign: 1 | -1, depth: number): void {
  const corners = [from, to].map((point) => {
    const { x, y } = beside(point, sign * SHOULDER_M);
    const vertex = (z: number) =>
      builder.vertex({ position: [x, y, z], normal: [point.leftX * sign, point.leftY * sign, 0.2], tone: TONE, lamp: [-1, -1] });
    return [vertex(point.z - SHOULDER_DROP_M), vertex(point.z - depth)] as const;
  });
  builder.quad(corners[0][0], corners[0][1], corners[1][1], corners[1][0]);
}
