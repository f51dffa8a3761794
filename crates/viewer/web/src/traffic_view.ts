import { Group, Vector3 } from 'three';
import { groundAt, groundRectangle, windowAt } from './camera/ground_view.ts';
import { listenToGestures } from './camera/gestures.ts';
import { signalIcons } from './overlays/signal_icons.ts';
import { Selection } from './overlays/selection.ts';
import { twinOf } from './protocol/frame.ts';
import type { Scene } from './protocol/scene.ts';
import { LaneletIndex } from './road/lanelet_index.ts';
import { LightStates } from './road/light_states.ts';
import { paintMesh } from './road/paint.ts';
import { signalPlaces, type SignalPlace } from './road/signal_places.ts';
import { structuresMesh } from './road/structures.ts';
import { terrainOf } from './road/terrain.ts';
import { opening } from './road/opening.ts';
import { RoadSurface } from './road/surface.ts';
import { atmosphere, setNight } from './stage/atmosphere.ts';
import { groundMesh } from './stage/ground.ts';
import type { Stage } from './stage/stage.ts';
import type { State } from './state.ts';
import { Traffic, type Placed } from './traffic/traffic.ts';
import { Fleet } from './vehicles/fleet.ts';
import { show, type Shown } from './vehicles/shown.ts';

const BLINK_PERIOD_S = 0.8;
const VIEW_EVERY_S = 0.25;
const SORT_EVERY_S = 0.2;
/** How far the page asks for vehicles where the camera sees to the horizon. */
const LEAST_SIGHT_M = 900;
const SIGHT_BY_DISTANCE = 5;
const CLICK_PIXELS = 6;
const MIDDLE_PIXELS = 30;
const SIGNAL_CLICK_M = 4;

/** The moving picture of one scene: roads, signals and vehicles, and what a click on it means. */
export class TrafficView {
  readonly traffic: Traffic;
  readonly index: LaneletIndex;
  readonly fleet = new Fleet();
  readonly surface: RoadSurface;
  readonly signals: SignalPlace[];
  /** What is drawn in addition. Each is called once for each picture. */
  readonly onPicture: (() => void)[] = [];
  private readonly lights: LightStates;
  private readonly selection = new Selection();
  private readonly anchor = new Vector3();
  private sentView = '';
  private lastView_s = 0;
  private lastSort_s = 0;
  private hasReady = false;

  constructor(
    readonly scene: Scene,
    readonly stage: Stage,
    private readonly state: State,
  ) {
    this.traffic = new Traffic(scene.origin);
    this.index = new LaneletIndex(scene.lanelets);
    this.surface = new RoadSurface(scene);
    this.lights = new LightStates(scene.lights.length);
    this.signals = signalPlaces(scene, this.index);
    const road = new Group();
    road.add(groundMesh(terrainOf(scene)), this.surface.mesh, paintMesh(scene, this.lights.texture), structuresMesh(scene, this.index, this.signals, this.lights));
    stage.graph.add(road, this.fleet.group, this.selection.group, signalIcons(this.signals, this.lights));
    stage.rig.frame(...opening(scene));
    stage.rig.settle();
    state.isNight.watch(setNight);
    state.colour.watch((colour) => this.fleet.colourBy(colour));
    this.listen();
  }

  /** Starts anew with the server: it sends all vehicles again. */
  restart(): void {
    this.traffic.clear();
    this.sentView = '';
    this.hasReady = false;
  }

  /** Draws the picture of now. */
  draw(wall_s: number, elapsed_s: number, fps: number): void {
    const { rig } = this.stage;
    const frame = this.traffic.advance(wall_s);
    this.stage.lay(elapsed_s, this.state.twinView.value === 'side');
    this.moveCamera(elapsed_s);
    this.sendView(wall_s);
    if (frame || wall_s - this.lastSort_s > SORT_EVERY_S) {
      this.fleet.sort(this.traffic.playback, this.traffic.slots, rig.camera, this.scene.origin, fps);
      this.lastSort_s = wall_s;
    }
    if (frame || !this.hasReady) {
      this.state.say({ ready: frame?.number ?? 0 });
      this.hasReady = true;
    }
    this.anchor.set(Math.round(rig.now.x), Math.round(rig.now.y), Math.round(rig.now.z));
    this.fleet.place(this.traffic.playback, this.anchor, this.scene.origin);
    atmosphere.blink.value = (wall_s / BLINK_PERIOD_S) % 1 < 0.55 ? 1 : 0;
    for (const update of this.onPicture) update();
    this.stage.draw((which) => this.prepare(which));
  }

  /** Gets ready to draw a picture of all, of the traffic, or of its twin. */
  private prepare(which: Shown): void {
    const { state, traffic } = this;
    show(which);
    const isTwin = which === 'twin';
    this.lights.show(isTwin ? state.twinLights.value : state.lights.value);
    const isInside = state.camera.value === 'eye';
    const chosen = isInside ? [] : state.selected.value.map((id) => traffic.locate(isTwin ? twinOf(id) : id));
    this.selection.update(chosen, this.stage.rig.now.distance);
  }

  /** Where a place of the window is on the road. */
  ground(x: number, y: number): { x: number; y: number } | null {
    const { camera, now } = this.stage.rig;
    const [across, up] = this.stage.placeInPicture(x, y);
    return groundAt(camera, across, up, now.z);
  }

  /** Where a place of the road is in the window [px], in the picture of the traffic or in that of its twin: the inverse of `ground`. */
  pixel(x: number, y: number, isInTwin = false): { left: number; top: number } {
    const { left, top, width, height } = this.stage.canvas.getBoundingClientRect();
    const half = this.stage.halves?.[isInTwin ? 1 : 0] ?? null;
    this.stage.aim(half);
    const picture = half?.picture ?? { x: 0, y: 0, width, height };
    const { camera, now } = this.stage.rig;
    const { across, up } = windowAt(camera, x, y, now.z);
    return { left: left + picture.x + ((across + 1) / 2) * picture.width, top: top + picture.y + ((1 - up) / 2) * picture.height };
  }

  /** Where a vehicle is, even if it is out of view. */
  whereIs(id: string): { x: number; y: number } | null {
    const placed = this.placeOf(id);
    if (placed) return placed;
    const driver = this.state.drivers.value.find((one) => one.id === id);
    return driver ? { x: driver.x - this.scene.origin[0], y: driver.y - this.scene.origin[1] } : null;
  }

  /** A vehicle in view, in the traffic or else in its twin. */
  private placeOf(id: string): Placed | null {
    return this.traffic.locate(id) ?? (this.state.twinView.value === 'none' ? null : this.traffic.locate(twinOf(id)));
  }

  private moveCamera(elapsed_s: number): void {
    const { rig } = this.stage;
    const mode = this.state.camera.value;
    const [id] = this.state.selected.value;
    const isBound = mode !== 'free' && id !== undefined;
    const place = isBound ? this.whereIs(id) : null;
    const vehicle = isBound ? this.placeOf(id) : null;
    if (place) {
      rig.goal.x = place.x;
      rig.goal.y = place.y;
      if (mode === 'follow') Object.assign(rig.now, { x: glide(rig.now.x, place.x), y: glide(rig.now.y, place.y) });
    }
    rig.goal.z = vehicle ? vehicle.z : this.index.height(rig.goal.x, rig.goal.y);
    rig.update(elapsed_s);
    if (mode === 'eye' && vehicle) this.sitIn(vehicle);
  }

  private sitIn({ x, y, z, heading, length, form }: Placed): void {
    const { ahead, up } = EYES[form] ?? EYES[1];
    const forward = ahead(length);
    this.stage.rig.sitAt(x + Math.cos(heading) * forward, y + Math.sin(heading) * forward, z + up, heading);
  }

  private sendView(wall_s: number): void {
    if (wall_s - this.lastView_s < VIEW_EVERY_S) return;
    const { camera, now } = this.stage.rig;
    const sight = Math.max(now.distance * SIGHT_BY_DISTANCE, LEAST_SIGHT_M);
    const [x0, y0, x1, y1] = this.stage.eachPicture(() => groundRectangle(camera, now.z, sight)).reduce(around);
    const [ox, oy] = this.scene.origin;
    const view = [x0 + ox, y0 + oy, x1 + ox, y1 + oy].map((value) => Math.round(value)) as [number, number, number, number];
    const text = view.join(' ');
    if (text === this.sentView) return;
    this.state.say({ view });
    this.sentView = text;
    this.lastView_s = wall_s;
  }

  private listen(): void {
    const { rig, canvas } = this.stage;
    const metres = () => this.stage.pixel * rig.now.distance;
    listenToGestures(canvas, {
      drag: (dx, dy) => {
        if (this.state.camera.value === 'follow') this.state.camera.set('free');
        rig.pan(-dx * metres(), (dy * metres()) / Math.max(Math.cos(rig.now.tilt), 0.3));
      },
      turn: (dx, dy) => rig.turn(dx * 0.005, -dy * 0.004),
      zoom: (factor, x, y) => {
        const point = this.state.camera.value === 'free' ? this.ground(x, y) : null;
        rig.zoom(factor, point?.x, point?.y);
      },
      click: (x, y, isSecond) => this.click(x, y, isSecond),
    });
  }

  private click(x: number, y: number, isSecond: boolean): void {
    const point = this.ground(x, y);
    if (!point) return;
    this.select(point, CLICK_PIXELS, this.stage.isInTwin(x, y), isSecond);
  }

  /** Selects what is in the middle of the picture: a vehicle if there is one near it. */
  selectInMiddle(isSecond: boolean): void {
    this.select(this.stage.rig.now, MIDDLE_PIXELS, false, isSecond);
  }

  /** Selects what is within some pixels of a point of the road. */
  private select(point: { x: number; y: number }, pixels: number, isInTwin: boolean, isSecond: boolean): void {
    const reach = pixels * this.stage.pixel * this.stage.rig.now.distance;
    const id = this.traffic.pick(point.x, point.y, reach, isInTwin);
    if (id !== null) {
      this.state.select(id, isSecond);
      return;
    }
    if (isSecond) return;
    this.state.choose([]);
    const signal = this.signals.find(({ head }) => Math.hypot(head[0] - point.x, head[1] - point.y) < SIGNAL_CLICK_M + reach);
    this.state.light.set(signal ? signal.light : null);
    this.state.lane.set(signal ? null : this.index.at(point.x, point.y));
  }
}

type Bounds = [x0: number, y0: number, x1: number, y1: number];

const around = (a: Bounds, b: Bounds): Bounds => [Math.min(a[0], b[0]), Math.min(a[1], b[1]), Math.max(a[2], b[2]), Math.max(a[3], b[3])];

/** Where the eyes of drivers are: from the centre ahead, and above the road. */
const EYES: Record<number, { ahead: (length: number) => number; up: number }> = {
  1: { ahead: (length) => length * 0.27, up: 1.22 },
  2: { ahead: (length) => length * 0.5 + 0.1, up: 2.4 },
  3: { ahead: (length) => length * 0.5 + 0.1, up: 2.1 },
  4: { ahead: () => 0.3, up: 1.5 },
  5: { ahead: (length) => length * 0.5 + 0.05, up: 1.4 },
};

/** Follows closely, without a jump where the vehicle was far away. */
const glide = (now: number, place: number): number => now + (place - now) * (Math.abs(place - now) < 30 ? 0.35 : 0.08);
