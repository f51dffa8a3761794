import { rgb } from '../colour/palette.ts';
import { colourAt, HEAT_SCALES, type Heat } from '../colour/scales.ts';
import type { LaneMeasure } from '../protocol/messages.ts';
import type { LaneletIndex } from '../road/lanelet_index.ts';
import type { RoadSurface } from '../road/surface.ts';
import type { State } from '../state.ts';

const SELECTED = rgb('#3f8cff');
const CLOSED = rgb('#ff5a3c');

/** Colours lanes: the heat map, the lane that is selected, and those that are closed. */
export function tintLanes(state: State, surface: RoadSurface, index: LaneletIndex): void {
  /** Lanelets that were closed when the twin began. */
  let closedBefore: ReadonlySet<string> = new Set();
  const update = () => {
    surface.clear();
    const { value: heat } = state.heat;
    if (heat !== 'none') paintHeat(heat, state.lanes.value, surface);
    if (state.lane.value !== null) surface.mark(state.lane.value, SELECTED);
    for (const id of state.closed.value) {
      const lanelet = index.index(id);
      if (lanelet !== undefined) surface.close(lanelet, CLOSED, closedBefore.has(id));
    }
  };
  let wants = false;
  const ask = () => {
    const now = state.heat.value !== 'none' || state.lane.value !== null;
    if (now !== wants) state.say({ lanes: now });
    wants = now;
    update();
  };
  state.heat.watch(ask);
  state.lane.watch(ask);
  state.lanes.watch(() => state.heat.value !== 'none' && update());
  state.closed.watch(update);
  state.twin.watch(() => {
    closedBefore = state.closed.value;
    update();
  });
  state.hello.watch(() => wants && state.say({ lanes: true }));
}

function paintHeat(heat: Exclude<Heat, 'none'>, measures: LaneMeasure[], surface: RoadSurface): void {
  const scale = HEAT_SCALES[heat];
  for (const [lanelet, density, speed, , changes] of measures) {
    const value = { density, speed, changes }[heat];
    if (value !== null) surface.tint(lanelet, colourAt(scale.colours, value / scale.top));
  }
}
