import type { LightShows } from '../protocol/messages.ts';
import type { Light, Scene } from '../protocol/scene.ts';
import type { State } from '../state.ts';
import { button, element, say } from './dom.ts';
import { SettingSliders } from './setting_sliders.ts';

const SHOWN: Record<string, string> = { g: 'green', y: 'yellow', r: 'red' };
const CHOICES: readonly (readonly [LightShows | null, string, string])[] = [
  ['green', 'Green', 'Always green'],
  ['yellow', 'Yellow', 'Always yellow'],
  ['red', 'Red', 'Always red'],
  [null, 'Its program', 'As its program says'],
];

/** The light that was clicked: what it shows, what it shall show, and the offset of its plan. */
export class LightPanel {
  readonly root = element('section', { class: 'panel', 'data-test': 'panel-light', 'aria-label': 'The selected light' });
  private readonly title = element('h2');
  private readonly shows = element('p', { 'data-test': 'light-shows' });
  private readonly hands = element('div');
  private readonly choices = new Map<LightShows | null, HTMLButtonElement>();
  private readonly offset = element('div', { class: 'sliders' });
  private readonly sliders: SettingSliders;

  constructor(
    private readonly state: State,
    private readonly scene: Scene,
  ) {
    this.sliders = new SettingSliders(state);
    for (const [choice, label, hint] of CHOICES) {
      this.choices.set(choice, button(`light-${choice ?? 'program'}`, label, hint, () => this.choose(choice)));
    }
    const leave = button('leave-light', 'Close', 'Select nothing (Esc)', () => state.light.set(null));
    this.hands.append(element('div', { class: 'buttons' }, ...this.choices.values()), this.offset);
    this.root.append(this.title, this.shows, this.hands, element('div', { class: 'buttons' }, leave));
    state.light.watch(() => this.begin());
    state.lights.watch(() => this.update());
    state.set.watch(() => this.update());
    state.hello.watch(() => this.update());
  }

  private light(): Light | undefined {
    const { value: light } = this.state.light;
    return light === null ? undefined : this.scene.lights[light];
  }

  private begin(): void {
    const light = this.light();
    this.root.hidden = !light;
    if (!light) return;
    say(this.title, `Light ${light.id}`);
    this.offset.replaceChildren(...(light.plan ? [this.offsetSlider(light.plan)] : []));
    this.update();
  }

  /** All lights of a plan have its offset. The first one stands for them. */
  private offsetSlider({ first, cycle_s, offset_s }: NonNullable<Light['plan']>): Node {
    const { id: light } = this.scene.lights[first];
    const options = { label: 'offset of its junction', unit: 's', value: offset_s, minimum: 0, maximum: cycle_s, marks: { 'data-light': light } };
    return this.sliders.add(options, (chosen) => ({ set_offset: { light, offset_s: chosen } }));
  }

  private update(): void {
    const { value: index } = this.state.light;
    const light = this.light();
    if (index === null || !light) return;
    say(this.shows, `shows ${SHOWN[this.state.lights.value[index]] ?? 'nothing'}`);
    this.hands.hidden = !this.state.hello.value?.can.hands;
    const set = this.state.set.value.flatMap((hand) => ('set_light' in hand && hand.set_light.light === light.id ? [hand.set_light.shows] : []));
    for (const [choice, made] of this.choices) made.setAttribute('aria-pressed', String(choice === (set.at(-1) ?? null)));
  }

  private choose(shows: LightShows | null): void {
    const light = this.light();
    if (light) this.state.say({ hand: { set_light: { light: light.id, shows } } });
  }
}
