import { EVENT_LOOKS, isImportant, lookOf, SHAPE_PATHS, type EventLook } from '../colour/events.ts';
import type { TrafficEvent } from '../protocol/messages.ts';
import type { State } from '../state.ts';
import { drawn, element, say } from './dom.ts';
import { clockTime } from './words.ts';

const MOST_LINES = 200;

/** A small drawing of the mark of an event. */
export function markDrawing({ shape, colour }: EventLook): SVGSVGElement {
  const path = drawn('path', { d: SHAPE_PATHS[shape], fill: colour, 'fill-rule': 'evenodd' });
  return drawn('svg', { viewBox: '-1.4 -1.4 2.8 2.8', class: 'mark', 'aria-hidden': 'true' }, path);
}

/** The list of collisions, emergency brakings and missed turns; a click goes there. */
export class MarksPanel {
  readonly root = element('section', { class: 'panel', 'data-test': 'panel-marks', 'aria-label': 'Important marks' });
  private readonly list = element('ul', { class: 'marks' });
  private readonly none = element('p', { class: 'soft' });
  /** Those of traffic that is simulated now; a run tells all of its marks. */
  private heard: TrafficEvent[] = [];
  private shown = '';

  constructor(
    private readonly state: State,
    private readonly go: (event: TrafficEvent) => void,
  ) {
    this.root.hidden = true;
    this.root.append(element('h2', {}, 'Important marks'), this.none, this.list);
    state.hello.watch((hello) => {
      this.heard = [];
      this.show([]);
      say(this.none, hello?.kind === 'recording' ? 'Recordings are searched for lane changes only.' : 'No collision, no emergency braking and no missed turn so far.');
    });
    state.marks.watch((marks) => marks && this.show(marks.marks.filter(isImportant)));
    state.events.listen((events) => {
      if (state.hello.value?.kind !== 'live') return;
      this.heard = [...this.heard, ...events.filter(isImportant)].slice(-MOST_LINES);
      this.show(this.heard);
    });
  }

  private show(marks: TrafficEvent[]): void {
    const now = `${marks.length} ${marks.at(-1)?.time_s}`;
    if (now === this.shown) return;
    this.shown = now;
    this.none.hidden = marks.length > 0;
    this.list.replaceChildren(...marks.slice(-MOST_LINES).map((mark) => this.line(mark)));
  }

  private line(mark: TrafficEvent): HTMLLIElement {
    const who = [mark.vehicle, mark.other].filter((id) => id !== null).join(' and ');
    const words = `${clockTime(mark.time_s)}  ${EVENT_LOOKS[mark.kind].name}${who ? `: ${who}` : ''}`;
    const jump = element('button', { type: 'button', class: 'line' }, markDrawing(lookOf(mark)), words);
    jump.addEventListener('click', () => {
      if (this.state.hello.value?.can.seek) this.state.say({ seek: mark.time_s });
      this.go(mark);
    });
    return element('li', {}, jump);
  }
}
