import type { Lanelet } from '../protocol/scene.ts';

const CELL_M = 40;

interface Shape {
  ring: number[];
  lanelet: number;
}

/** Finds the lanelet under a point. */
export class LaneletIndex {
  private readonly cells = new Map<string, Shape[]>();
  private readonly byId = new Map<string, number>();

  constructor(private readonly lanelets: readonly Lanelet[]) {
    lanelets.forEach((lanelet, index) => {
      this.byId.set(lanelet.id, index);
      this.add({ ring: ring(lanelet), lanelet: index });
    });
  }

  index(id: string): number | undefined {
    return this.byId.get(id);
  }

  /** The lanelet at a point; one that crosses no other is preferred. */
  at(x: number, y: number): number | null {
    let found: number | null = null;
    for (const { ring: outline, lanelet } of this.cells.get(cellName(x, y)) ?? []) {
      if (!isInside(outline, x, y)) continue;
      if (!this.lanelets[lanelet].is_conflict) return lanelet;
      found ??= lanelet;
    }
    return found;
  }

  /** Whether there is a road at a point, at about a height. */
  hasRoadNear(x: number, y: number, height: number, apart: number): boolean {
    return (this.cells.get(cellName(x, y)) ?? []).some(({ ring: outline }) => Math.abs(outline[2] - height) < apart && isInside(outline, x, y));
  }

  /** Whether a road goes through below a point. */
  hasRoadBelow(x: number, y: number, height: number): boolean {
    return (this.cells.get(cellName(x, y)) ?? []).some(({ ring: outline }) => outline[2] < height && isInside(outline, x, y));
  }

  /** The height of the road at a point, or of the point of a lane that is nearest in the same part of the map. */
  height(x: number, y: number): number {
    let best = { height: 0, square: Infinity };
    for (const { ring: outline } of this.cells.get(cellName(x, y)) ?? []) {
      for (let at = 0; at < outline.length; at += 3) {
        const square = (outline[at] - x) ** 2 + (outline[at + 1] - y) ** 2;
        if (square < best.square) best = { height: outline[at + 2], square };
      }
    }
    return best.height;
  }

  private add(shape: Shape): void {
    let [x0, y0, x1, y1] = [Infinity, Infinity, -Infinity, -Infinity];
    for (let at = 0; at < shape.ring.length; at += 3) {
      x0 = Math.min(x0, shape.ring[at]);
      x1 = Math.max(x1, shape.ring[at]);
      y0 = Math.min(y0, shape.ring[at + 1]);
      y1 = Math.max(y1, shape.ring[at + 1]);
    }
    for (let x = Math.floor(x0 / CELL_M); x <= Math.floor(x1 / CELL_M); x += 1) {
      for (let y = Math.floor(y0 / CELL_M); y <= Math.floor(y1 / CELL_M); y += 1) {
        const name = `${x} ${y}`;
        const cell = this.cells.get(name);
        if (cell) cell.push(shape);
        else this.cells.set(name, [shape]);
      }
    }
  }
}

const cellName = (x: number, y: number): string => `${Math.floor(x / CELL_M)} ${Math.floor(y / CELL_M)}`;

/** The outline of a lanelet: its left border, then its right one backwards. */
function ring({ left, right }: Lanelet): number[] {
  const outline = [...left];
  for (let at = right.length - 3; at >= 0; at -= 3) outline.push(right[at], right[at + 1], right[at + 2]);
  return outline;
}

function isInside(outline: number[], x: number, y: number): boolean {
  let inside = false;
  for (let at = 0, last = outline.length - 3; at < outline.length; last = at, at += 3) {
    const [ax, ay, bx, by] = [outline[at], outline[at + 1], outline[last], outline[last + 1]];
    if (ay > y !== by > y && x < ((bx - ax) * (y - ay)) / (by - ay) + ax) inside = !inside;
  }
  return inside;
}
