import { Matrix4, PerspectiveCamera, Vector3 } from 'three';

const FIELD_OF_VIEW_DEG = 42;
const NEAREST_M = 12;
const FURTHEST_M = 40_000;
const ASLANT = 0.95;
const STEEPEST = 1.48;
/** Share of the way to the goal that is left after a second. */
const EASE = 4e-5;

interface Pose {
  x: number;
  y: number;
  z: number;
  distance: number;
  /** Clockwise from north, the direction in which the camera looks. */
  azimuth: number;
  /** 0 looks straight down. */
  tilt: number;
}

/** A camera that looks at a point of the ground from a distance. It glides to its goal. */
export class Rig {
  readonly camera = new PerspectiveCamera(FIELD_OF_VIEW_DEG, 1, 0.5, 10_000);
  readonly goal: Pose = { x: 0, y: 0, z: 0, distance: 300, azimuth: 0, tilt: ASLANT };
  readonly now: Pose = { ...this.goal };
  private readonly basis = new Matrix4();
  private readonly right = new Vector3();
  private readonly up = new Vector3();
  private readonly back = new Vector3();

  /** Shows a rectangle of the ground, filling the window. */
  frame(x0: number, y0: number, x1: number, y1: number): void {
    const half = Math.tan((FIELD_OF_VIEW_DEG * Math.PI) / 360);
    const fit = Math.max((y1 - y0) / 2 / half, (x1 - x0) / 2 / half / this.camera.aspect);
    Object.assign(this.goal, { x: (x0 + x1) / 2, y: (y0 + y1) / 2, azimuth: 0, distance: clampDistance(fit * 1.12) });
  }

  /** Moves the point that is looked at, by metres to the right and ahead in the window. */
  pan(right: number, ahead: number): void {
    const { azimuth } = this.goal;
    this.goal.x += Math.cos(azimuth) * right + Math.sin(azimuth) * ahead;
    this.goal.y += -Math.sin(azimuth) * right + Math.cos(azimuth) * ahead;
  }

  /** Zooms; a point of the ground keeps its place in the window. */
  zoom(factor: number, x = this.goal.x, y = this.goal.y): void {
    const distance = clampDistance(this.goal.distance * factor);
    const share = 1 - distance / this.goal.distance;
    this.goal.x += (x - this.goal.x) * share;
    this.goal.y += (y - this.goal.y) * share;
    this.goal.distance = distance;
  }

  turn(azimuth: number, tilt: number): void {
    this.goal.azimuth += azimuth;
    this.goal.tilt = Math.min(Math.max(this.goal.tilt + tilt, 0), STEEPEST);
  }

  /** Looks straight down with north above, or aslant again. */
  toggleMap(): void {
    const isMap = this.goal.tilt < 0.02;
    Object.assign(this.goal, isMap ? { tilt: ASLANT } : { tilt: 0, azimuth: Math.round(this.goal.azimuth / (2 * Math.PI)) * 2 * Math.PI });
  }

  /** Stands at its goal at once. */
  settle(): void {
    Object.assign(this.now, this.goal);
  }

  update(elapsed_s: number): void {
    const share = 1 - EASE ** elapsed_s;
    const { now, goal } = this;
    for (const key of ['x', 'y', 'z', 'azimuth', 'tilt'] as const) now[key] += (goal[key] - now[key]) * share;
    now.distance *= (goal.distance / now.distance) ** share;
    const [s, c] = [Math.sin(now.tilt), Math.cos(now.tilt)];
    const [fx, fy] = [Math.sin(now.azimuth), Math.cos(now.azimuth)];
    this.look(fx * s, fy * s, -c, fx * c, fy * c, s);
    this.camera.position.set(now.x - fx * s * now.distance, now.y - fy * s * now.distance, now.z + c * now.distance);
    this.reach(Math.min(Math.max(now.distance * 0.04, 0.3), 200), now.distance * 12 + 6000);
  }

  /** Sees what a driver sees, at a place, in a direction counter-clockwise from east. */
  sitAt(x: number, y: number, z: number, heading: number): void {
    const [fx, fy] = [Math.cos(heading), Math.sin(heading)];
    const [s, c] = [0.998, 0.06];
    this.look(fx * s, fy * s, -c, fx * c, fy * c, s);
    this.camera.position.set(x, y, z);
    this.reach(0.15, 6000);
  }

  private look(dx: number, dy: number, dz: number, ux: number, uy: number, uz: number): void {
    this.back.set(-dx, -dy, -dz);
    this.up.set(ux, uy, uz);
    this.right.crossVectors(this.up, this.back);
    this.camera.quaternion.setFromRotationMatrix(this.basis.makeBasis(this.right, this.up, this.back));
  }

  private reach(near: number, far: number): void {
    this.camera.near = near;
    this.camera.far = far;
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
  }
}

const clampDistance = (distance: number): number => Math.min(Math.max(distance, NEAREST_M), FURTHEST_M);
