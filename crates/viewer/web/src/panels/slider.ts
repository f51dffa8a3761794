import { element, say } from './dom.ts';
import { rounded, sliderScale } from './slider_scale.ts';
import { short } from './words.ts';

const STEPS = 1000;
const SHOWN_DIGITS = 4;

export interface SliderOptions {
  label: string;
  unit: string;
  value: number;
  minimum: number | null;
  maximum: number | null;
  /** Attributes that tell tests which slider this is. */
  marks: Record<string, string>;
  /** Called when the user has chosen a value, with the one before. */
  choose: (value: number, before: number) => void;
}

/** A slider with a field for the number beside it. */
export class Slider {
  readonly root: HTMLElement;
  private readonly range: HTMLInputElement;
  private readonly field: HTMLInputElement;
  private readonly scale;
  private value: number;

  constructor(private readonly options: SliderOptions) {
    const { label, unit, value, minimum, maximum, marks } = options;
    this.value = value;
    this.scale = sliderScale(minimum, maximum, value);
    const words = unit ? `${label} [${unit}]` : label;
    const limits = `from ${short(this.scale.minimum)} to ${short(this.scale.maximum)}`;
    this.range = element('input', { type: 'range', min: '0', max: String(STEPS), step: '1', 'aria-label': words, title: limits, ...marks });
    this.field = element('input', { type: 'number', step: 'any', 'aria-label': `${words}, number`, title: limits });
    if (minimum !== null) this.field.min = String(minimum);
    if (maximum !== null) this.field.max = String(maximum);
    const name = element('span', { class: 'slider-name' });
    say(name, words);
    this.root = element('div', { class: 'slider' }, name, this.range, this.field);
    this.range.addEventListener('input', () => this.write(rounded(this.scale.value(Number(this.range.value) / STEPS))));
    this.range.addEventListener('change', () => this.choose(Number(this.field.value)));
    this.field.addEventListener('change', () => this.choose(Number(this.field.value)));
    this.show(value);
  }

  show(value: number): void {
    this.value = value;
    this.range.value = String(Math.round(this.scale.place(value) * STEPS));
    this.write(value);
  }

  private write(value: number): void {
    this.field.value = String(Number(value.toPrecision(SHOWN_DIGITS)));
    this.range.setAttribute('aria-valuetext', `${short(value)} ${this.options.unit}`.trim());
  }

  private choose(value: number): void {
    if (!Number.isFinite(value) || this.field.value === '') {
      this.show(this.value);
      return;
    }
    const before = this.value;
    if (value === before || value === Number(before.toPrecision(SHOWN_DIGITS))) return;
    this.show(value);
    this.options.choose(value, before);
  }
}
