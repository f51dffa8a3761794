import type { State } from './state.ts';
import type { TrafficView } from './traffic_view.ts';

const VEHICLES_EVERY = 10;

/** What tests and the curious read from `window.laneweave`. */
export interface Published {
  ready: boolean;
  drawCalls: number;
  /** How many pictures were drawn, and how many are a second. */
  pictures: number;
  fps: number;
  vehicles: number;
  /** How the twin is shown, its vehicles in view, and those in view, of both, that differ; null where their colours tell something else. */
  twin: { view: string; vehicles: number; differ: number | null };
  colour: string;
  time_s: number;
  selected: string[];
  /** Where lights, lanelets and vehicles are in the window [px], as long as it shows one picture. */
  places: (of: keyof typeof PLACES) => Place[];
  camera: { mode: string; x: number; y: number; distance: number; azimuth: number; tilt: number };
}

export interface Place {
  id: string;
  left: number;
  top: number;
}

declare global {
  interface Window {
    laneweave?: Published;
  }
}

/** Counts pictures, and what they draw. */
export class Telemetry {
  fps = 60;
  private pictures = 0;
  private drawCalls = 0;
  private vehicles = 0;

  note(whole_ms: number, drawCalls: number): void {
    this.pictures += 1;
    this.drawCalls = drawCalls;
    if (whole_ms > 0) this.fps += (1000 / whole_ms - this.fps) * 0.05;
  }

  publish(view: TrafficView, state: State): void {
    if (this.pictures % VEHICLES_EVERY !== 1) {
      if (window.laneweave) Object.assign(window.laneweave, { pictures: this.pictures, time_s: view.traffic.playback.time_s });
      return;
    }
    this.vehicles = view.traffic.count(false);
    const { x, y, distance, azimuth, tilt } = view.stage.rig.now;
    window.laneweave = {
      ready: view.traffic.playback.next !== null,
      drawCalls: this.drawCalls,
      pictures: this.pictures,
      fps: this.fps,
      vehicles: this.vehicles,
      twin: {
        view: state.twinView.value,
        vehicles: view.traffic.count(true),
        differ: state.colour.value === 'difference' ? view.traffic.countDifferent() : null,
      },
      colour: state.colour.value,
      time_s: view.traffic.playback.time_s,
      selected: state.selected.value,
      places: (of) => PLACES[of](view),
      camera: { mode: state.camera.value, x, y, distance, azimuth, tilt },
    };
  }
}

const vehicles = (view: TrafficView): Place[] => view.traffic.all().map(({ id, x, y }) => ({ id, ...view.pixel(x, y) }));

const lights = (view: TrafficView): Place[] =>
  view.signals.map(({ light, head: [x, y] }) => ({ id: view.scene.lights[light].id, ...view.pixel(x, y) }));

/** The middle of each lanelet. */
function lanelets(view: TrafficView): Place[] {
  return view.scene.lanelets.map(({ id, centre }) => {
    const middle = 3 * Math.floor(centre.length / 6);
    return { id, ...view.pixel(centre[middle], centre[middle + 1]) };
  });
}

const PLACES = { lights, lanelets, vehicles };
