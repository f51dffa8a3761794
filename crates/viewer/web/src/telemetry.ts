import type { State } from './state.ts';
import type { TrafficView } from './traffic_view.ts';

/** Vehicles are counted less often than in every picture. */
const COUNTS_EVERY_MS = 150;

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
  /** Where lights, lanelets and vehicles are in the window [px]. */
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
  private counts: Counts = { vehicles: 0, ofTwin: 0, differ: null };
  private counted_ms = 0;

  note(whole_ms: number, drawCalls: number): void {
    this.pictures += 1;
    this.drawCalls = drawCalls;
    if (whole_ms > 0) this.fps += (1000 / whole_ms - this.fps) * 0.05;
  }

  publish(view: TrafficView, state: State, now_ms: number): void {
    if (now_ms - this.counted_ms > COUNTS_EVERY_MS) {
      this.counts = counts(view, state);
      this.counted_ms = now_ms;
    }
    const { vehicles, ofTwin, differ } = this.counts;
    const { x, y, distance, azimuth, tilt } = view.stage.rig.now;
    window.laneweave = {
      ready: view.traffic.playback.next !== null,
      drawCalls: this.drawCalls,
      pictures: this.pictures,
      fps: this.fps,
      vehicles,
      twin: { view: state.twinView.value, vehicles: ofTwin, differ },
      colour: state.colour.value,
      time_s: view.traffic.playback.time_s,
      selected: state.selected.value,
      places: (of) => PLACES[of](view),
      camera: { mode: state.camera.value, x, y, distance, azimuth, tilt },
    };
  }
}

interface Counts {
  vehicles: number;
  ofTwin: number;
  differ: number | null;
}

const counts = ({ traffic }: TrafficView, { colour }: State): Counts => ({
  vehicles: traffic.count(false),
  ofTwin: traffic.count(true),
  differ: colour.value === 'difference' ? traffic.countDifferent() : null,
});

const vehicles = (view: TrafficView): Place[] => view.traffic.all().map(({ id, x, y }) => ({ id, ...view.pixel(x, y, id.startsWith('-')) }));

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
