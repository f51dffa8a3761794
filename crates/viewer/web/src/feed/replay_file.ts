import { HEADER_BYTES, RECORD_BYTES, RECORD_WORDS, readFrame, type Frame } from '../protocol/frame.ts';
import type { Hello, Marks, TrafficEvent } from '../protocol/messages.ts';
import type { Scene } from '../protocol/scene.ts';

/** A replay inside the page. */
export interface ReplayFile {
  scene: Scene;
  hello: Hello;
  frames: { encoding: 'deflate-base64'; data: string };
  /** What the lights show from a time on, a letter for each. */
  lights?: [time_s: number, letters: string][];
  marks?: Marks | TrafficEvent[] | null;
  events?: TrafficEvent[] | null;
}

/** The bytes of all frames, unpacked. */
export async function unpack(base64: string): Promise<ArrayBuffer> {
  const letters = atob(base64);
  const packed = new Uint8Array(letters.length);
  for (let at = 0; at < letters.length; at += 1) packed[at] = letters.charCodeAt(at);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Response(stream).arrayBuffer();
}

/** Who came into a slot with which frame. */
interface Arrival {
  frame: number;
  /** The record of the vehicle. */
  record: Uint32Array;
}

/** All frames of a replay, and who is in which slot at any of them. */
export class FrameStore {
  readonly times: Float64Array;
  private readonly frames: ArrayBuffer[] = [];
  private readonly arrivals = new Map<number, Arrival[]>();

  /** Reads frames one after the other; each has its length before it. */
  constructor(bytes: ArrayBuffer) {
    const view = new DataView(bytes);
    const times: number[] = [];
    for (let at = 0; at + 4 <= bytes.byteLength; ) {
      const length = view.getUint32(at, true);
      const buffer = bytes.slice(at + 4, at + 4 + length);
      const frame = readFrame(buffer);
      this.note(frame, this.frames.length);
      this.frames.push(buffer);
      times.push(frame.time_s);
      at += 4 + length;
    }
    this.times = Float64Array.from(times);
  }

  get count(): number {
    return this.frames.length;
  }

  /** The last frame at a time or before it; the first one if there is none. */
  at(time_s: number): number {
    let [low, high] = [0, this.count - 1];
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.times[middle] <= time_s + 1e-6) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  /** A frame for a page that has the frame before it. */
  following(index: number): ArrayBuffer {
    return this.frames[index];
  }

  /** A frame for a page that has another one, or none: every vehicle in it has just come. */
  alone(index: number): ArrayBuffer {
    const frame = readFrame(this.frames[index]);
    const came = this.occupants(frame, index);
    const slotBytes = frame.slotCount * RECORD_BYTES;
    const bytes = new Uint8Array(HEADER_BYTES + slotBytes + came.length * RECORD_BYTES);
    bytes.set(new Uint8Array(this.frames[index], 0, HEADER_BYTES + slotBytes));
    new DataView(bytes.buffer).setUint32(44, came.length, true);
    const words = new Uint32Array(bytes.buffer, HEADER_BYTES + slotBytes);
    came.forEach((record, at) => words.set(record, at * RECORD_WORDS));
    return bytes.buffer;
  }

  private note(frame: Frame, index: number): void {
    for (let at = 0; at < frame.came.length; at += RECORD_WORDS) {
      const record = frame.came.slice(at, at + RECORD_WORDS);
      const known = this.arrivals.get(record[0]);
      if (known) known.push({ frame: index, record });
      else this.arrivals.set(record[0], [{ frame: index, record }]);
    }
  }

  private occupants(frame: Frame, index: number): Uint32Array[] {
    const found: Uint32Array[] = [];
    for (let slot = 0; slot < frame.slotCount; slot += 1) {
      const last = this.arrivals.get(slot)?.findLast((arrival) => arrival.frame <= index);
      if (last) found.push(last.record);
    }
    return found;
  }
}

/** The marks of a file, whichever of its two forms they have. */
export function marksOf({ marks, events, hello }: ReplayFile): Marks {
  if (marks && !Array.isArray(marks)) return marks;
  return { until_s: hello.end_s ?? 0, marks: marks ?? events ?? [] };
}
