import type { Lanelet, Scene } from '../protocol/scene.ts';

/** A map that is no larger than this is shown as a whole at first. */
const WHOLE_M = 1500;
/** Of a larger one, this much is shown: enough to see single vehicles. */
const PART_M = 700;
const CELL_M = 350;

type Box = [x0: number, y0: number, x1: number, y1: number];

/** The part of a map with which a page opens: all of it, or of a large map the place with most road. */
export function opening({ bounds, lanelets }: Pick<Scene, 'bounds' | 'lanelets'>): Box {
  const [x0, y0, x1, y1] = bounds;
  if (Math.max(x1 - x0, y1 - y0) <= WHOLE_M || lanelets.length === 0) return [x0, y0, x1, y1];
  const [x, y] = busiest(lanelets);
  return [x - PART_M / 2, y - PART_M / 2, x + PART_M / 2, y + PART_M / 2];
}

/** The middle of the cell through which most metres of lanes lead. */
function busiest(lanelets: readonly Pick<Lanelet, 'centre'>[]): [x: number, y: number] {
  const cells = new Map<string, { metres: number; x: number; y: number }>();
  for (const { centre } of lanelets) {
    for (let at = 0; at + 5 < centre.length; at += 3) {
      const [x, y] = [(centre[at] + centre[at + 3]) / 2, (centre[at + 1] + centre[at + 4]) / 2];
      const metres = Math.hypot(centre[at + 3] - centre[at], centre[at + 4] - centre[at + 1]);
      const key = `${Math.floor(x / CELL_M)} ${Math.floor(y / CELL_M)}`;
      const cell = cells.get(key) ?? { metres: 0, x: 0, y: 0 };
      cells.set(key, { metres: cell.metres + metres, x: cell.x + metres * x, y: cell.y + metres * y });
    }
  }
  const [{ metres, x, y }] = [...cells.values()].sort((a, b) => b.metres - a.metres);
  return [x / Math.max(metres, 1), y / Math.max(metres, 1)];
}
