import type { Demand, HandEntry, Hello, Style, VehicleClass } from '../protocol/messages.ts';
import type { State } from '../state.ts';
import { button, choice, element } from './dom.ts';
import { SettingSliders } from './setting_sliders.ts';
import { styleSliders } from './style_sliders.ts';
import { clockTime } from './words.ts';

export const CLASSES: readonly VehicleClass[] = ['car', 'truck', 'bus', 'motorcycle'];
const MOST_DEMAND = 6000;
const MOST_SHARE = 10;

/** All that can be done by hand while the traffic runs. */
export class HandsPanel {
  readonly root = element('section', { class: 'panel', 'data-test': 'panel-hands', 'aria-label': 'By hand' });
  private readonly sliders: SettingSliders;
  private readonly styles = element('div');
  private readonly shares = element('div', { class: 'sliders' });
  private readonly demand = element('div', { class: 'sliders' });
  private readonly done = element('ol', { class: 'done', 'data-test': 'hands' });
  private readonly saved = element('p', { class: 'soft', 'data-test': 'saved', role: 'status' });

  /** `putInMiddle` puts a vehicle on the road in the middle of the window, for those who cannot drag. */
  constructor(
    private readonly state: State,
    putInMiddle: (form: VehicleClass) => void,
  ) {
    this.sliders = new SettingSliders(state);
    this.root.hidden = true;
    this.root.append(
      element('h2', {}, 'By hand'),
      element('h3', {}, 'Add a vehicle'),
      element('p', { class: 'soft' }, 'Drag one onto the road, or press Enter to put it in the middle of the window. You drive it.'),
      element('div', { class: 'buttons' }, ...CLASSES.map((form) => this.carrier(form, putInMiddle))),
      element('h3', {}, 'Driving styles'),
      this.styles,
      element('h3', {}, 'Shares of the styles among those who arrive'),
      this.shares,
      element('h3', {}, 'Demand of the entrances'),
      this.demand,
      element('h3', {}, 'Done so far'),
      this.done,
      element(
        'div',
        { class: 'buttons' },
        button('undo', 'Undo', 'Take back the last one (Ctrl+Z)', () => state.say({ undo: true })),
        button('save', 'Save what I did', 'Write a scenario with all that was done by hand', () => state.say({ save: true })),
      ),
      this.saved,
    );
    state.hello.watch((hello) => hello && this.begin(hello));
    state.done.watch((entries) => this.list(entries));
    state.saved.listen(({ scenario }) => this.saved.replaceChildren('Saved as ', element('code', {}, scenario)));
  }

  private carrier(form: VehicleClass, putInMiddle: (form: VehicleClass) => void): HTMLButtonElement {
    const made = element('button', { type: 'button', class: 'carrier', 'data-test': `put-${form}`, title: `Drag a ${form} onto the road` }, form);
    made.addEventListener('pointerdown', (event) => {
      // Without this a finger would keep its events at the button.
      made.releasePointerCapture(event.pointerId);
      this.state.carried.set(form);
    });
    made.addEventListener('keydown', (event) => {
      if (event.key !== 'Enter' && event.key !== ' ') return;
      event.preventDefault();
      putInMiddle(form);
    });
    return made;
  }

  private begin(hello: Hello): void {
    const show = (name: string) => {
      const style = hello.styles.find((one) => one.name === name);
      sliders.replaceChildren(...(style ? [styleSliders(style, this.sliders)] : []));
    };
    const sliders = element('div');
    const names = hello.styles.map(({ name }) => [name, name] as const);
    this.styles.replaceChildren(choice('style', 'Which style', names, show), sliders);
    if (hello.styles[0]) show(hello.styles[0].name);
    this.shares.replaceChildren(...hello.styles.map((style) => this.shareSlider(style)));
    this.demand.replaceChildren(...hello.demand.map((entrance) => this.demandSlider(entrance)));
  }

  private shareSlider({ name, weight: value = 1 }: Style): Node {
    const marks = { 'data-share': name };
    const options = { label: name, unit: '', value, minimum: 0, maximum: Math.max(MOST_SHARE, value), marks };
    return this.sliders.add(options, (weight) => ({ set_share: { style: name, weight } }));
  }

  private demandSlider({ origin, vehicles_per_hour: value }: Demand): Node {
    const marks = { 'data-origin': origin };
    const options = { label: `entrance ${origin}`, unit: 'veh/h', value, minimum: 0, maximum: Math.max(MOST_DEMAND, value), marks };
    return this.sliders.add(options, (vehicles_per_hour) => ({ set_demand: { origin, vehicles_per_hour } }));
  }

  private list(entries: HandEntry[]): void {
    const lines = entries.map(({ number, time_s, text, is_undone }) => {
      const words = `${clockTime(time_s)}  ${text}`;
      return element('li', { value: String(number) }, is_undone ? element('s', { 'aria-label': `taken back: ${words}` }, words) : words);
    });
    this.done.replaceChildren(...lines.reverse());
  }
}
