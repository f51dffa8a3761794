import { isImportant } from '../colour/events.ts';
import type { TrafficEvent } from '../protocol/messages.ts';

/** Marks of one time are told apart by this. */
const SAME_TIME_S = 0.05;
const STEPS = [1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200, 14_400, 28_800];

/** Which time is where on a line of a width. */
export class TimelineScale {
  constructor(
    readonly begin_s: number,
    readonly end_s: number,
    readonly width: number,
  ) {}

  x(time_s: number): number {
    return ((time_s - this.begin_s) / (this.end_s - this.begin_s || 1)) * this.width;
  }

  time(x: number): number {
    return this.limit(this.begin_s + (x / this.width) * (this.end_s - this.begin_s));
  }

  limit(time_s: number): number {
    return Math.min(Math.max(time_s, this.begin_s), this.end_s);
  }

  /** Times for labels, at least some pixels apart. */
  ticks(apart: number): number[] {
    const least = (apart / this.width) * (this.end_s - this.begin_s);
    const step = STEPS.find((one) => one >= least) ?? STEPS[STEPS.length - 1];
    const times: number[] = [];
    for (let time = Math.ceil(this.begin_s / step) * step; time <= this.end_s; time += step) times.push(time);
    return times;
  }
}

/** The nearest important mark after a time, else the nearest of any kind. */
export function nextMark(marks: readonly TrafficEvent[], time_s: number): TrafficEvent | null {
  const later = marks.filter((mark) => mark.time_s > time_s + SAME_TIME_S);
  return nearest(later, time_s);
}

/** The nearest important mark before a time, else the nearest of any kind. */
export function previousMark(marks: readonly TrafficEvent[], time_s: number): TrafficEvent | null {
  const earlier = marks.filter((mark) => mark.time_s < time_s - SAME_TIME_S);
  return nearest(earlier, time_s);
}

function nearest(marks: readonly TrafficEvent[], time_s: number): TrafficEvent | null {
  const important = marks.filter(isImportant);
  const away = (mark: TrafficEvent): number => Math.abs(mark.time_s - time_s);
  const of = important.length > 0 ? important : marks;
  return of.reduce<TrafficEvent | null>((best, mark) => (best === null || away(mark) < away(best) ? mark : best), null);
}
