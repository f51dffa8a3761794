import type { Side } from '../protocol/messages.ts';
import { isForField } from '../keys.ts';
import type { State } from '../state.ts';
import { button, choice, element, say } from './dom.ts';

const SPEED_STEP_KMH = 5;

/** What can be done by hand with the selected vehicle: another style, driving it, removing it. */
export class VehicleActions {
  readonly root = element('div', { class: 'actions', 'data-test': 'vehicle-actions' });
  private readonly styles = element('span');
  private readonly wheel = element('div', { class: 'buttons', role: 'group', 'aria-label': 'Drive' });
  private readonly drive: HTMLButtonElement;
  private readonly wanted = element('output', { 'data-test': 'held-speed' });
  private held_kmh: number | null = null;

  constructor(private readonly state: State) {
    this.drive = button('drive', 'Drive it', 'Drive this vehicle with the arrow keys', () => this.toggle());
    const remove = button('remove', 'Remove', 'Remove this vehicle', () => this.remove());
    this.wheel.append(
      button('slower', '▼', 'Slower (arrow down)', () => this.faster(-1)),
      button('faster', '▲', 'Faster (arrow up)', () => this.faster(1)),
      button('to-left', '←', 'Change to the left lane (arrow left)', () => this.send('left')),
      button('to-right', '→', 'Change to the right lane (arrow right)', () => this.send('right')),
      this.wanted,
    );
    this.root.append(element('div', { class: 'buttons' }, this.drive, this.styles, remove), this.wheel);
    state.hello.watch((hello) => {
      this.root.hidden = !hello?.can.hands;
      if (hello) this.styles.replaceChildren(this.styleChoice(hello.styles.map(({ name }) => name)));
    });
    state.driven.watch((driven) => this.showDriving(driven !== null));
    state.selected.watch(([id]) => {
      const { value: driven } = state.driven;
      if (driven !== null && id !== driven) this.giveBack();
    });
    window.addEventListener('keydown', (event) => this.key(event));
  }

  /** Lets the user drive a vehicle that already holds its speed. */
  take(vehicle: string): void {
    this.held_kmh = null;
    say(this.wanted, '');
    this.state.driven.set(vehicle);
  }

  private remove(): void {
    this.state.driven.set(null);
    this.withSelected((vehicle) => this.state.say({ hand: { remove: { vehicle } } }));
    this.state.choose([]);
  }

  private toggle(): void {
    if (this.state.driven.value !== null) {
      this.giveBack();
      return;
    }
    this.withSelected((id) => {
      this.take(id);
      this.send(null);
    });
  }

  private giveBack(): void {
    const { value: vehicle } = this.state.driven;
    if (vehicle === null) return;
    this.state.driven.set(null);
    this.state.say({ hand: { drive: { vehicle, speed_kmh: null, side: null } } });
  }

  private faster(sign: 1 | -1): void {
    this.held_kmh = Math.max(this.held() + sign * SPEED_STEP_KMH, 0);
    this.send(null);
  }

  /** The speed that the vehicle holds; at first the one that it has. */
  private held(): number {
    const driver = this.state.drivers.value.find(({ id }) => id === this.state.driven.value);
    this.held_kmh ??= Math.round((driver?.speed_kmh ?? 0) / SPEED_STEP_KMH) * SPEED_STEP_KMH;
    return this.held_kmh;
  }

  private send(side: Side | null): void {
    const { value: vehicle } = this.state.driven;
    if (vehicle === null) return;
    const speed_kmh = this.held();
    say(this.wanted, `holds ${speed_kmh} km/h`);
    this.state.say({ hand: { drive: { vehicle, speed_kmh, side } } });
  }

  private key(event: KeyboardEvent): void {
    if (this.state.driven.value === null || event.ctrlKey || event.metaKey || event.altKey) return;
    if (isForField(event)) return;
    const acts: Record<string, () => void> = {
      ArrowUp: () => this.faster(1),
      ArrowDown: () => this.faster(-1),
      ArrowLeft: () => this.send('left'),
      ArrowRight: () => this.send('right'),
    };
    const act = acts[event.key];
    if (!act) return;
    event.preventDefault();
    event.stopImmediatePropagation();
    act();
  }

  private styleChoice(names: string[]): HTMLSelectElement {
    const options = [['', 'another style …'] as const, ...names.map((name) => [name, name] as const)];
    const made = choice('set-style', 'Give this vehicle another style', options, (style) => {
      if (style !== '') this.withSelected((vehicle) => this.state.say({ hand: { set_style: { vehicle, style } } }));
      made.value = '';
    });
    return made;
  }

  private showDriving(isDriving: boolean): void {
    this.wheel.hidden = !isDriving;
    this.drive.setAttribute('aria-pressed', String(isDriving));
    say(this.drive, isDriving ? 'Give it back' : 'Drive it');
  }

  private withSelected(act: (id: string) => void): void {
    const [id] = this.state.selected.value;
    if (id !== undefined) act(id);
  }
}
