import type { Point, Scene, StopLine } from '../protocol/scene.ts';
import type { LaneletIndex } from './lanelet_index.ts';

/** Where the head of a signal hangs, and where its post stands. */
export interface SignalPlace {
  light: number;
  head: Point;
  /** The foot of the post; null where the head hangs without one. */
  foot: Point | null;
  /** The direction in which the head looks, against the traffic. */
  facing: [x: number, y: number];
}

const POST_BESIDE_M = 1.1;
const POST_HEIGHT_M = 3.4;
const OVERHEAD_M = 5.6;
const FURTHEST_POST_M = 12;
const SEARCH_STEP_M = 0.5;

/** A place for each stop line of a light, else one for each point where the map has the light. */
export function signalPlaces(scene: Scene, index: LaneletIndex): SignalPlace[] {
  const places: SignalPlace[] = [];
  const hasStopLine = new Set<number>();
  for (const stop of scene.stop_lines) {
    if (stop.light === null || stop.line.length < 6) continue;
    hasStopLine.add(stop.light);
    places.push(atStopLine(stop, stop.light, scene, index));
  }
  scene.lights.forEach(({ at }, light) => {
    if (hasStopLine.has(light)) return;
    for (const [x, y, z] of at) {
      const isOnRoad = index.at(x, y) !== null;
      const head: Point = [x, y, z + (isOnRoad ? OVERHEAD_M : POST_HEIGHT_M)];
      const facing = against(x, y, scene);
      places.push({ light, head, foot: isOnRoad ? null : [x, y, z], facing });
    }
  });
  return places;
}

function atStopLine(stop: StopLine, light: number, scene: Scene, index: LaneletIndex): SignalPlace {
  const { line } = stop;
  const last = line.length - 3;
  const middle: Point = [(line[0] + line[last]) / 2, (line[1] + line[last + 1]) / 2, (line[2] + line[last + 2]) / 2];
  const facing = against(middle[0], middle[1], scene);
  // Towards the side of the road on which people drive, seen in their direction.
  const sign = scene.driving_side === 'right' ? -1 : 1;
  const outward: [number, number] = [facing[1] * sign, -facing[0] * sign];
  const half = Math.hypot(line[last] - line[0], line[last + 1] - line[1]) / 2;
  for (let way = half + POST_BESIDE_M; way < FURTHEST_POST_M; way += SEARCH_STEP_M) {
    const x = middle[0] + outward[0] * way;
    const y = middle[1] + outward[1] * way;
    if (index.at(x, y) !== null) continue;
    const foot: Point = [x, y, middle[2]];
    const isBeside = way < half + POST_BESIDE_M + 1;
    const head: Point = isBeside ? [x, y, middle[2] + POST_HEIGHT_M] : [middle[0], middle[1], middle[2] + OVERHEAD_M];
    return { light, head, foot, facing };
  }
  return { light, head: [middle[0], middle[1], middle[2] + OVERHEAD_M], foot: null, facing };
}

/** The direction against the traffic of the lane whose end is nearest. */
function against(x: number, y: number, scene: Scene): [number, number] {
  let best = { square: Infinity, way: [1, 0] as [number, number] };
  for (const { centre } of scene.lanelets) {
    const last = centre.length - 3;
    if (last < 3) continue;
    const square = (centre[last] - x) ** 2 + (centre[last + 1] - y) ** 2;
    if (square >= best.square) continue;
    const [dx, dy] = [centre[last - 3] - centre[last], centre[last - 2] - centre[last + 1]];
    const length = Math.hypot(dx, dy) || 1;
    best = { square, way: [dx / length, dy / length] };
  }
  return best.way;
}
