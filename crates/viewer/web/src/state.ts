import type { Heat, VehicleColour } from './colour/scales.ts';
import type { Connection } from './feed/feed.ts';
import type {
  Clock,
  Driver,
  Found,
  Hand,
  HandEntry,
  Hello,
  LaneMeasure,
  Marks,
  PageMessage,
  Refused,
  Saved,
  TrafficEvent,
  Twin,
  VehicleClass,
} from './protocol/messages.ts';
import { Happening, Signal } from './signal.ts';

export type CameraMode = 'free' | 'follow' | 'eye';
export type TwinView = 'none' | 'ghosts' | 'side';
export type Trails = 'none' | 'selected' | 'all';

/** What the page knows and shows. Panels and the picture watch it; they do not know each other. */
export class State {
  readonly hello = new Signal<Hello | null>(null);
  readonly clock = new Signal<Clock | null>(null);
  readonly connection = new Signal<Connection>({ state: 'connecting' });
  readonly lights = new Signal('');
  readonly twinLights = new Signal('');
  /** The twin that the server shows. */
  readonly twin = new Signal<Twin | null>(null);
  readonly drivers = new Signal<Driver[]>([]);
  readonly marks = new Signal<Marks | null>(null);
  readonly lanes = new Signal<LaneMeasure[]>([]);
  /** All that was done by hand. */
  readonly done = new Signal<HandEntry[]>([]);
  /** What is set by hand, as it is now. */
  readonly set = new Signal<Hand[]>([]);
  /** The vehicle that this page has put on the road. */
  readonly put = new Happening<string>();
  readonly events = new Happening<TrafficEvent[]>();
  readonly found = new Happening<Found>();
  readonly refused = new Happening<Refused>();
  readonly saved = new Happening<Saved>();

  readonly selected = new Signal<string[]>([]);
  readonly lane = new Signal<number | null>(null);
  readonly light = new Signal<number | null>(null);
  /** The ids of the lanelets that are closed by hand. */
  readonly closed = new Signal<ReadonlySet<string>>(new Set());
  /** The vehicle that the keys drive. */
  readonly driven = new Signal<string | null>(null);
  /** The class of the vehicle that is being dragged onto the road. */
  readonly carried = new Signal<VehicleClass | null>(null);

  readonly colour = new Signal<VehicleColour>('style');
  readonly heat = new Signal<Heat>('none');
  readonly trails = new Signal<Trails>('none');
  readonly showsChanges = new Signal(false);
  readonly showsArrows = new Signal(false);
  /** How the twin is shown: not at all, as ghosts, or side by side with the traffic. */
  readonly twinView = new Signal<TwinView>('none');
  readonly isNight = new Signal(false);
  readonly camera = new Signal<CameraMode>('free');

  constructor(
    /** Whether there is a server that measures lanes, and says of vehicles what a frame has no room for. */
    readonly hasServer: boolean,
    readonly say: (message: PageMessage) => void,
  ) {}

  /** Selects a vehicle; as the second one if there is a first. */
  select(id: string, isSecond: boolean): void {
    const [first] = this.selected.value;
    const chosen = isSecond && first !== undefined && first !== id ? [first, id] : [id];
    this.lane.set(null);
    this.light.set(null);
    this.choose(chosen);
  }

  choose(ids: string[]): void {
    this.selected.set(ids);
    if (ids.length === 0) {
      this.drivers.set([]);
      this.camera.set('free');
    }
    this.say({ select: ids });
  }
}
