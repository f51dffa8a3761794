import type { Scene } from '../protocol/scene.ts';
import type { State } from '../state.ts';
import { button, element, say } from './dom.ts';
import { withUnit } from './words.ts';

/** The lanelet that was clicked: how its traffic flows, and whether it is closed. */
export class LanePanel {
  readonly root = element('section', { class: 'panel', 'data-test': 'panel-lane', 'aria-label': 'The selected lane' });
  private readonly title = element('h2');
  private readonly facts = element('dl', { class: 'facts' });
  private readonly block: HTMLButtonElement;
  private readonly open: HTMLButtonElement;

  constructor(
    private readonly state: State,
    private readonly scene: Scene,
  ) {
    this.block = button('block-lane', 'Block lane', 'Nobody may enter this lane', () => this.close(true));
    this.open = button('open-lane', 'Open', 'Vehicles may enter this lane again', () => this.close(false));
    const leave = button('leave-lane', 'Close', 'Select nothing (Esc)', () => state.lane.set(null));
    this.root.append(this.title, this.facts, element('div', { class: 'buttons' }, this.block, this.open, leave));
    state.lane.watch(() => this.update());
    state.lanes.watch(() => this.update());
    state.closed.watch(() => this.update());
    state.hello.watch(() => this.update());
  }

  private update(): void {
    const { value: index } = this.state.lane;
    this.root.hidden = index === null;
    if (index === null) return;
    const { id, limit_kmh, only_for } = this.scene.lanelets[index];
    say(this.title, `Lanelet ${id}`);
    const measure = this.state.lanes.value.find(([lanelet]) => lanelet === index);
    const rows: [string, string][] = [
      ...(only_for === null ? [] : [['only for', only_for] satisfies [string, string]]),
      ['speed limit', withUnit(limit_kmh, 0, 'km/h')],
      ['density', withUnit(measure?.[1], 1, 'vehicles/km')],
      ['speed', measure && measure[2] === null ? 'nobody was there' : withUnit(measure?.[2], 1, 'km/h')],
      ['flow', withUnit(measure?.[3], 0, 'vehicles/h')],
      ['lane changes', withUnit(measure?.[4], 0, 'per km and hour')],
    ];
    this.facts.replaceChildren(...rows.flatMap(([term, value]) => [element('dt', {}, term), element('dd', {}, value)]));
    const isClosed = this.state.closed.value.has(id);
    const canHands = this.state.hello.value?.can.hands ?? false;
    this.block.hidden = !canHands || isClosed;
    this.open.hidden = !canHands || !isClosed;
  }

  private close(isClosed: boolean): void {
    const { value: index } = this.state.lane;
    if (index === null) return;
    this.state.say({ hand: { close_lanelet: { lanelet: this.scene.lanelets[index].id, is_closed: isClosed } } });
  }
}
