import type { State } from '../state.ts';
import { button, element, say } from './dom.ts';

const SHOWN_FOR_MS = 9000;

/** Short messages: what was refused and what helps, and whether there is a connection. */
export class Toasts {
  readonly root = element('div', { class: 'toasts', 'data-test': 'toasts', 'aria-live': 'polite', role: 'status' });
  private readonly connection = element('div', { class: 'toast lost', 'data-test': 'connection' });

  constructor(state: State) {
    this.connection.hidden = true;
    this.root.append(this.connection);
    state.refused.listen(({ what, remedy }) => this.show(what, remedy));
    state.found.listen(({ id, x }) => x === undefined && this.show(`Vehicle ${id} is not on the road.`, 'Look for another one.'));
    let wasOpen = false;
    state.connection.watch((connection) => {
      const { state: now } = connection;
      wasOpen ||= now === 'open';
      this.connection.hidden = now === 'open' || (now === 'connecting' && !wasOpen);
      if (now === 'lost') say(this.connection, `The connection to laneweave is lost. The page tries again in ${connection.retry_s} s.`);
      if (now === 'connecting') say(this.connection, 'The page connects again …');
      if (now === 'refused') say(this.connection, connection.what);
    });
  }

  show(what: string, remedy = ''): void {
    for (const old of this.root.querySelectorAll('[data-what]')) if (old.getAttribute('data-what') === what) old.remove();
    const toast = element('div', { class: 'toast', 'data-what': what }, element('p', {}, element('strong', {}, what)), remedy ? element('p', {}, remedy) : null);
    toast.append(button('dismiss', '×', 'Close this message', () => toast.remove()));
    this.root.append(toast);
    setTimeout(() => toast.remove(), SHOWN_FOR_MS);
  }
}
