import type { Feed } from './feed/feed.ts';
import { withNews } from './hands.ts';
import { closedBy } from './settings.ts';
import { listenToKeys } from './keys.ts';
import { dress } from './overlays/dress.ts';
import { Carry } from './panels/carry.ts';
import { element } from './panels/dom.ts';
import { DriverPanel } from './panels/driver_panel.ts';
import { HalfLabels } from './panels/half_labels.ts';
import { HandsPanel } from './panels/hands_panel.ts';
import { Help } from './panels/help.ts';
import { LanePanel } from './panels/lane_panel.ts';
import { Legend } from './panels/legend.ts';
import { LightPanel } from './panels/light_panel.ts';
import { MarksPanel } from './panels/marks_panel.ts';
import { TimeControls } from './panels/time_controls.ts';
import { Timeline } from './panels/timeline.ts';
import { Toasts } from './panels/toasts.ts';
import { Toolbar } from './panels/toolbar.ts';
import { TwinChoice } from './panels/twin_choice.ts';
import { VehicleActions } from './panels/vehicle_actions.ts';
import type { Found, Hands, ServerMessage, TrafficEvent } from './protocol/messages.ts';
import type { Scene } from './protocol/scene.ts';
import { localise } from './road/localise.ts';
import { Stage } from './stage/stage.ts';
import { State } from './state.ts';
import { Telemetry } from './telemetry.ts';
import { TrafficView } from './traffic_view.ts';

const CLOSE_M = 140;
const LOOK_EVERY_MS = 250;

/** Builds the page, and joins the feed, the state, the panels and the picture. */
export class Page {
  readonly state: State;
  private readonly telemetry = new Telemetry();
  private readonly canvas = element('canvas', {
    tabindex: '0',
    'data-test': 'picture',
    'aria-label': 'The road. Arrows move the view, plus and minus zoom, Q and E turn.',
  });
  private readonly side = element('aside', { class: 'side', 'aria-label': 'Details' });
  private readonly stage: Stage;
  private readonly time: TimeControls;
  private readonly timeline: Timeline;
  private readonly halfLabels: HalfLabels;
  private view: TrafficView | null = null;
  private lastLook_ms = 0;
  private hasBegun = false;

  constructor(private readonly feed: Feed) {
    this.state = new State(feed.hasServer, (message) => feed.say(message));
    document.body.append(element('main', {}, this.canvas));
    this.stage = new Stage(this.canvas);
    this.time = new TimeControls(this.state);
    this.timeline = new Timeline(this.state);
    this.halfLabels = new HalfLabels(this.state);
    this.lay();
    const dark = matchMedia('(prefers-color-scheme: dark)');
    this.state.isNight.set(dark.matches);
    dark.addEventListener('change', () => this.state.isNight.set(dark.matches));
    this.state.isNight.watch((isNight) => (document.documentElement.dataset.mood = isNight ? 'night' : 'day'));
    this.state.found.listen((found) => this.goToFound(found));
  }

  start(): void {
    this.feed.start({
      scene: (scene) => this.build(scene),
      message: (message) => this.hear(message),
      frame: (bytes) => this.view?.traffic.push(bytes, performance.now() / 1000),
      connection: (connection) => this.state.connection.set(connection),
    });
    requestAnimationFrame((now) => this.picture(now, now));
  }

  /** Lays out all panels. */
  private lay(): void {
    const { state } = this;
    const actions = new VehicleActions(state);
    const carry = new Carry(state, actions, () => this.view);
    const handsPanel = new HandsPanel(state, (form) => carry.put(form, ...this.stage.middle()));
    const marks = new MarksPanel(state, (event) => this.goToEvent(event));
    const help = new Help();
    const twin = new TwinChoice(state);
    const toggle = (panel: HTMLElement) => () => {
      panel.hidden = !panel.hidden;
      if (!panel.hidden) panel.scrollIntoView({ block: 'nearest' });
    };
    const toggleHands = () => state.hello.value?.can.hands && toggle(handsPanel.root)();
    const acts = {
      wholeMap: () => this.wholeMap(),
      toggleMap: () => this.stage.rig.toggleMap(),
      help: () => help.toggle(),
      toggleHands: () => void toggleHands(),
      toggleMarks: toggle(marks.root),
      find: () => toolbar.focusFinder(),
      undo: () => state.say({ undo: true }),
      nextTwin: () => twin.next(),
      selectInMiddle: (isSecond: boolean) => this.view?.selectInMiddle(isSecond),
      jump: (sign: 1 | -1) => this.timeline.jump(sign),
    };
    const toolbar = new Toolbar(state, acts, twin.root);
    this.side.append(marks.root, new DriverPanel(state, actions.root).root, handsPanel.root);
    document.querySelector('main')?.append(
      this.halfLabels.root,
      element('header', { class: 'bar top' }, toolbar.root),
      new Legend(state).root,
      this.side,
      element('footer', { class: 'bar bottom' }, this.time.root, this.timeline.root),
      new Toasts(state).root,
      carry.root,
      help.root,
    );
    listenToKeys(state, this.stage.rig, this.time, acts);
  }

  private build(raw: Scene): void {
    const scene = localise(raw);
    const view = new TrafficView(scene, this.stage, this.state);
    this.view = view;
    dress(view, this.state);
    this.side.prepend(new LanePanel(this.state, scene).root, new LightPanel(this.state, scene).root);
    document.title = `${scene.title} – laneweave`;
  }

  private hear(message: ServerMessage): void {
    const { state } = this;
    if (message.hello) this.begin(message.hello);
    if (message.clock) state.clock.set(message.clock);
    if (message.lights !== undefined) state.lights.set(message.lights);
    if (message.twin_lights !== undefined) state.twinLights.set(message.twin_lights);
    if (message.twin !== undefined) state.twin.set(message.twin);
    if (message.drivers) state.drivers.set(message.drivers);
    if (message.events) state.events.tell(message.events);
    if (message.marks) state.marks.set(message.marks);
    if (message.lanes) state.lanes.set(message.lanes);
    if (message.hands) this.hearOfHands(message.hands);
    if (message.put !== undefined) state.put.tell(message.put);
    if (message.found) state.found.tell(message.found);
    if (message.saved) state.saved.tell(message.saved);
    if (message.refused) state.refused.tell(message.refused);
  }

  private hearOfHands(news: Hands): void {
    this.knowHands(withNews({ done: this.state.done.value, set: this.state.set.value }, news));
  }

  private knowHands({ done, set }: Hands): void {
    this.state.done.set(done);
    this.state.set.set(set);
    this.state.closed.set(closedBy(set));
  }

  /** Begins, or goes on after the connection was lost: the server does not know any more what the page wants. */
  private begin(hello: NonNullable<ServerMessage['hello']>): void {
    const { state } = this;
    this.view?.restart();
    this.knowHands({ done: [], set: [] });
    state.hello.set(hello);
    if (state.selected.value.length > 0) state.say({ select: state.selected.value });
    // What has not begun yet begins; what somebody has stopped stays as it is.
    if (!this.hasBegun && hello.time_s <= hello.begin_s) state.say({ play: 1 });
    this.hasBegun = true;
  }

  private wholeMap(): void {
    if (!this.view) return;
    this.state.camera.set('free');
    this.stage.rig.frame(...this.view.scene.bounds);
  }

  private goToFound({ id, x, y }: Found): void {
    if (x === undefined || y === undefined) return;
    this.goTo(x, y);
    this.state.select(id, false);
    this.state.camera.set('follow');
  }

  private goToEvent({ x, y, vehicle }: TrafficEvent): void {
    this.state.camera.set('free');
    this.goTo(x, y);
    if (vehicle !== null) this.state.select(vehicle, false);
  }

  private goTo(x: number, y: number): void {
    if (!this.view) return;
    const [ox, oy] = this.view.scene.origin;
    const { goal } = this.stage.rig;
    Object.assign(goal, { x: x - ox, y: y - oy, distance: Math.min(goal.distance, CLOSE_M) });
  }

  /** Tells the stage what is covered: by bars above and below, by a column at the right, or by a sheet at the bottom of a narrow window. */
  private leaveFree(now_ms: number): void {
    if (now_ms - this.lastLook_ms < LOOK_EVERY_MS) return;
    this.lastLook_ms = now_ms;
    const { left, top, width } = this.side.getBoundingClientRect();
    const edge = (bar: string): DOMRect | undefined => document.querySelector(bar)?.getBoundingClientRect();
    const [above, below] = [edge('.bar.top')?.bottom ?? 0, innerHeight - (edge('.bar.bottom')?.top ?? innerHeight)];
    const isShown = [...this.side.children].some((panel) => !(panel as HTMLElement).hidden);
    const isSheet = width > innerWidth * 0.7;
    const sheet = isShown && isSheet ? innerHeight - top : 0;
    this.stage.leaveFree({ top: above, right: isShown && !isSheet ? innerWidth - left : 0, bottom: Math.max(below, sheet), sheet });
  }

  private picture(now_ms: number, last_ms: number): void {
    if (this.view && this.state.hello.value) {
      this.leaveFree(now_ms);
      this.view.draw(now_ms / 1000, Math.min((now_ms - last_ms) / 1000, 0.25), this.telemetry.fps);
      const { time_s } = this.view.traffic.playback;
      this.time.showTime(time_s);
      this.timeline.show(time_s);
      this.halfLabels.show(this.stage.halves);
      this.telemetry.note(now_ms - last_ms, this.stage.renderer.info.render.calls);
      this.telemetry.publish(this.view, this.state, now_ms);
    }
    requestAnimationFrame((next) => this.picture(next, now_ms));
  }
}
