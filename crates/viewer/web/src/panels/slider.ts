import { element, say } from './dom.ts';
import { rounded, sliderScale } from './slider_scale.ts';
import { short } from './words.ts';

const STEPS = 1000;
/** While a slider moves, its value is told as often as this. */
const TELL_EVERY_MS = 100;
const SHOWN_DIGITS = 4;

export interface SliderOptions {
  label: string;
  unit: string;
  value: number;
  minimum: number | null;
  maximum: number | null;
  /** Attributes that tell tests which slider this is. */
  marks: Record<string, string>;
  /** Called when the user has chosen a value, and while the slider moves. */
  choose: (value: number) => void;
}

/** A slider with a field for the number beside it. */
export class Slider {
  readonly root: HTMLElement;
  private readonly range: HTMLInputElement;
  private readonly field: HTMLInputElement;
  private readonly scale;
  /** The value that holds. */
  private value: number;
  /** The value that was told last. */
  private told: number;
  private timer: number | undefined;
  private isHeld = false;

  constructor(private readonly options: SliderOptions) {
    const { label, unit, value, minimum, maximum, marks } = options;
    this.value = value;
    this.told = value;
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
    this.range.addEventListener('pointerdown', () => (this.isHeld = true));
    for (const end of ['pointerup', 'pointercancel', 'blur'] as const) this.range.addEventListener(end, () => this.release());
    this.range.addEventListener('input', () => this.move());
    this.range.addEventListener('change', () => this.choose(Number(this.field.value)));
    this.field.addEventListener('change', () => this.choose(Number(this.field.value)));
    this.draw(value);
  }

  /** Shows the value that holds from now on. A slider that is being moved stays where it is. */
  show(value: number): void {
    this.value = value;
    this.told = value;
    if (!this.isHeld) this.draw(value);
  }

  /** Shows the value that holds again: the chosen one was refused. */
  reset(): void {
    this.show(this.value);
  }

  private release(): void {
    this.isHeld = false;
    // Tells where it was let go.
    this.choose(Number(this.field.value));
  }

  private move(): void {
    this.write(rounded(this.scale.value(Number(this.range.value) / STEPS)));
    this.timer ??= window.setTimeout(() => this.choose(Number(this.field.value)), TELL_EVERY_MS);
  }

  private draw(value: number): void {
    this.range.value = String(Math.round(this.scale.place(value) * STEPS));
    this.write(value);
  }

  private write(value: number): void {
    this.field.value = String(Number(value.toPrecision(SHOWN_DIGITS)));
    this.range.setAttribute('aria-valuetext', `${short(value)} ${this.options.unit}`.trim());
  }

  private choose(value: number): void {
    window.clearTimeout(this.timer);
    this.timer = undefined;
    if (!Number.isFinite(value) || this.field.value === '') {
      this.draw(this.value);
      return;
    }
    if (value === this.told || value === Number(this.told.toPrecision(SHOWN_DIGITS))) return;
    this.told = value;
    if (!this.isHeld) this.draw(value);
    this.options.choose(value);
  }
}
