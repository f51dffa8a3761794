import type { State } from '../state.ts';
import type { TrafficView } from '../traffic_view.ts';
import { arrowsMesh } from './arrows.ts';
import { EventMarks, SHOWN_FOR_S } from './event_marks.ts';
import { tintLanes } from './lane_tints.ts';
import { TrailLines } from './trails.ts';

/** After a jump in time the marks of the minute before it are shown anew. */
const JUMP_S = 5;

/** Draws on the road what the user asks for: tints, arrows, trails, and marks of events. */
export function dress(view: TrafficView, state: State): void {
  const { stage, scene, traffic, index } = view;
  tintLanes(state, view.surface, index);
  const marks = new EventMarks();
  const trails = new TrailLines();
  stage.graph.add(marks.mesh, trails.mesh);
  state.showsChanges.watch((isShown) => marks.show(isShown));
  const heightAt = (x: number, y: number): number => index.height(x, y);
  state.events.listen((events) => marks.add(events, scene.origin, heightAt));
  state.trails.watch(() => trails.clear());
  state.hello.watch(() => {
    marks.clear();
    trails.clear();
  });
  let arrows: ReturnType<typeof arrowsMesh> | null = null;
  state.showsArrows.watch((isShown) => {
    if (isShown && !arrows) {
      arrows = arrowsMesh(scene);
      stage.graph.add(arrows);
    }
    if (arrows) arrows.visible = isShown;
  });
  let last_s = 0;
  view.onPicture.push(() => {
    const { time_s } = traffic.playback;
    if (Math.abs(time_s - last_s) > JUMP_S) {
      const known = state.marks.value?.marks;
      if (known || time_s < last_s) marks.clear();
      if (known) marks.add(known.filter((mark) => mark.time_s <= time_s && mark.time_s > time_s - SHOWN_FOR_S), scene.origin, heightAt);
    }
    last_s = time_s;
    trails.add(traffic, scene.origin, state.trails.value, state.selected.value);
    trails.update(time_s);
    marks.update(time_s);
  });
}
