import type { Hands } from '../hands.ts';
import type { Side } from '../protocol/messages.ts';
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
  private speed_kmh = 0;

  constructor(
    private readonly state: State,
    private readonly hands: Hands,
  ) {
    this.drive = button('drive', 'Drive it', 'Drive this vehicle with the arrow keys', () => this.toggle());
    const remove = button('remove', 'Remove', 'Remove this vehicle', () => this.withSelected((vehicle) => hands.do({ remove: { vehicle } })));
    this.wheel.append(
      button('slower', '▼', 'Slower (arrow down)', () => this.faster(-1)),
      button('faster', '▲', 'Faster (arrow up)', () => this.faster(1)),
      button('to-left', '←', 'Change to the left lane (arrow left)', () => this.steer('left')),
      button('to-right', '→', 'Change to the right lane (arrow right)', () => this.steer('right')),
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

  /** Lets the user drive a vehicle. */
  take(vehicle: string, speed_kmh: number): void {
    this.speed_kmh = speed_kmh;
    this.state.driven.set(vehicle);
    this.send(null);
  }

  private toggle(): void {
    const [driver] = this.state.drivers.value;
    if (this.state.driven.value !== null) this.giveBack();
    else this.withSelected((id) => this.take(id, Math.round((driver?.speed_kmh ?? 0) / SPEED_STEP_KMH) * SPEED_STEP_KMH));
  }

  private giveBack(): void {
    const { value: vehicle } = this.state.driven;
    if (vehicle === null) return;
    this.state.driven.set(null);
    this.hands.do({ drive: { vehicle, speed_kmh: null, side: null } });
  }

  private faster(sign: 1 | -1): void {
    this.speed_kmh = Math.max(this.speed_kmh + sign * SPEED_STEP_KMH, 0);
    this.send(null);
  }

  private steer(side: Side): void {
    this.send(side);
  }

  private send(side: Side | null): void {
    const { value: vehicle } = this.state.driven;
    if (vehicle === null) return;
    say(this.wanted, `holds ${this.speed_kmh} km/h`);
    this.hands.do({ drive: { vehicle, speed_kmh: this.speed_kmh, side } });
  }

  private key(event: KeyboardEvent): void {
    if (this.state.driven.value === null || event.ctrlKey || event.metaKey || event.altKey) return;
    if ((event.target as HTMLElement).matches('input, select, [role=slider]')) return;
    const acts: Record<string, () => void> = {
      ArrowUp: () => this.faster(1),
      ArrowDown: () => this.faster(-1),
      ArrowLeft: () => this.steer('left'),
      ArrowRight: () => this.steer('right'),
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
      if (style !== '') this.withSelected((vehicle) => this.hands.do({ set_style: { vehicle, style } }));
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
