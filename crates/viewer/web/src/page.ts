import type { Feed } from './feed/feed.ts';
import { listenToKeys } from './keys.ts';
import { DriverPanel } from './panels/driver_panel.ts';
import { element } from './panels/dom.ts';
import { TimeControls } from './panels/time_controls.ts';
import { Toolbar } from './panels/toolbar.ts';
import type { ServerMessage } from './protocol/messages.ts';
import { localise } from './road/localise.ts';
import { Stage } from './stage/stage.ts';
import { State } from './state.ts';
import { Telemetry } from './telemetry.ts';
import { TrafficView } from './traffic_view.ts';

/** Builds the page, and joins the feed, the state, the panels and the picture. */
export class Page {
  readonly state: State;
  readonly telemetry = new Telemetry();
  private readonly canvas = element('canvas', { tabindex: '0', 'aria-label': 'The road. Arrows move the view, plus and minus zoom, Q and E turn.' });
  private readonly side = element('aside', { class: 'side', 'aria-label': 'Details' });
  private readonly top = element('header', { class: 'bar top' });
  private readonly bottom = element('footer', { class: 'bar bottom' });
  private readonly stage: Stage;
  private readonly time: TimeControls;
  private view: TrafficView | null = null;

  constructor(private readonly feed: Feed) {
    this.state = new State((message) => feed.say(message));
    document.body.append(element('main', {}, this.canvas, this.top, this.side, this.bottom));
    this.stage = new Stage(this.canvas);
    this.time = new TimeControls(this.state);
    this.bottom.append(this.time.root);
    this.side.append(new DriverPanel(this.state, element('div')).root);
    this.top.append(new Toolbar(this.state).root);
    this.state.isNight.set(matchMedia('(prefers-color-scheme: dark)').matches);
    this.state.isNight.watch((isNight) => (document.documentElement.dataset.mood = isNight ? 'night' : 'day'));
    listenToKeys(this.state, this.stage.rig, this.time, () => this.wholeMap());
  }

  start(): void {
    this.feed.start({
      scene: (scene) => {
        this.view = new TrafficView(localise(scene), this.stage, this.state);
        document.title = `${scene.title} – laneweave`;
      },
      message: (message) => this.hear(message),
      frame: (bytes) => this.view?.traffic.push(bytes, performance.now() / 1000),
      connection: (connection) => this.state.connection.set(connection),
    });
    requestAnimationFrame((now) => this.picture(now, now));
  }

  private hear(message: ServerMessage): void {
    const { state } = this;
    if (message.hello) {
      this.view?.restart();
      state.hello.set(message.hello);
    }
    if (message.clock) state.clock.set(message.clock);
    if (message.lights !== undefined) state.lights.set(message.lights);
    if (message.drivers) state.drivers.set(message.drivers);
    if (message.events) state.events.tell(message.events);
    if (message.marks) state.marks.set(message.marks);
    if (message.lanes) state.lanes.set(message.lanes);
    if (message.hands) state.hands.set(message.hands);
    if (message.found) state.found.tell(message.found);
    if (message.saved) state.saved.tell(message.saved);
    if (message.refused) state.refused.tell(message.refused);
  }

  private wholeMap(): void {
    if (!this.view) return;
    this.state.camera.set('free');
    this.stage.rig.frame(...this.view.scene.bounds);
  }

  private picture(now_ms: number, last_ms: number): void {
    const began = performance.now();
    if (this.view && this.state.hello.value) {
      this.view.draw(now_ms / 1000, Math.min((now_ms - last_ms) / 1000, 0.25), this.telemetry.fps);
      this.time.showTime(this.view.traffic.playback.time_s);
      this.telemetry.note(performance.now() - began, now_ms - last_ms, this.stage.renderer.info.render.calls);
      this.telemetry.publish(this.view, this.state);
    }
    requestAnimationFrame((next) => this.picture(next, now_ms));
  }
}
