import type { BufferGeometry } from 'three';
import { MeshBuilder } from '../road/mesh_builder.ts';

/** What a piece of a body is; the shader gives each its colour. */
export const PART = {
  paint: 0,
  glass: 1,
  dark: 2,
  tail: 3,
  left: 4,
  right: 5,
  head: 6,
  roof: 7,
  light: 8,
} as const;

type Part = (typeof PART)[keyof typeof PART];
type Builder = MeshBuilder<'position' | 'anchor' | 'normal' | 'part' | 'roof'>;

/** A place along or across a vehicle: a share of its length or width from the centre, plus metres. */
type Place = [share: number, metres: number];

interface Rectangle {
  back: Place;
  front: Place;
  half: Place;
}

interface Faces {
  sides: Part;
  front: Part;
  back: Part;
  top: Part;
}

const all = (part: Part): Faces => ({ sides: part, front: part, back: part, top: part });

/** A body between a lower and an upper rectangle; it has no floor. Its middle may be beside that of the vehicle. */
function addBlock(builder: Builder, low: Rectangle, z0: number, high: Rectangle, z1: number, faces: Faces, middle: Place = [0, 0]): void {
  const corner = (rectangle: Rectangle, end: 'back' | 'front', sign: number, z: number, normal: number[], part: Part, roof = [0, 0]) =>
    builder.vertex({
      position: [rectangle[end][1], rectangle.half[1] * sign + middle[1], z],
      anchor: [rectangle[end][0], rectangle.half[0] * sign + middle[0]],
      normal,
      part: [part],
      roof,
    });
  const face = (corners: [Rectangle, 'back' | 'front', number, number][], normal: number[], part: Part) => {
    const [a, b, c, d] = corners.map(([rectangle, end, sign, z]) => corner(rectangle, end, sign, z, normal, part));
    builder.quad(a, b, c, d);
  };
  for (const sign of [1, -1]) {
    face([[low, 'back', sign, z0], [low, 'front', sign, z0], [high, 'front', sign, z1], [high, 'back', sign, z1]], [0, sign, 0.25], faces.sides);
  }
  for (const end of ['back', 'front'] as const) {
    const lean = slope(low[end], high[end]) * (end === 'front' ? 1 : -1);
    const normal = [end === 'front' ? 1 : -1, 0, lean];
    face([[low, end, 1, z0], [low, end, -1, z0], [high, end, -1, z1], [high, end, 1, z1]], normal, faces[end]);
  }
  const up = [0, 0, 1];
  builder.quad(
    corner(high, 'back', 1, z1, up, faces.top, [-1, 1]),
    corner(high, 'back', -1, z1, up, faces.top, [-1, -1]),
    corner(high, 'front', -1, z1, up, faces.top, [1, -1]),
    corner(high, 'front', 1, z1, up, faces.top, [1, 1]),
  );
}

/** How far an end leans back: about the share of a car's length by which it moves over its height. */
const slope = (low: Place, high: Place): number => Math.min(Math.abs(low[0] - high[0]) * 4 + Math.abs(low[1] - high[1]), 1.2);

const box = (back: Place, front: Place, half: Place): Rectangle => ({ back, front, half });

function addBox(builder: Builder, rectangle: Rectangle, z0: number, z1: number, faces: Faces): void {
  addBlock(builder, rectangle, z0, rectangle, z1, faces);
}

/** Wheels at both sides of places along the vehicle: a lower and an upper half, so that they look round. */
function addWheels(builder: Builder, places: Place[], radius: number): void {
  for (const [share, metres] of places) {
    const at = (reach: number): Rectangle => box([share, metres - reach * radius], [share, metres + reach * radius], [0, 0.12]);
    for (const sign of [1, -1]) {
      const middle: Place = [0.5 * sign, -0.1 * sign];
      addBlock(builder, at(0.45), 0, at(1), radius * 0.6, all(PART.dark), middle);
      addBlock(builder, at(1), radius * 0.6, at(0.6), radius * 1.8, all(PART.dark), middle);
    }
  }
}

/** Lamps at the corners: tail and head lamps, and indicators outside of them. */
function addLamps(builder: Builder, z0: number, z1: number, inset: number): void {
  const tips: [Place, Place][] = [
    [[-0.5, -0.02], [-0.5, 0.12 + inset]],
    [[0.5, -0.14 - inset], [0.5, 0.012]],
  ];
  tips.forEach(([back, front], end) => {
    for (const sign of [1, -1]) {
      const lamp = end === 0 ? PART.tail : PART.head;
      const indicator = sign > 0 ? PART.left : PART.right;
      addCorner(builder, back, front, [0.26 * sign, 0], [0.42 * sign, 0], z0, z1, lamp);
      addCorner(builder, back, front, [0.42 * sign, 0], [0.5 * sign, 0.012 * sign], z0, z1, indicator);
    }
  });
}

/** A box between two places across the vehicle. */
function addCorner(builder: Builder, back: Place, front: Place, from: Place, to: Place, z0: number, z1: number, part: Part): void {
  const vertex = (end: Place, side: Place, z: number, normal: number[]) =>
    builder.vertex({ position: [end[1], side[1], z], anchor: [end[0], side[0]], normal, part: [part], roof: [0, 0] });
  for (const [end, normal] of [[back, [-1, 0, 0]], [front, [1, 0, 0]]] as const) {
    builder.quad(vertex(end, from, z0, [...normal]), vertex(end, to, z0, [...normal]), vertex(end, to, z1, [...normal]), vertex(end, from, z1, [...normal]));
  }
  const out = [0, Math.sign(to[0]), 0];
  builder.quad(vertex(back, to, z0, out), vertex(front, to, z0, out), vertex(front, to, z1, out), vertex(back, to, z1, out));
  const up = [0, 0, 1];
  builder.quad(vertex(back, from, z1, up), vertex(back, to, z1, up), vertex(front, to, z1, up), vertex(front, from, z1, up));
}

const start = (): Builder => new MeshBuilder({ position: 3, anchor: 2, normal: 3, part: 1, roof: 2 });

export function carBody(): BufferGeometry {
  const builder = start();
  addWheels(builder, [[-0.3, 0], [0.31, 0]], 0.31);
  addBlock(builder, box([-0.49, 0], [0.48, 0], [0.47, 0]), 0.24, box([-0.5, 0], [0.5, 0], [0.5, 0]), 0.55, all(PART.paint));
  addBlock(builder, box([-0.5, 0], [0.5, 0], [0.5, 0]), 0.55, box([-0.48, 0], [0.44, 0], [0.47, 0]), 0.88, all(PART.paint));
  const cabin = { sides: PART.glass, front: PART.glass, back: PART.glass, top: PART.roof };
  addBlock(builder, box([-0.44, 0], [0.24, 0], [0.45, 0]), 0.88, box([-0.33, 0], [0.07, 0], [0.38, 0]), 1.44, cabin);
  addLamps(builder, 0.58, 0.76, 0.05);
  return builder.geometry();
}

export function truckBody(): BufferGeometry {
  const builder = start();
  addWheels(builder, [[-0.5, 1.2], [-0.5, 2.4], [0.5, -1.4]], 0.48);
  addBox(builder, box([-0.5, 0.05], [0.5, -0.2], [0.42, 0]), 0.5, 1.0, all(PART.dark));
  addBlock(builder, box([0.5, -2.3], [0.5, 0], [0.49, 0]), 0.4, box([0.5, -2.3], [0.5, -0.05], [0.49, 0]), 1.5, all(PART.paint));
  const cab = { sides: PART.glass, front: PART.glass, back: PART.dark, top: PART.paint };
  addBlock(builder, box([0.5, -1.5], [0.5, -0.05], [0.48, 0]), 1.5, box([0.5, -1.5], [0.5, -0.35], [0.46, 0]), 2.55, cab);
  addBox(builder, box([0.5, -2.3], [0.5, -1.5], [0.49, 0]), 1.5, 2.75, all(PART.paint));
  const load = { sides: PART.light, front: PART.light, back: PART.light, top: PART.roof };
  addBox(builder, box([-0.5, 0], [0.5, -2.55], [0.5, 0]), 1.0, 3.6, load);
  addLamps(builder, 0.75, 1.05, 0);
  return builder.geometry();
}

export function busBody(): BufferGeometry {
  const builder = start();
  addWheels(builder, [[-0.5, 2.8], [0.5, -2.4]], 0.48);
  addBox(builder, box([-0.5, 0], [0.5, 0], [0.5, 0]), 0.3, 1.35, all(PART.paint));
  const windows = { sides: PART.glass, front: PART.glass, back: PART.glass, top: PART.paint };
  addBlock(builder, box([-0.495, 0], [0.495, 0], [0.49, 0]), 1.35, box([-0.49, 0], [0.485, 0], [0.49, 0]), 2.5, windows);
  const roof = { ...all(PART.paint), top: PART.roof };
  addBlock(builder, box([-0.5, 0], [0.495, 0], [0.5, 0]), 2.5, box([-0.49, 0], [0.48, 0], [0.47, 0]), 3.05, roof);
  addLamps(builder, 0.85, 1.2, 0);
  return builder.geometry();
}

export function motorcycleBody(): BufferGeometry {
  const builder = start();
  for (const share of [-0.34, 0.34]) {
    addBlock(builder, box([share, -0.3], [share, 0.3], [0, 0.07]), 0, box([share, -0.2], [share, 0.2], [0, 0.07]), 0.62, all(PART.dark));
  }
  addBlock(builder, box([-0.42, 0], [0.3, 0], [0, 0.14]), 0.45, box([-0.4, 0], [0.24, 0], [0, 0.16]), 0.86, all(PART.paint));
  addBox(builder, box([0.22, 0], [0.27, 0], [0.42, 0]), 0.92, 1.0, all(PART.dark));
  const rider = { ...all(PART.paint), top: PART.roof };
  addBlock(builder, box([-0.26, 0], [0.02, 0], [0, 0.2]), 0.8, box([-0.16, 0], [0.1, 0], [0, 0.24]), 1.36, rider);
  addBlock(builder, box([-0.04, 0], [0.1, 0], [0, 0.13]), 1.36, box([-0.02, 0], [0.08, 0], [0, 0.1]), 1.66, all(PART.glass));
  addCorner(builder, [-0.46, 0], [-0.4, 0], [0.0, -0.1], [0.0, 0.1], 0.7, 0.84, PART.tail);
  addCorner(builder, [0.33, 0], [0.37, 0], [0.0, -0.1], [0.0, 0.1], 0.76, 0.94, PART.head);
  for (const end of [-0.4, 0.32]) {
    addCorner(builder, [end, 0], [end + 0.05, 0], [0.08, 0.1], [0.1, 0.24], 0.74, 0.86, PART.left);
    addCorner(builder, [end, 0], [end + 0.05, 0], [-0.08, -0.1], [-0.1, -0.24], 0.74, 0.86, PART.right);
  }
  return builder.geometry();
}

export function otherBody(): BufferGeometry {
  const builder = start();
  addWheels(builder, [[-0.33, 0], [0.33, 0]], 0.35);
  const top = { ...all(PART.paint), top: PART.roof };
  addBlock(builder, box([-0.5, 0], [0.5, 0], [0.5, 0]), 0.3, box([-0.46, 0], [0.4, 0], [0.44, 0]), 1.7, top);
  addBlock(builder, box([0.3, 0], [0.505, 0], [0.42, 0]), 0.95, box([0.3, 0], [0.46, 0], [0.4, 0]), 1.45, all(PART.glass));
  addLamps(builder, 0.5, 0.72, 0);
  return builder.geometry();
}

/** A flat rectangle, for vehicles that are far away. */
export function flatBody(): BufferGeometry {
  const builder = start();
  const corner = (x: number, y: number) =>
    builder.vertex({ position: [0, 0, 0.9], anchor: [x / 2, y / 2], normal: [0, 0, 1], part: [PART.roof], roof: [x, y] });
  builder.quad(corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1));
  return builder.geometry();
}
