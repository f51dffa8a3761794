import type { State } from '../state.ts';
import { button, choice, element, say } from './dom.ts';
import { clockTime } from './words.ts';

const FASTEST = 'fastest';
const FACTORS = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100];

/** Play, pause, step, and how fast time goes. */
export class TimeControls {
  readonly root = element('div', { class: 'time', role: 'group', 'aria-label': 'Time' });
  private readonly play: HTMLButtonElement;
  private readonly pause: HTMLButtonElement;
  private readonly factor: HTMLSelectElement;
  private readonly time = element('output', { class: 'clock', 'data-test': 'time', 'aria-label': 'Time of the simulation' });
  private readonly count = element('span', { class: 'count', 'data-test': 'vehicles' });
  private wanted: number | null = 1;
  private hasChosen = false;

  constructor(private readonly state: State) {
    this.play = button('play', '▶', 'Play (space)', () => this.start());
    this.pause = button('pause', '❚❚', 'Pause (space)', () => this.stop());
    const step = button('step', '▶❙', 'One step (.)', () => state.say({ step: 1 }));
    const options = [...FACTORS.map((value) => [String(value), `${value} ×`] as const), [FASTEST, FASTEST] as const];
    this.factor = choice('factor', 'How fast time goes ([ and ])', options, (value) => this.setFactor(value === FASTEST ? null : Number(value)));
    this.root.append(this.play, this.pause, step, this.factor, this.time, this.count);
    state.clock.watch((clock) => {
      if (!clock) return;
      // While time stands still the user may choose a factor for later.
      if (clock.is_playing || !this.hasChosen) this.wanted = clock.factor;
      this.showFactor();
      this.showPlaying(clock.is_playing);
      const waiting = clock.waiting > 0 ? `, ${clock.waiting} waiting to enter` : '';
      say(this.count, `${clock.vehicles} vehicles${waiting}`);
    });
    this.showPlaying(false);
  }

  toggle(): void {
    if (this.state.clock.value?.is_playing) this.stop();
    else this.start();
  }

  /** Goes to the next faster or slower factor. */
  shift(by: 1 | -1): void {
    const last = FACTORS.length;
    const found = FACTORS.findIndex((value) => this.wanted !== null && value >= this.wanted);
    const index = Math.min(Math.max((found < 0 ? last : found) + by, 0), last);
    this.setFactor(index === last ? null : FACTORS[index]);
  }

  showTime(time_s: number): void {
    say(this.time, clockTime(time_s));
  }

  private start(): void {
    this.state.say({ play: this.wanted });
  }

  private stop(): void {
    this.state.say({ pause: true });
  }

  private setFactor(factor: number | null): void {
    this.wanted = factor;
    this.hasChosen = true;
    this.showFactor();
    if (this.state.clock.value?.is_playing) this.start();
  }

  private showFactor(): void {
    const text = this.wanted === null ? FASTEST : String(this.wanted);
    if (![...this.factor.options].some(({ value }) => value === text)) {
      this.factor.append(element('option', { value: text }, `${text} ×`));
    }
    this.factor.value = text;
  }

  private showPlaying(isPlaying: boolean): void {
    const hadFocus = document.activeElement === this.play || document.activeElement === this.pause;
    this.play.hidden = isPlaying;
    this.pause.hidden = !isPlaying;
    if (hadFocus) (isPlaying ? this.pause : this.play).focus();
  }
}
