/** What stands still, as the server describes it. Coordinates are relative to `origin`, in metres. */

/** A line: x, y, z, x, y, z, … */
export type Line = number[];

export type Point = [x: number, y: number, z: number];

export type Paint =
  | 'dashed'
  | 'solid'
  | 'dashed_solid'
  | 'solid_dashed'
  | 'solid_solid'
  | 'dashed_dashed'
  | 'curb'
  | 'barrier'
  | 'edge'
  | 'virtual';

export interface Lanelet {
  id: string;
  left: Line;
  right: Line;
  centre: Line;
  limit_kmh: number | null;
  is_conflict: boolean;
  /** Who may use it, if these are not all vehicles. */
  only_for: string | null;
}

export interface Marking {
  line: Line;
  paint: Paint;
  is_thick: boolean;
}

export interface StopLine {
  line: Line;
  kind: 'light' | 'stop_sign' | 'all_way_stop' | 'line';
  light: number | null;
}

export interface Plan {
  /** The first light of the plan: lights with the same one share it. */
  first: number;
  cycle_s: number;
  offset_s: number;
}

export interface Light {
  id: string;
  /** Null for a light that is always green, or whose greens traffic extends. */
  plan: Plan | null;
  at: Point[];
}

export interface Gate {
  id: string;
  at: Point;
  heading: number;
}

export interface Scene {
  version: number;
  title: string;
  driving_side: 'left' | 'right';
  origin: Point;
  bounds: [x0: number, y0: number, x1: number, y1: number];
  lanelets: Lanelet[];
  markings: Marking[];
  crosswalks: Line[];
  stop_lines: StopLine[];
  lights: Light[];
  entrances: Gate[];
  exits: Gate[];
}
