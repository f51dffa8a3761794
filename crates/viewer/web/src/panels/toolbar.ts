import type { VehicleColour } from '../colour/scales.ts';
import type { State } from '../state.ts';
import { button, choice, element, say } from './dom.ts';

const COLOURS: readonly (readonly [VehicleColour, string])[] = [
  ['style', 'style'],
  ['speed', 'speed'],
  ['state', 'state'],
  ['desire', 'desire G'],
  ['delay', 'delay'],
  ['since_change', 'time since change'],
];

/** What is shown, at the top of the page. */
export class Toolbar {
  readonly root = element('div', { class: 'tools', role: 'toolbar', 'aria-label': 'View' });

  constructor(state: State) {
    const title = element('h1', { class: 'title' }, 'laneweave');
    state.hello.watch((hello) => {
      if (hello) say(title, hello.title);
    });
    const find = element('input', { type: 'search', inputmode: 'numeric', placeholder: 'vehicle id', 'data-test': 'find', 'aria-label': 'Find a vehicle by its id' });
    const form = element('form', { role: 'search' }, find);
    form.addEventListener('submit', (event) => {
      event.preventDefault();
      if (/^-?\d+$/.test(find.value.trim())) state.say({ find: find.value.trim() });
    });
    const colour = choice('colour', 'What the colours of vehicles tell', COLOURS, (value) => {
      state.colour.set(value);
      if (value !== 'speed' && value !== 'state') state.say({ colour: value });
    });
    const night = button('night', '◐', 'Day or night (N)', () => state.isNight.set(!state.isNight.value));
    this.root.append(title, form, element('label', {}, 'colour ', colour), night);
  }
}
