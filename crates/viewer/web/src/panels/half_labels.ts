import type { Half } from '../stage/halves.ts';
import type { State } from '../state.ts';
import { element, say } from './dom.ts';
import { clockTime } from './words.ts';

/** What the halves of the window show, in words, and the line between them. */
export class HalfLabels {
  readonly root = element('div', { class: 'halves' });
  private readonly line = element('div', { class: 'halves-line' });
  private readonly labels = ['traffic', 'twin'].map((name) => element('p', { class: 'half-label', 'data-test': `half-${name}` }));
  private laid = '';

  constructor(state: State) {
    this.root.append(this.line, ...this.labels);
    state.twin.watch((twin) => {
      if (!twin) return;
      const isRun = state.hello.value?.kind === 'run';
      const time = clockTime(twin.since_s).replace(/\.0$/, '');
      const changed = twin.settings.join(', ') || 'nothing changed';
      say(this.labels[0], isRun ? 'The run' : 'With what you do by hand');
      say(this.labels[1], isRun ? `Its twin: ${changed} from ${time} on` : `Its twin: unchanged since ${time}`);
    });
  }

  /** Lays the labels onto the halves, or hides them. */
  show(halves: [Half, Half] | null): void {
    const now = JSON.stringify(halves);
    if (now === this.laid) return;
    this.laid = now;
    this.root.hidden = halves === null;
    if (!halves) return;
    halves.forEach(({ free }, index) => {
      const { style } = this.labels[index];
      style.left = `${free.x + free.width / 2}px`;
      style.top = `${free.y}px`;
      style.maxWidth = `calc(${free.width}px - 1rem)`;
    });
    const [{ free: first }, { free: second, picture }] = halves;
    const isSideBySide = second.x > first.x;
    Object.assign(this.line.style, {
      left: `${picture.x}px`,
      top: isSideBySide ? `${second.y}px` : `${picture.y}px`,
      width: isSideBySide ? '0' : `${second.width}px`,
      height: isSideBySide ? `${second.height}px` : '0',
    });
  }
}
