import type { Hand, HandEntry } from './protocol/messages.ts';
import type { State } from './state.ts';

interface Deed {
  /** Shows again what was before. */
  revert: () => void;
  /** Told the vehicle that it has put on the road, once it is there. */
  hasPut: ((vehicle: string) => void) | undefined;
}

/** What the user does by hand. It keeps how to show the state before, for when the server takes something back. */
export class Hands {
  private readonly asked: Deed[] = [];
  private readonly deeds = new Map<number, Deed>();
  private known = 0;

  constructor(private readonly state: State) {
    state.hands.watch((entries) => this.hear(entries));
    state.refused.listen(() => this.asked.shift()?.revert());
    state.hello.watch(() => {
      this.asked.length = 0;
      this.deeds.clear();
      this.known = 0;
    });
  }

  do(hand: Hand, revert: () => void = () => {}, hasPut?: (vehicle: string) => void): void {
    this.asked.push({ revert, hasPut });
    this.state.say({ hand });
  }

  undo(): void {
    this.state.say({ undo: true });
  }

  private hear(entries: HandEntry[]): void {
    for (const entry of entries) {
      if (entry.number > this.known && !entry.is_undone) {
        const deed = this.asked.shift();
        if (deed) this.deeds.set(entry.number, deed);
      }
      this.known = Math.max(this.known, entry.number);
      const deed = this.deeds.get(entry.number);
      if (deed?.hasPut && entry.vehicle) {
        deed.hasPut(entry.vehicle);
        deed.hasPut = undefined;
      }
      if (!entry.is_undone) continue;
      deed?.revert();
      this.deeds.delete(entry.number);
    }
  }
}
