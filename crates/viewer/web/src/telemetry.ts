import type { State } from './state.ts';
import type { TrafficView } from './traffic_view.ts';

const FRAMES = 120;
const VEHICLES_EVERY = 10;

/** What tests and the curious read from `window.laneweave`. */
export interface Published {
  ready: boolean;
  drawCalls: number;
  /** The median of the last pictures. */
  scriptMs: number;
  scriptMsWorst: number;
  fps: number;
  vehicles: number;
  /** How the twin is shown, its vehicles in view, and those in view, of both, that differ; null where their colours tell something else. */
  twin: { view: string; vehicles: number; differ: number | null };
  colour: string;
  time_s: number;
  selected: string[];
  /** Where lights and lanelets are in the window [px]. */
  places: (of: 'lights' | 'lanelets') => Place[];
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

/** Measures how long pictures take. */
export class Telemetry {
  fps = 60;
  private readonly script = new Float64Array(FRAMES);
  private readonly sorted = new Float64Array(FRAMES);
  private noted = 0;
  private drawCalls = 0;
  private vehicles = 0;

  note(script_ms: number, whole_ms: number, drawCalls: number): void {
    this.script[this.noted % FRAMES] = script_ms;
    this.noted += 1;
    this.drawCalls = drawCalls;
    if (whole_ms > 0) this.fps += (1000 / whole_ms - this.fps) * 0.05;
  }

  publish(view: TrafficView, state: State): void {
    if (this.noted % VEHICLES_EVERY !== 1) {
      if (window.laneweave) window.laneweave.time_s = view.traffic.playback.time_s;
      return;
    }
    this.vehicles = view.traffic.count(false);
    this.sorted.set(this.script);
    const known = this.sorted.subarray(0, Math.min(this.noted, FRAMES)).sort();
    const { x, y, distance, azimuth, tilt } = view.stage.rig.now;
    window.laneweave = {
      ready: view.traffic.playback.next !== null,
      drawCalls: this.drawCalls,
      scriptMs: known[known.length >> 1],
      scriptMsWorst: known[known.length - 1],
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
      places: (of) => (of === 'lights' ? lights(view) : lanelets(view)),
      camera: { mode: state.camera.value, x, y, distance, azimuth, tilt },
    };
  }
}

const lights = (view: TrafficView): Place[] =>
  view.signals.map(({ light, head: [x, y] }) => ({ id: view.scene.lights[light].id, ...view.pixel(x, y) }));

/** The middle of each lanelet. */
function lanelets(view: TrafficView): Place[] {
  return view.scene.lanelets.map(({ id, centre }) => {
    const middle = 3 * Math.floor(centre.length / 6);
    return { id, ...view.pixel(centre[middle], centre[middle + 1]) };
  });
}
