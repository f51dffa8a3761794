import type { Rig } from './camera/rig.ts';
import { toggle } from './panels/driver_panel.ts';
import type { TimeControls } from './panels/time_controls.ts';
import type { State } from './state.ts';

const PAN = 0.12;
const ZOOM = 1.25;
const TURN = 0.2;

type Moves = Record<string, (event: KeyboardEvent) => void>;

export interface KeyActs {
  wholeMap: () => void;
  toggleMap: () => void;
  toggleHands: () => void;
  help: () => void;
  find: () => void;
  undo: () => void;
  /** Shows the twin in the next way. */
  nextTwin: () => void;
  /** Selects what is in the middle of the picture; the second vehicle beside the first. */
  selectInMiddle: (isSecond: boolean) => void;
  /** Goes to the next mark, or the one before. */
  jump: (sign: 1 | -1) => void;
}

const SLIDER_KEYS = /^(Arrow|Page|Home|End)/;

/** Whether a key press belongs to a field, a list or a slider. */
export function isForField(event: KeyboardEvent): boolean {
  const target = event.target as HTMLElement;
  if (event.key === 'Escape') return false;
  if (target.matches('input[type=range], [role=slider]')) return SLIDER_KEYS.test(event.key);
  return target.matches('input, select, textarea');
}

/** The keys of the whole page. */
export function listenToKeys(state: State, rig: Rig, time: TimeControls, acts: KeyActs): void {
  const pan = (right: number, ahead: number) => () => rig.pan(right * rig.goal.distance * PAN, ahead * rig.goal.distance * PAN);
  const moves: Moves = {
    ArrowUp: pan(0, 1),
    ArrowDown: pan(0, -1),
    ArrowLeft: pan(-1, 0),
    ArrowRight: pan(1, 0),
    w: pan(0, 1),
    s: pan(0, -1),
    a: pan(-1, 0),
    d: pan(1, 0),
    '+': () => rig.zoom(1 / ZOOM),
    '=': () => rig.zoom(1 / ZOOM),
    '-': () => rig.zoom(ZOOM),
    q: () => rig.turn(-TURN, 0),
    e: () => rig.turn(TURN, 0),
    r: () => rig.turn(0, -TURN),
    t: () => rig.turn(0, TURN),
    Home: acts.wholeMap,
    m: acts.toggleMap,
    h: acts.toggleHands,
    g: acts.nextTwin,
    Enter: (event) => acts.selectInMiddle(event.shiftKey),
    '?': acts.help,
    '/': acts.find,
    ',': () => acts.jump(-1),
    ';': () => acts.jump(1),
    f: () => toggle(state, 'follow'),
    v: () => toggle(state, 'eye'),
    ' ': () => time.toggle(),
    '.': () => state.say({ step: 1 }),
    '[': () => time.shift(-1),
    ']': () => time.shift(1),
    n: () => state.isNight.set(!state.isNight.value),
    Escape: () => {
      state.choose([]);
      state.lane.set(null);
      state.light.set(null);
    },
  };
  window.addEventListener('keydown', (event) => {
    if (document.querySelector('dialog[open]')) return;
    if ((event.ctrlKey || event.metaKey) && event.key.toLowerCase() === 'z' && !isForField(event)) {
      event.preventDefault();
      acts.undo();
      return;
    }
    if (event.ctrlKey || event.metaKey || event.altKey || isForField(event) || event.defaultPrevented) return;
    const isButton = (event.target as HTMLElement).matches('button, summary');
    if (isButton && (event.key === ' ' || event.key === 'Enter')) return;
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const move = moves[key];
    if (!move) return;
    event.preventDefault();
    move(event);
  });
}
