/** The messages of the protocol of the viewer, version 1. */

export type Side = 'left' | 'right';
export type ColourBy = 'style' | 'desire' | 'delay' | 'since_change' | 'difference';
export type VehicleClass = 'car' | 'truck' | 'bus' | 'motorcycle' | 'other';
export type LightShows = 'green' | 'yellow' | 'red';

export interface Parameter {
  key: string;
  unit: string;
  value: number;
  minimum: number | null;
  maximum: number | null;
}

export interface Style {
  name: string;
  description: string;
  /** Its share among the drivers who arrive, against those of the others. */
  weight?: number;
  parameters: Parameter[];
}

export interface Demand {
  origin: string;
  vehicles_per_hour: number;
}

export interface Hello {
  version: number;
  kind: 'live' | 'run' | 'recording';
  title: string;
  step_s: number;
  time_s: number;
  begin_s: number;
  end_s: number | null;
  can: { hands: boolean; seek: boolean; explain: boolean; twin: boolean };
  styles: Style[];
  demand: Demand[];
}

export interface Clock {
  time_s: number;
  is_playing: boolean;
  /** How many times as fast as reality; null: as fast as it goes. */
  factor: number | null;
  vehicles: number;
  waiting: number;
}

export interface Row {
  name: string;
  yield: number;
  weight: number;
  product: number;
}

export interface SideAccount {
  side: Side;
  gain: number | null;
  threshold: number | null;
  probability: number | null;
  is_out_of_question: boolean;
  rows: Row[];
}

export interface Driver {
  id: string;
  class: VehicleClass;
  style: string | null;
  state: string | null;
  side: Side | null;
  concentration: string | null;
  speed_kmh: number;
  desired_kmh: number | null;
  acceleration_mps2: number | null;
  x: number;
  y: number;
  length_m: number;
  lanelet: string | null;
  position_m: number | null;
  destination: string | null;
  is_external: boolean | null;
  leader: { id: string; gap_m: number; speed_kmh: number } | null;
  sides: SideAccount[];
  gap_test: string | null;
  act: string | null;
  story: string | null;
}

export type TrafficEventKind = 'lane_change' | 'collision' | 'emergency_braking' | 'missed_turn';

export interface TrafficEvent {
  kind: TrafficEventKind;
  time_s: number;
  x: number;
  y: number;
  vehicle: string | null;
  other: string | null;
  side: Side | null;
  text: string | null;
}

export interface Marks {
  until_s: number;
  marks: TrafficEvent[];
}

export type LaneMeasure = [
  lanelet: number,
  density_veh_km: number,
  speed_kmh: number | null,
  flow_veh_h: number,
  changes_km_h: number,
];

export interface HandEntry {
  number: number;
  time_s: number;
  text: string;
  is_undone: boolean;
}

/** What was done by hand and is set by it; after the first message, what of this is new or has changed. */
export interface Hands {
  done: HandEntry[];
  set: Hand[];
}

/** The twin that is shown beside the traffic. */
export interface Twin {
  since_s: number;
  /** What the twin has that the traffic has not; nothing where only the traffic is changed, by hand. */
  settings: string[];
}

export interface Saved {
  folder: string;
  scenario: string;
}

export interface Refused {
  what: string;
  remedy: string;
}

export interface Found {
  id: string;
  x?: number;
  y?: number;
}

/** What the server says: each message has one of these keys. */
export interface ServerMessage {
  hello?: Hello;
  clock?: Clock;
  lights?: string;
  twin_lights?: string;
  drivers?: Driver[];
  found?: Found;
  events?: TrafficEvent[];
  marks?: Marks;
  lanes?: LaneMeasure[];
  hands?: Hands;
  put?: string;
  saved?: Saved;
  twin?: Twin | null;
  refused?: Refused;
}

export type Hand =
  | { set_parameter: { style: string; parameter: string; value: number } }
  | { set_demand: { origin: string; vehicles_per_hour: number } }
  | { set_share: { style: string; weight: number } }
  | { set_light: { light: string; shows: LightShows | null } }
  | { set_offset: { light: string; offset_s: number } }
  | { close_lanelet: { lanelet: string; is_closed: boolean } }
  | { put: { x: number; y: number; class: VehicleClass } }
  | { drive: { vehicle: string; speed_kmh: number | null; side: Side | null } }
  | { set_style: { vehicle: string; style: string } }
  | { remove: { vehicle: string } };

/** What the page says: each message has one key. */
export type PageMessage =
  | { ready: number }
  | { view: [x0: number, y0: number, x1: number, y1: number] }
  | { play: number | null }
  | { pause: true }
  | { step: number }
  | { seek: number }
  | { select: string[] }
  | { find: string }
  | { colour: ColourBy }
  | { lanes: boolean }
  | { hand: Hand }
  | { twin: boolean }
  | { undo: true }
  | { save: true };
