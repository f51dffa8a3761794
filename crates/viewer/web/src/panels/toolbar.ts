import type { Heat, VehicleColour } from '../colour/scales.ts';
import type { Signal } from '../signal.ts';
import type { State, Trails } from '../state.ts';
import { button, choice, element, say } from './dom.ts';

const COLOURS: readonly (readonly [VehicleColour, string])[] = [
  ['style', 'style'],
  ['speed', 'speed'],
  ['state', 'state'],
  ['desire', 'desire G'],
  ['delay', 'delay'],
  ['since_change', 'since change'],
  ['difference', 'difference'],
];
/** The first ones need nothing but frames. */
const COLOURS_OF_FRAMES = 3;
const HEATS: readonly (readonly [Heat, string])[] = [
  ['none', 'plain'],
  ['changes', 'changes'],
  ['speed', 'speed'],
  ['density', 'density'],
];
const TRAILS: readonly (readonly [Trails, string])[] = [
  ['none', 'none'],
  ['selected', 'selected'],
  ['all', 'all'],
];

export interface ToolbarActs {
  wholeMap: () => void;
  toggleMap: () => void;
  help: () => void;
  toggleHands: () => void;
  toggleMarks: () => void;
}

/** What is shown, at the top of the page. On narrow windows most of it is folded. */
export class Toolbar {
  readonly root = element('div', { class: 'tools', role: 'toolbar', 'aria-label': 'View' });
  private readonly find = element('input', {
    type: 'search',
    inputmode: 'numeric',
    placeholder: 'find vehicle',
    'data-test': 'find',
    'aria-label': 'Find a vehicle by its id (/)',
  });

  /** `twin` is the choice of how the twin is shown. */
  constructor(state: State, acts: ToolbarActs, twin: HTMLElement) {
    const more = element('div', { class: 'more', id: 'more-tools' });
    const menu = button('menu', '☰', 'More tools', () => {
      const isOpen = this.root.classList.toggle('is-open');
      menu.setAttribute('aria-expanded', String(isOpen));
    });
    menu.setAttribute('aria-expanded', 'false');
    menu.setAttribute('aria-controls', 'more-tools');
    const hands = button('hands', 'By hand', 'Change the traffic by hand (H)', acts.toggleHands);
    state.hello.watch((hello) => (hands.hidden = !hello?.can.hands));
    more.append(
      button('map', 'Map', 'Straight down, or aslant (M)', acts.toggleMap),
      button('whole-map', '⤢', 'The whole map (Home)', acts.wholeMap),
      toggleButton('night', '◐', 'Night or day (N)', state.isNight),
      button('help', '?', 'Keys (?)', acts.help),
      labelled('colour', this.colours(state)),
      ...(state.hasServer ? [this.heats(state)] : []),
      labelled('trails', choice('trails', 'Which vehicles have trails', TRAILS, (which) => state.trails.set(which))),
      twin,
      toggleButton('changes', 'Changes', 'Lane changes and other events of the last minute, on the road', state.showsChanges),
      toggleButton('arrows', 'Arrows', 'Arrows in the direction of the lanes', state.showsArrows),
      button('marks', 'Marks', 'List of collisions, emergency brakings and missed turns', acts.toggleMarks),
      hands,
    );
    this.root.append(
      this.title(state),
      this.finder(state),
      menu,
      more,
    );
  }

  focusFinder(): void {
    this.find.focus();
    this.find.select();
  }

  private title(state: State): HTMLElement {
    const title = element('h1', { class: 'title' }, 'laneweave');
    state.hello.watch((hello) => {
      if (!hello) return;
      say(title, hello.title);
      title.title = hello.title;
    });
    return title;
  }

  private finder(state: State): HTMLElement {
    const form = element('form', { role: 'search' }, this.find);
    form.addEventListener('submit', (event) => {
      event.preventDefault();
      const id = this.find.value.trim();
      if (/^-?\d+$/.test(id)) state.say({ find: id });
      else if (id !== '') state.refused.tell({ what: `“${id}” is no id of a vehicle.`, remedy: 'Ids are whole numbers.' });
    });
    return form;
  }

  private heats(state: State): HTMLElement {
    const heats = labelled('lanes', choice('heat', 'What the colours of lanes tell', HEATS, (heat) => state.heat.set(heat)));
    state.hello.watch((hello) => (heats.hidden = hello?.kind === 'recording'));
    return heats;
  }

  private colours(state: State): HTMLSelectElement {
    state.hello.watch(() => askForColour(state));
    const colours = state.hasServer ? COLOURS : COLOURS.slice(0, COLOURS_OF_FRAMES);
    const list = choice('colour', 'What the colours of vehicles tell', colours, (value) => state.colour.set(value));
    // Nobody knows what recorded drivers want.
    state.hello.watch((hello) => [...list.options].slice(COLOURS_OF_FRAMES).forEach((it) => (it.hidden = hello?.kind === 'recording')));
    state.colour.watch((value) => {
      list.value = value;
      askForColour(state);
    });
    return list;
  }
}

/** Speed and state are in every frame; for the others the server is asked. */
function askForColour(state: State): void {
  const { value } = state.colour;
  state.say({ colour: value === 'speed' || value === 'state' ? 'style' : value });
}

const labelled = (name: string, control: HTMLElement): HTMLElement => element('label', { class: 'labelled' }, element('span', {}, name), control);

function toggleButton(test: string, label: string, title: string, signal: Signal<boolean>): HTMLButtonElement {
  const made = button(test, label, title, () => signal.set(!signal.value));
  signal.watch((isOn) => made.setAttribute('aria-pressed', String(isOn)));
  return made;
}
