import type { Frame } from '../protocol/frame.ts';

/** Frames further apart than this are not joined by motion. */
const LONGEST_JOIN_S = 3;
/** A pause of the server after which its pace is measured anew. */
const PACE_FORGETS_S = 1;
const PACE_ARRIVALS = 8;
/** How much faster the page goes while a frame waits, and slower while none does. */
const CATCH_UP = 1.08;
const HOLD_BACK = 0.98;

/**
 * Which two frames are between now, and where. One frame may wait while the page moves towards the one before it, so that motion is
 * smooth although frames arrive unevenly.
 */
export class Playback {
  previous: Frame | null = null;
  next: Frame | null = null;
  /** The time that the page shows, in seconds of the simulation. */
  time_s = 0;
  private waiting: Frame | null = null;
  private lastWall_s = 0;
  private arrivals: { wall_s: number; time_s: number }[] = [];
  private pace = 1;

  /** Takes a frame that has arrived. */
  push(frame: Frame, wall_s: number): void {
    this.waiting = frame;
    const last = this.arrivals.at(-1);
    // While time stands, the same time is sent again for another view: it tells nothing of the pace.
    if (frame.time_s === last?.time_s) return;
    if (last && (wall_s - last.wall_s > PACE_FORGETS_S || frame.time_s < last.time_s)) this.arrivals.length = 0;
    this.arrivals.push({ wall_s, time_s: frame.time_s });
    if (this.arrivals.length > PACE_ARRIVALS) this.arrivals.shift();
    const first = this.arrivals[0];
    const elapsed = wall_s - first.wall_s;
    if (elapsed > 0.05) this.pace = (frame.time_s - first.time_s) / elapsed;
  }

  /** Moves on to the present. It returns the frame that has become the next one, if any. */
  advance(wall_s: number): Frame | null {
    const elapsed = Math.min(wall_s - this.lastWall_s, 0.25);
    this.lastWall_s = wall_s;
    if (!this.next) return this.takeWaiting();
    this.time_s += elapsed * this.pace * (this.waiting ? CATCH_UP : HOLD_BACK);
    if (this.waiting && (this.time_s >= this.next.time_s || !joins(this.next, this.waiting))) return this.takeWaiting();
    this.time_s = Math.min(this.time_s, this.next.time_s);
    return null;
  }

  /** 0 at the previous frame, 1 at the next one. */
  mix(): number {
    if (!this.previous || !this.next || !joins(this.previous, this.next)) return 1;
    const span = this.next.time_s - this.previous.time_s;
    return span > 0 ? Math.min(Math.max((this.time_s - this.previous.time_s) / span, 0), 1) : 1;
  }

  /** Forgets all frames, as after a lost connection. */
  clear(): void {
    this.previous = null;
    this.next = null;
    this.waiting = null;
    this.arrivals.length = 0;
  }

  private takeWaiting(): Frame | null {
    const frame = this.waiting;
    if (!frame) return null;
    this.waiting = null;
    const joined = this.next && joins(this.next, frame);
    this.previous = this.next;
    this.next = frame;
    if (this.previous && joined) {
      this.time_s = Math.min(Math.max(this.time_s, this.previous.time_s), frame.time_s);
    } else {
      this.time_s = frame.time_s;
    }
    return frame;
  }
}

function joins(earlier: Frame, later: Frame): boolean {
  const span = later.time_s - earlier.time_s;
  return span >= 0 && span <= LONGEST_JOIN_S;
}
