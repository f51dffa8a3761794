import { Vector3, type PerspectiveCamera } from 'three';

const CORNERS = [
  [-1, -1],
  [1, -1],
  [1, 1],
  [-1, 1],
] as const;
const MARGIN = 0.1;

const way = new Vector3();

/** Where the line of sight through a place of the window, from -1 to 1, meets a height; null if it looks above the horizon. */
export function groundAt(camera: PerspectiveCamera, across: number, up: number, height: number): { x: number; y: number } | null {
  way.set(across, up, 0.5).unproject(camera).sub(camera.position);
  if (way.z > -1e-6) return null;
  const share = (height - camera.position.z) / way.z;
  return { x: camera.position.x + way.x * share, y: camera.position.y + way.y * share };
}

/** Where a point is in the window, from -1 to 1. */
export function windowAt(camera: PerspectiveCamera, x: number, y: number, z: number): { across: number; up: number } {
  way.set(x, y, z).project(camera);
  return { across: way.x, up: way.y };
}

/** The rectangle of the ground in the window, no further from the camera than `reach`. */
export function groundRectangle(camera: PerspectiveCamera, height: number, reach: number): [number, number, number, number] {
  const { x: cx, y: cy } = camera.position;
  let [x0, y0, x1, y1] = [cx, cy, cx, cy];
  let isFirst = true;
  for (const [across, up] of CORNERS) {
    way.set(across, up, 0.5).unproject(camera).sub(camera.position);
    const flat = Math.hypot(way.x, way.y) || 1;
    const hit = way.z < -1e-6 ? ((height - camera.position.z) / way.z) * flat : Infinity;
    const share = Math.min(hit, reach) / flat;
    const [x, y] = [cx + way.x * share, cy + way.y * share];
    [x0, y0, x1, y1] = isFirst ? [x, y, x, y] : [Math.min(x0, x), Math.min(y0, y), Math.max(x1, x), Math.max(y1, y)];
    isFirst = false;
  }
  const [mx, my] = [(x1 - x0) * MARGIN, (y1 - y0) * MARGIN];
  return [x0 - mx, y0 - my, x1 + mx, y1 + my];
}
