import { isImportant, lookOf, SHAPE_PATHS } from '../colour/events.ts';
import type { Hello, Marks, TrafficEvent } from '../protocol/messages.ts';
import type { State } from '../state.ts';
import { element } from './dom.ts';
import { nextMark, previousMark, TimelineScale } from './timeline_scale.ts';
import { clockTime } from './words.ts';

/** Sizes in pixels where the text has the size `USUAL_TEXT`. */
const USUAL_TEXT = 13.4;
const HEIGHT = 46;
const TRACK_TOP = 10;
const TRACK_HEIGHT = 16;
const LABELS_APART = 76;
const ARROW_S = 1;
const PAGE_S = 10;
const SEEK_EVERY_MS = 60;

/** The line of the whole time, with its marks; one can drag along it. */
export class Timeline {
  readonly root = element('canvas', {
    class: 'timeline',
    tabindex: '0',
    role: 'slider',
    'data-test': 'timeline',
    'aria-label': 'Time. Arrows go a second, Page Up and Page Down ten; comma and semicolon go to the mark before and after.',
  });
  private readonly paths = Object.fromEntries(Object.entries(SHAPE_PATHS).map(([shape, path]) => [shape, new Path2D(path)]));
  private time_s = 0;
  /** How much larger than usual the text is, and the width in pixels of usual text. */
  private size = 1;
  private width = 1;
  private drawnAt = '';
  private lastSeek_ms = 0;

  constructor(private readonly state: State) {
    state.hello.watch((hello) => {
      this.root.hidden = !hello?.can.seek || hello.end_s === null;
      this.drawnAt = '';
    });
    state.marks.watch(() => (this.drawnAt = ''));
    state.isNight.watch(() => (this.drawnAt = ''));
    new ResizeObserver(() => this.measure()).observe(this.root);
    this.root.addEventListener('pointerdown', (event) => {
      this.root.setPointerCapture(event.pointerId);
      this.seekTo(event, true);
    });
    this.root.addEventListener('pointermove', (event) => event.buttons > 0 && this.seekTo(event, false));
    this.root.addEventListener('pointerup', (event) => this.seekTo(event, true));
    this.root.addEventListener('keydown', (event) => this.key(event));
  }

  /** Shows a time. It draws only where something has changed by a pixel. */
  show(time_s: number): void {
    this.time_s = time_s;
    const { value: hello } = this.state.hello;
    if (this.root.hidden || !hello || hello.end_s === null) return;
    const scale = this.scale(hello);
    const x = Math.round(scale.x(time_s) * 2) / 2;
    const now = `${x} ${scale.width}`;
    if (now === this.drawnAt) return;
    this.drawnAt = now;
    this.draw(scale, x, this.state.marks.value);
    this.root.setAttribute('aria-valuemin', String(hello.begin_s));
    this.root.setAttribute('aria-valuemax', String(hello.end_s));
    this.root.setAttribute('aria-valuenow', time_s.toFixed(1));
    this.root.setAttribute('aria-valuetext', clockTime(time_s));
  }

  /** Goes to the next mark, or the one before. */
  jump(sign: 1 | -1): void {
    const marks = this.state.marks.value?.marks ?? [];
    const mark = sign > 0 ? nextMark(marks, this.time_s) : previousMark(marks, this.time_s);
    if (mark && this.state.hello.value?.can.seek) this.state.say({ seek: mark.time_s });
  }

  private measure(): void {
    this.size = Number.parseFloat(getComputedStyle(document.documentElement).fontSize) / USUAL_TEXT;
    this.width = Math.max(this.root.clientWidth / this.size, 1);
    this.drawnAt = '';
  }

  private key(event: KeyboardEvent): void {
    const { value: hello } = this.state.hello;
    if (!hello || hello.end_s === null) return;
    const goals: Record<string, number> = {
      ArrowLeft: this.time_s - ARROW_S,
      ArrowDown: this.time_s - ARROW_S,
      ArrowRight: this.time_s + ARROW_S,
      ArrowUp: this.time_s + ARROW_S,
      PageDown: this.time_s - PAGE_S,
      PageUp: this.time_s + PAGE_S,
      Home: hello.begin_s,
      End: hello.end_s,
    };
    const goal = goals[event.key];
    if (goal === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    this.state.say({ seek: this.scale(hello).limit(goal) });
  }

  private seekTo(event: PointerEvent, isSure: boolean): void {
    const { value: hello } = this.state.hello;
    const now = performance.now();
    if (!hello || hello.end_s === null || (!isSure && now - this.lastSeek_ms < SEEK_EVERY_MS)) return;
    this.lastSeek_ms = now;
    const { left } = this.root.getBoundingClientRect();
    this.state.say({ seek: this.scale(hello).time((event.clientX - left) / this.size) });
  }

  private scale({ begin_s, end_s }: Hello): TimelineScale {
    return new TimelineScale(begin_s, end_s ?? begin_s, this.width);
  }

  private draw(scale: TimelineScale, x: number, marks: Marks | null): void {
    const sharpness = devicePixelRatio * this.size;
    this.root.width = Math.round(scale.width * sharpness);
    this.root.height = Math.round(HEIGHT * sharpness);
    const pen = this.root.getContext('2d');
    if (!pen) return;
    const style = getComputedStyle(this.root);
    const colour = (name: string): string => style.getPropertyValue(name);
    pen.scale(sharpness, sharpness);
    pen.fillStyle = colour('--line');
    pen.fillRect(0, TRACK_TOP, scale.width, TRACK_HEIGHT);
    pen.globalAlpha = 0.25;
    pen.fillStyle = colour('--accent');
    pen.fillRect(0, TRACK_TOP, x, TRACK_HEIGHT);
    pen.globalAlpha = 1;
    for (const mark of marks?.marks ?? []) if (!isImportant(mark)) drawTick(pen, scale.x(mark.time_s), colour('--soft'));
    for (const mark of marks?.marks ?? []) if (isImportant(mark)) this.drawShape(pen, scale.x(mark.time_s), mark);
    pen.font = '11px system-ui, sans-serif';
    pen.fillStyle = colour('--soft');
    for (const time of scale.ticks(LABELS_APART)) {
      const at = scale.x(time);
      pen.textAlign = at < 20 ? 'left' : at > scale.width - 20 ? 'right' : 'center';
      pen.fillText(clockTime(time).slice(0, -2), at, HEIGHT - 5);
    }
    pen.fillStyle = colour('--accent');
    pen.fillRect(x - 1.5, TRACK_TOP - 7, 3, TRACK_HEIGHT + 12);
  }

  private drawShape(pen: CanvasRenderingContext2D, x: number, mark: TrafficEvent): void {
    const { shape, colour } = lookOf(mark);
    pen.save();
    pen.translate(x, TRACK_TOP + TRACK_HEIGHT / 2);
    pen.scale(6, 6);
    pen.fillStyle = colour;
    pen.strokeStyle = '#fff';
    pen.lineWidth = 0.25;
    pen.fill(this.paths[shape], 'evenodd');
    pen.stroke(this.paths[shape]);
    pen.restore();
  }
}

function drawTick(pen: CanvasRenderingContext2D, x: number, colour: string): void {
  pen.fillStyle = colour;
  pen.fillRect(x - 0.5, TRACK_TOP + 3, 1, TRACK_HEIGHT - 6);
}
