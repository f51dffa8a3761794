import type { Line } from '../protocol/scene.ts';

/** A point of a line, with the direction to its left and the way from the first point. */
export interface Station {
  x: number;
  y: number;
  z: number;
  leftX: number;
  leftY: number;
  along: number;
}

/** How much a corner may stretch a ribbon. */
const LONGEST_MITRE = 2;

/** The points of a line, less those that repeat the one before. */
export function stations(line: Line): Station[] {
  const points: Station[] = [];
  for (let at = 0; at + 2 < line.length; at += 3) {
    const [x, y, z] = [line[at], line[at + 1], line[at + 2]];
    const last = points.at(-1);
    const step = last ? Math.hypot(x - last.x, y - last.y) : 0;
    if (last && step < 1e-3) continue;
    points.push({ x, y, z, leftX: 0, leftY: 0, along: last ? last.along + step : 0 });
  }
  for (let index = 0; index < points.length; index += 1) turnLeft(points, index);
  return points;
}

/** Sets the direction to the left, so that a ribbon has the same width before and after a corner. */
function turnLeft(points: Station[], index: number): void {
  const here = points[index];
  const before = direction(points[index - 1] ?? here, index > 0 ? here : (points[1] ?? here));
  const after = direction(index + 1 < points.length ? here : (points[index - 1] ?? here), points[index + 1] ?? here);
  const x = -(before.y + after.y);
  const y = before.x + after.x;
  const length = Math.hypot(x, y);
  if (length < 1e-6) {
    here.leftX = -after.y;
    here.leftY = after.x;
    return;
  }
  // The longer the sum of the two unit directions, the gentler the corner.
  const stretch = Math.min(2 / length, LONGEST_MITRE);
  here.leftX = (x / length) * stretch;
  here.leftY = (y / length) * stretch;
}

function direction(from: Station, to: Station): { x: number; y: number } {
  const length = Math.hypot(to.x - from.x, to.y - from.y);
  return length > 0 ? { x: (to.x - from.x) / length, y: (to.y - from.y) / length } : { x: 0, y: 0 };
}

/** Pairs of points of two borders, such that quadrilaterals between consecutive pairs fill the lane. */
export function pairs(left: Station[], right: Station[]): [Station, Station][] {
  if (left.length < 2 || right.length < 2) return [];
  const leftLength = left.at(-1)!.along;
  const rightLength = right.at(-1)!.along;
  const found: [Station, Station][] = [[left[0], right[0]]];
  let [i, j] = [0, 0];
  while (i < left.length - 1 || j < right.length - 1) {
    const nextLeft = i + 1 < left.length ? left[i + 1].along / leftLength : Infinity;
    const nextRight = j + 1 < right.length ? right[j + 1].along / rightLength : Infinity;
    if (Math.abs(nextLeft - nextRight) < 1e-3) {
      i += 1;
      j += 1;
    } else if (nextLeft < nextRight) {
      i += 1;
    } else {
      j += 1;
    }
    found.push([left[i], right[j]]);
  }
  return found;
}
