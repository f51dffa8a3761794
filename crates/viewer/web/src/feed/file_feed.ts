import { classOf, flagsOf, FLAG_RECORDED, FLAG_USER, readFrame, speedOf, styleOf, RECORD_WORDS, type Frame } from '../protocol/frame.ts';
import type { Driver, Marks, PageMessage, VehicleClass } from '../protocol/messages.ts';
import { Slots } from '../traffic/slots.ts';
import type { Feed, FeedListener } from './feed.ts';
import { FrameStore, marksOf, unpack, type ReplayFile } from './replay_file.ts';

const TICK_MS = 15;
const CLOCK_EVERY_MS = 500;
const FASTEST = 1000;
const KMH_PER_MPS = 3.6;
const NOBODY = -2;
const CLASS_NAMES: readonly VehicleClass[] = ['car', 'car', 'truck', 'bus', 'motorcycle', 'other'];

/** A replay that the page brings along. It keeps the time itself, and answers as a server would. */
export class FileFeed implements Feed {
  readonly hasServer = false;
  private listener: FeedListener | null = null;
  private store: FrameStore | null = null;
  private marks: Marks;
  private readonly slots = new Slots();
  private time_s: number;
  private isPlaying = false;
  private factor: number | null = 1;
  private isReady = false;
  private sent = NOBODY;
  private told = 0;
  private selected: string[] = [];
  private lights = '';
  private lastTick_ms = 0;
  private lastClock_ms = 0;

  constructor(private readonly file: ReplayFile) {
    this.time_s = file.hello.begin_s;
    this.marks = marksOf(file);
  }

  start(listener: FeedListener): void {
    this.listener = listener;
    void this.open(listener);
  }

  say(message: PageMessage): void {
    if ('ready' in message) this.isReady = true;
    if ('play' in message) this.play(message.play);
    if ('pause' in message) this.isPlaying = false;
    if ('step' in message) this.step(message.step);
    if ('seek' in message) this.seek(message.seek);
    if ('select' in message) {
      this.selected = message.select;
      this.tellDrivers();
    }
    if ('find' in message) this.find(message.find);
    if ('play' in message || 'pause' in message || 'step' in message || 'seek' in message) this.tellClock();
  }

  private async open(listener: FeedListener): Promise<void> {
    const { scene, hello, frames } = this.file;
    listener.scene(scene);
    this.store = new FrameStore(await unpack(frames.data));
    const can = { hands: false, seek: true, explain: false, twin: false };
    const end_s = hello.end_s ?? this.store.times[this.store.count - 1];
    listener.connection({ state: 'open' });
    listener.message({ hello: { ...hello, can, end_s } });
    listener.message({ marks: this.marks });
    this.tellClock();
    this.lastTick_ms = performance.now();
    setInterval(() => this.tick(), TICK_MS);
  }

  private tick(): void {
    const now = performance.now();
    const elapsed_s = (now - this.lastTick_ms) / 1000;
    this.lastTick_ms = now;
    if (this.isPlaying) this.goTo(this.time_s + elapsed_s * (this.factor ?? FASTEST));
    if (now - this.lastClock_ms > CLOCK_EVERY_MS) this.tellClock();
    this.send();
  }

  /** Goes on to a time, and tells what has happened up to it. */
  private goTo(time_s: number): void {
    const end_s = this.store?.times.at(-1) ?? 0;
    this.time_s = Math.min(time_s, end_s);
    if (this.time_s >= end_s) this.isPlaying = false;
    const { marks } = this.marks;
    const from = this.told;
    while (this.told < marks.length && marks[this.told].time_s <= this.time_s) this.told += 1;
    if (this.told > from) this.listener?.message({ events: marks.slice(from, this.told) });
  }

  /** Sends the frame towards which the page shall move, once it is ready for one. */
  private send(): void {
    const { store, listener } = this;
    if (!store || !listener || !this.isReady) return;
    const index = Math.min(store.at(this.time_s) + (this.isPlaying ? 1 : 0), store.count - 1);
    if (index === this.sent) return;
    const bytes = index === this.sent + 1 ? store.following(index) : store.alone(index);
    this.sent = index;
    this.isReady = false;
    const frame = readFrame(bytes);
    this.slots.take(frame);
    listener.frame(bytes);
    this.tellLights(frame.time_s);
    this.tellDrivers();
  }

  private play(factor: number | null): void {
    const end_s = this.store?.times.at(-1) ?? 0;
    if (this.time_s >= end_s) this.seek(this.file.hello.begin_s);
    this.factor = factor;
    this.isPlaying = true;
  }

  private step(count: number): void {
    if (!this.store) return;
    this.isPlaying = false;
    const index = Math.min(this.store.at(this.time_s) + count, this.store.count - 1);
    this.goTo(this.store.times[index]);
  }

  private seek(time_s: number): void {
    this.time_s = time_s;
    const later = this.marks.marks.findIndex((mark) => mark.time_s > time_s);
    this.told = later < 0 ? this.marks.marks.length : later;
    // The page gets this frame instead of the one for which it waits.
    this.isReady = true;
    this.sent = NOBODY;
  }

  private find(id: string): void {
    const frame = this.present();
    const slot = this.slots.find(id, -1);
    if (!frame || slot < 0) {
      this.listener?.message({ found: { id } });
      return;
    }
    const [x, y] = [frame.floats[slot * RECORD_WORDS] + frame.origin[0], frame.floats[slot * RECORD_WORDS + 1] + frame.origin[1]];
    this.listener?.message({ found: { id, x, y } });
  }

  private tellClock(): void {
    this.lastClock_ms = performance.now();
    const frame = this.present();
    let vehicles = 0;
    for (let slot = 0; frame && slot < frame.slotCount; slot += 1) vehicles += classOf(frame.words, slot) > 0 ? 1 : 0;
    const { time_s, isPlaying: is_playing, factor } = this;
    this.listener?.message({ clock: { time_s, is_playing, factor, vehicles, waiting: 0 } });
  }

  private tellLights(time_s: number): void {
    const lights = this.file.lights?.findLast(([from_s]) => from_s <= time_s)?.[1];
    if (lights === undefined || lights === this.lights) return;
    this.lights = lights;
    this.listener?.message({ lights });
  }

  private tellDrivers(): void {
    const frame = this.present();
    if (!frame || this.selected.length === 0) return;
    const drivers = this.selected.map((id) => this.driver(frame, id)).filter((driver) => driver !== null);
    this.listener?.message({ drivers });
  }

  private present(): Frame | null {
    return this.store && this.sent >= 0 ? readFrame(this.store.following(this.sent)) : null;
  }

  /** What a frame knows of a driver. */
  private driver(frame: Frame, id: string): Driver | null {
    const slot = this.slots.find(id, -1);
    if (slot < 0) return null;
    const flags = flagsOf(frame.words, slot);
    const isRecorded = (flags & FLAG_RECORDED) !== 0;
    const phase = (frame.words[slot * RECORD_WORDS + 3] >>> 14) & 3;
    return {
      id,
      class: CLASS_NAMES[classOf(frame.words, slot)] ?? 'other',
      style: isRecorded ? null : (this.file.hello.styles[styleOf(frame.words, slot)]?.name ?? null),
      state: isRecorded ? null : ['cruises', 'wants', 'changes', 'aborts'][phase],
      side: null,
      concentration: null,
      speed_kmh: speedOf(frame.words, slot) * KMH_PER_MPS,
      desired_kmh: null,
      acceleration_mps2: null,
      x: frame.floats[slot * RECORD_WORDS] + frame.origin[0],
      y: frame.floats[slot * RECORD_WORDS + 1] + frame.origin[1],
      length_m: this.slots.length(slot),
      lanelet: null,
      position_m: null,
      destination: null,
      is_external: (flags & FLAG_USER) !== 0,
      leader: null,
      sides: [],
      gap_test: null,
      act: null,
      story: null,
    };
  }
}
