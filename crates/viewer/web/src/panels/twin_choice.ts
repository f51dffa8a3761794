import type { VehicleColour } from '../colour/scales.ts';
import type { Twin } from '../protocol/messages.ts';
import type { State, TwinView } from '../state.ts';
import { choice } from './dom.ts';

const VIEWS: readonly (readonly [TwinView, string])[] = [
  ['none', 'no twin'],
  ['ghosts', 'ghosts'],
  ['side', 'side by side'],
];

/** Whether and how the twin of the traffic is shown. While it is, the colours of vehicles tell which of them differ. */
export class TwinChoice {
  readonly root: HTMLSelectElement;
  private before: VehicleColour = 'style';
  /** What this page has asked for, as long as it is not there. */
  private asked: boolean | null = null;

  constructor(private readonly state: State) {
    const title = 'The same traffic without what you do by hand from now on, or with the other settings of its twin (G)';
    this.root = choice('twin', title, VIEWS, (view) => this.choose(view));
    state.hello.watch((hello) => {
      this.root.hidden = !hello?.can.twin;
      this.asked = null;
    });
    state.twinView.watch((view) => (this.root.value = view));
    state.twin.watch((twin) => this.hear(twin));
  }

  /** Goes on to the next choice. */
  next(): void {
    const at = VIEWS.findIndex(([view]) => view === this.state.twinView.value);
    this.choose(VIEWS[(at + 1) % VIEWS.length][0]);
  }

  private choose(view: TwinView): void {
    const { state } = this;
    if (!state.hello.value?.can.twin) return;
    const [had, has] = [state.twinView.value !== 'none', view !== 'none'];
    this.show(view);
    if (had === has) return;
    this.asked = has;
    state.say({ twin: has });
  }

  /** The server begins or ends to show the twin: as this page has asked, or another one. */
  private hear(twin: Twin | null): void {
    const { value: view } = this.state.twinView;
    // An answer to something that was asked before.
    if (this.asked !== null && this.asked !== (twin !== null)) return;
    this.asked = null;
    const isRun = this.state.hello.value?.kind === 'run';
    if (twin === null) this.show('none');
    else if (view === 'none') this.show(isRun ? 'side' : 'ghosts');
  }

  private show(view: TwinView): void {
    const { twinView, colour } = this.state;
    const [had, has] = [twinView.value !== 'none', view !== 'none'];
    twinView.set(view);
    if (has && !had) {
      this.before = colour.value;
      colour.set('difference');
    } else if (had && !has && colour.value === 'difference') {
      colour.set(this.before);
    }
  }
}
