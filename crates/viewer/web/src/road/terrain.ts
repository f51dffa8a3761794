import type { Scene } from '../protocol/scene.ts';

const LEAST_SPACING_M = 30;
const MOST_NODES = 160;
const MARGIN_M = 240;
/** The ground is so far below the lowest road near by. */
const BELOW_ROAD_M = 0.15;
const SMOOTHING_ROUNDS = 6;

/** Heights of the ground on a grid: below all roads near by, and in between as the roads around suggest. */
export interface Terrain {
  xs: number[];
  ys: number[];
  /** Row by row, from the south. */
  heights: Float32Array;
}

export function terrainOf(scene: Scene): Terrain {
  const [x0, y0, x1, y1] = scene.bounds;
  const spacing = Math.max(LEAST_SPACING_M, Math.max(x1 - x0, y1 - y0) / MOST_NODES);
  const xs = axis(x0 - MARGIN_M, x1 + MARGIN_M, spacing);
  const ys = axis(y0 - MARGIN_M, y1 + MARGIN_M, spacing);
  const heights = new Float32Array(xs.length * ys.length).fill(NaN);
  const isKnown = new Uint8Array(heights.length);
  for (const { left, right } of scene.lanelets) {
    for (const line of [left, right]) {
      for (let at = 0; at < line.length; at += 3) lower(heights, isKnown, xs, ys, spacing, line[at], line[at + 1], line[at + 2] - BELOW_ROAD_M);
    }
  }
  spread(heights, xs.length, ys.length);
  for (let round = 0; round < SMOOTHING_ROUNDS; round += 1) smooth(heights, isKnown, xs.length, ys.length);
  return { xs, ys, heights };
}

function axis(from: number, to: number, spacing: number): number[] {
  const count = Math.max(Math.ceil((to - from) / spacing), 1);
  return Array.from({ length: count + 1 }, (_, index) => from + index * spacing);
}

/** Keeps the nodes around a point of a road below it, so that no triangle of the ground comes through the road. */
function lower(heights: Float32Array, isKnown: Uint8Array, xs: number[], ys: number[], spacing: number, x: number, y: number, z: number): void {
  const column = Math.floor((x - xs[0]) / spacing);
  const row = Math.floor((y - ys[0]) / spacing);
  for (let j = Math.max(row - 1, 0); j <= Math.min(row + 2, ys.length - 1); j += 1) {
    for (let i = Math.max(column - 1, 0); i <= Math.min(column + 2, xs.length - 1); i += 1) {
      const node = j * xs.length + i;
      if (!isKnown[node] || z < heights[node]) heights[node] = z;
      isKnown[node] = 1;
    }
  }
}

/** Gives nodes without a height the mean of their neighbours that have one, from the roads outwards. */
function spread(heights: Float32Array, columns: number, rows: number): void {
  let front: number[] = [];
  heights.forEach((height, node) => Number.isNaN(height) || front.push(node));
  if (front.length === 0) heights.fill(-BELOW_ROAD_M);
  while (front.length > 0) {
    const reached = new Map<number, number>();
    for (const node of front) {
      for (const next of neighbours(node, columns, rows)) if (Number.isNaN(heights[next])) reached.set(next, 0);
    }
    for (const node of reached.keys()) reached.set(node, mean(heights, neighbours(node, columns, rows)));
    for (const [node, height] of reached) heights[node] = height;
    front = [...reached.keys()];
  }
}

function smooth(heights: Float32Array, isKnown: Uint8Array, columns: number, rows: number): void {
  for (let node = 0; node < heights.length; node += 1) {
    if (!isKnown[node]) heights[node] = mean(heights, neighbours(node, columns, rows));
  }
}

function neighbours(node: number, columns: number, rows: number): number[] {
  const [column, row] = [node % columns, Math.floor(node / columns)];
  const found: number[] = [];
  if (column > 0) found.push(node - 1);
  if (column < columns - 1) found.push(node + 1);
  if (row > 0) found.push(node - columns);
  if (row < rows - 1) found.push(node + columns);
  return found;
}

function mean(heights: Float32Array, nodes: number[]): number {
  let [sum, count] = [0, 0];
  for (const node of nodes) {
    if (Number.isNaN(heights[node])) continue;
    sum += heights[node];
    count += 1;
  }
  return sum / count;
}
