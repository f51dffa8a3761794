import type { Driver, SideAccount } from '../protocol/messages.ts';
import type { State } from '../state.ts';
import { button, element, say } from './dom.ts';
import { incentiveChart } from './incentive_chart.ts';
import { pairFacts } from './pair.ts';
import { fixed, short, withUnit } from './words.ts';

const EVERY_MS = 120;
const GONE = 'is not on the road now';
const GONE_AFTER_MS = 2500;

type Fact = [name: string, value: string];

/** All about the selected driver: facts, incentives of both sides, and the words of the program. */
export class DriverPanel {
  readonly root = element('section', { class: 'panel', 'data-test': 'panel-driver', 'aria-label': 'The selected driver' });
  private readonly title = element('h2');
  private readonly act = element('p', { class: 'act', 'data-test': 'act' });
  private readonly facts = element('dl', { class: 'facts' });
  private readonly charts = element('div', { class: 'charts' });
  private readonly gap = element('p', { class: 'gap-test', 'data-test': 'gap-test' });
  private readonly story = element('pre', { 'data-test': 'story' });
  private readonly whole = element('details', {}, element('summary', {}, 'The whole account'), this.story);
  private readonly second = element('div', { class: 'pair', 'data-test': 'pair' });
  private shown_ms = 0;
  private hasFacts = false;
  private asked_ms = 0;

  constructor(
    private readonly state: State,
    actions: Node,
  ) {
    const views = element(
      'div',
      { class: 'buttons' },
      button('follow', 'Follow', 'Follow this vehicle (F)', () => toggle(state, 'follow')),
      button('eye', 'Driver’s eye', 'See what the driver sees (V)', () => toggle(state, 'eye')),
      button('deselect', 'Close', 'Select nothing (Esc)', () => state.choose([])),
    );
    this.root.append(this.title, this.act, views, this.second, this.facts, this.charts, this.gap, this.whole, actions);
    this.second.hidden = true;
    state.camera.watch((mode) => {
      for (const one of ['follow', 'eye']) views.querySelector(`[data-test=${one}]`)?.setAttribute('aria-pressed', String(mode === one));
    });
    state.selected.watch((ids) => {
      this.root.hidden = ids.length === 0;
      this.shown_ms = 0;
      this.asked_ms = performance.now();
      if (ids[0] !== undefined) this.waitFor(ids[0]);
    });
    state.drivers.watch((drivers) => this.update(drivers));
    state.clock.watch((clock) => clock?.is_playing && this.notice());
  }

  private waitFor(id: string): void {
    if (this.title.dataset.id === id) return;
    this.title.dataset.id = id;
    say(this.title, `Vehicle ${id}`);
    this.clear();
  }

  private clear(): void {
    this.hasFacts = false;
    for (const text of [this.act, this.gap, this.story]) say(text, '');
    for (const list of [this.facts, this.charts]) list.replaceChildren();
    this.whole.hidden = true;
    this.second.hidden = true;
  }

  /** Says so when nothing has been heard of the driver for a while: it has left the road. */
  private notice(): void {
    const [id] = this.state.selected.value;
    if (id === undefined || performance.now() - Math.max(this.shown_ms, this.asked_ms) < GONE_AFTER_MS) return;
    say(this.act, GONE);
    if (this.state.driven.value === id) this.state.driven.set(null);
  }

  private update(drivers: Driver[]): void {
    const [id, secondId] = this.state.selected.value;
    const driver = drivers.find((one) => one.id === id);
    const second = drivers.find((one) => one.id === secondId);
    const now = performance.now();
    if (!driver && this.hasFacts) {
      this.clear();
      say(this.act, GONE);
    }
    const isFast = this.state.clock.value?.is_playing && now - this.shown_ms < EVERY_MS;
    if (!driver || isFast) return;
    this.hasFacts = true;
    this.shown_ms = now;
    say(this.title, `${name(driver)} ${driver.id}`);
    say(this.act, driver.act ?? '');
    this.facts.replaceChildren(...facts(driver).flatMap(([term, value]) => [element('dt', {}, term), element('dd', {}, value)]));
    this.charts.replaceChildren(...driver.sides.map(sideBlock));
    this.gap.hidden = driver.gap_test === null;
    say(this.gap, driver.gap_test ?? '');
    this.whole.hidden = driver.story === null;
    say(this.story, driver.story ?? '');
    this.showPair(driver, second);
  }

  private showPair(driver: Driver, second: Driver | undefined): void {
    this.second.hidden = second === undefined;
    if (!second) return;
    const rows = pairFacts(driver, second).flatMap(([term, value]) => [element('dt', {}, term), element('dd', {}, value)]);
    this.second.replaceChildren(element('h3', {}, `With ${name(second).toLowerCase()} ${second.id}`), element('dl', { class: 'facts' }, ...rows));
  }
}

export function toggle(state: State, mode: 'follow' | 'eye'): void {
  if (state.selected.value.length > 0) state.camera.set(state.camera.value === mode ? 'free' : mode);
}

const name = (driver: Driver): string => driver.class[0].toUpperCase() + driver.class.slice(1);

/** What is known of a driver. */
function facts(driver: Driver): Fact[] {
  const { leader } = driver;
  const state = [driver.state, driver.side && `to the ${driver.side}`, driver.concentration].filter(Boolean).join(', ');
  const place = driver.position_m === null ? '' : `, at ${withUnit(driver.position_m, 1, 'm')}`;
  const list: [name: string, value: string | null][] = [
    ['style', driver.style],
    ['state', state || null],
    ['speed', withUnit(driver.speed_kmh, 1, 'km/h')],
    ['wants to drive', driver.desired_kmh === null ? null : withUnit(driver.desired_kmh, 1, 'km/h')],
    ['accelerates', driver.acceleration_mps2 === null ? null : withUnit(driver.acceleration_mps2, 2, 'm/s²')],
    ['leader', leader && `${leader.id}: ${fixed(leader.gap_m, 1)} m ahead, ${fixed(leader.speed_kmh, 0)} km/h`],
    ['lane', driver.lanelet && `${driver.lanelet}${place}`],
    ['destination', driver.destination],
    ['length', withUnit(driver.length_m, 1, 'm')],
    ['driven by', driver.is_external ? 'a user' : null],
  ];
  return list.filter((fact): fact is Fact => fact[1] !== null);
}

function sideBlock(account: SideAccount): HTMLElement {
  const verdict = account.is_out_of_question
    ? 'out of question now'
    : account.gain === null
      ? 'forbidden by safety'
      : `G = ${short(account.gain)}${account.probability === null ? '' : `, probability ${fixed(account.probability, 3)}`}`;
  return element(
    'section',
    { 'data-test': `side-${account.side}`, 'aria-label': `Incentives to the ${account.side}` },
    element('h3', {}, `${account.side === 'left' ? '← Left' : 'Right →'}`, element('span', { class: 'verdict' }, verdict)),
    incentiveChart(account),
  );
}
