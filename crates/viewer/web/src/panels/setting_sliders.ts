import type { Hand } from '../protocol/messages.ts';
import { settingOf } from '../settings.ts';
import type { State } from '../state.ts';
import { Slider, type SliderOptions } from './slider.ts';

/** Sliders for numbers that are set by hand. They show what is set, whoever has set it. */
export class SettingSliders {
  private readonly sliders = new Map<string, Slider>();

  constructor(private readonly state: State) {
    state.set.watch((set) => set.forEach((hand) => this.show(hand)));
    state.refused.listen(() => this.sliders.forEach((slider) => slider.reset()));
  }

  /** A slider for the number that `hand` sets. Its value is that of the scenario, as long as nobody sets another one. */
  add(options: Omit<SliderOptions, 'choose'>, hand: (value: number) => Hand): Node {
    const slider = new Slider({ ...options, choose: (value) => this.state.say({ hand: hand(value) }) });
    const { name } = settingOf(hand(options.value)) ?? { name: '' };
    this.sliders.set(name, slider);
    this.state.set.value.forEach((one) => settingOf(one)?.name === name && this.show(one));
    return slider.root;
  }

  private show(hand: Hand): void {
    const setting = settingOf(hand);
    if (setting) this.sliders.get(setting.name)?.show(setting.value);
  }
}
