import type { Hands } from '../hands.ts';
import type { LightShows } from '../protocol/messages.ts';
import type { Scene } from '../protocol/scene.ts';
import type { State } from '../state.ts';
import { button, element, say } from './dom.ts';

const SHOWN: Record<string, string> = { g: 'green', y: 'yellow', r: 'red' };
const CHOICES: readonly (readonly [LightShows | null, string, string])[] = [
  ['green', 'Green', 'Always green'],
  ['yellow', 'Yellow', 'Always yellow'],
  ['red', 'Red', 'Always red'],
  [null, 'Its program', 'As its program says'],
];

/** The light that was clicked: what it shows, and what it shall show. */
export class LightPanel {
  readonly root = element('section', { class: 'panel', 'data-test': 'panel-light', 'aria-label': 'The selected light' });

  constructor(state: State, scene: Scene, hands: Hands) {
    const title = element('h2');
    const shows = element('p', { 'data-test': 'light-shows' });
    const set = (choice: LightShows | null) => {
      const { value: light } = state.light;
      if (light !== null) hands.do({ set_light: { light: scene.lights[light].id, shows: choice } });
    };
    const buttons = element('div', { class: 'buttons' });
    for (const [choice, label, hint] of CHOICES) buttons.append(button(`light-${choice ?? 'program'}`, label, hint, () => set(choice)));
    const leave = button('leave-light', 'Close', 'Select nothing (Esc)', () => state.light.set(null));
    this.root.append(title, shows, buttons, element('div', { class: 'buttons' }, leave));
    const update = () => {
      const { value: light } = state.light;
      this.root.hidden = light === null;
      if (light === null) return;
      say(title, `Light ${scene.lights[light].id}`);
      say(shows, `shows ${SHOWN[state.lights.value[light]] ?? 'nothing'}`);
      buttons.hidden = !state.hello.value?.can.hands;
    };
    state.light.watch(update);
    state.lights.watch(update);
    state.hello.watch(update);
  }
}
