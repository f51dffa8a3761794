import type { Hand, HandEntry } from './protocol/messages.ts';
import type { State } from './state.ts';

export interface Aftermath {
  /** Shows again what was before. */
  revert?: () => void;
  /** Told the vehicle that was put on the road. */
  hasPut?: (vehicle: string) => void;
}

interface Deed extends Aftermath {
  /** Words that the entry of the list has if it is about this. */
  about: string[];
}

/** What the user does by hand. It keeps how to show the state before, for when the server takes something back. */
export class Hands {
  private asked: Deed[] = [];
  private readonly deeds = new Map<number, Deed>();
  private known = 0;

  constructor(private readonly state: State) {
    state.hands.watch((entries) => this.hear(entries));
    state.refused.listen(() => this.asked.shift()?.revert?.());
    state.hello.watch(() => {
      this.asked = [];
      this.deeds.clear();
      this.known = 0;
    });
  }

  do(hand: Hand, aftermath?: Aftermath): void {
    if (aftermath) this.asked.push({ about: about(hand), ...aftermath });
    this.state.say({ hand });
  }

  undo(): void {
    this.state.say({ undo: true });
  }

  private hear(entries: HandEntry[]): void {
    for (const entry of entries) {
      if (entry.number > this.known) this.join(entry);
      this.known = Math.max(this.known, entry.number);
      if (!entry.is_undone) continue;
      this.deeds.get(entry.number)?.revert?.();
      this.deeds.delete(entry.number);
    }
    // The server makes one entry of what concerns the same thing and follows soon.
    const last = entries.at(-1);
    if (last) this.asked = this.asked.filter((deed) => !isAbout(last, deed));
  }

  private join(entry: HandEntry): void {
    const at = this.asked.findIndex((deed) => isAbout(entry, deed));
    if (at < 0) return;
    const [deed] = this.asked.splice(at, 1);
    this.deeds.set(entry.number, deed);
    if (entry.vehicle) deed.hasPut?.(entry.vehicle);
  }
}

function about(hand: Hand): string[] {
  if ('set_parameter' in hand) return [hand.set_parameter.parameter, hand.set_parameter.style];
  if ('set_share' in hand) return ['share', hand.set_share.style];
  if ('set_demand' in hand) return [`entrance ${hand.set_demand.origin} `];
  if ('close_lanelet' in hand) return [`lanelet ${hand.close_lanelet.lanelet}:`];
  if ('put' in hand) return [' on lanelet '];
  return [];
}

const isAbout = (entry: HandEntry, deed: Deed): boolean => deed.about.every((words) => entry.text.includes(words));
