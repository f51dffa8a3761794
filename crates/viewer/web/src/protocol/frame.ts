/** The binary layout of a frame: a header, a record for each slot, and a record for each vehicle that has come. */

export const HEADER_BYTES = 48;
export const RECORD_BYTES = 16;
export const RECORD_WORDS = 4;

const LAYOUT_VERSION = 1;
const FULL_TURN = 65536;
export const HEIGHT_STEPS_PER_METRE = 20;
const LOWEST_HEIGHT = -1638.4;
const SPEED_STEPS_PER_MPS = 4;

/** The bits of the third byte of the last word of a slot. */
export const FLAG_BRAKES = 8;
export const FLAG_SIGNALS_LEFT = 16;
export const FLAG_SIGNALS_RIGHT = 32;
export const FLAG_USER = 64;
export const FLAG_RECORDED = 128;
/** Both: a vehicle of the twin. */
export const FLAGS_GHOST = FLAG_USER | FLAG_RECORDED;

/** The vehicles in the view at one time. It reads the buffer of the message in place. */
export interface Frame {
  number: number;
  time_s: number;
  origin: [x: number, y: number, z: number];
  slotCount: number;
  cameCount: number;
  /** Four words for each slot. */
  words: Uint32Array;
  /** The same bytes, for x and y. */
  floats: Float32Array;
  /** Four words for each vehicle that has come. */
  came: Uint32Array;
}

/** Reads a frame. It throws if the bytes are not a frame of this layout. */
export function readFrame(buffer: ArrayBuffer): Frame {
  const view = new DataView(buffer);
  const letters = buffer.byteLength >= HEADER_BYTES ? String.fromCharCode(...new Uint8Array(buffer, 0, 3)) : '';
  if (letters !== 'LWF' || view.getUint8(3) !== LAYOUT_VERSION) {
    throw new Error('The server sends frames of another version. Load the page again.');
  }
  const slotCount = view.getUint32(40, true);
  const cameCount = view.getUint32(44, true);
  const cameAt = HEADER_BYTES + slotCount * RECORD_BYTES;
  return {
    number: view.getUint32(4, true),
    time_s: view.getFloat64(8, true),
    origin: [view.getFloat64(16, true), view.getFloat64(24, true), view.getFloat64(32, true)],
    slotCount,
    cameCount,
    words: new Uint32Array(buffer, HEADER_BYTES, slotCount * RECORD_WORDS),
    floats: new Float32Array(buffer, HEADER_BYTES, slotCount * RECORD_WORDS),
    came: new Uint32Array(buffer, cameAt, cameCount * RECORD_WORDS),
  };
}

/** The class of a slot: 0 where it is empty. */
export const classOf = (words: Uint32Array, slot: number): number => (words[slot * RECORD_WORDS + 3] >>> 16) & 7;

export const flagsOf = (words: Uint32Array, slot: number): number => (words[slot * RECORD_WORDS + 3] >>> 16) & 255;

export const isGhost = (words: Uint32Array, slot: number): boolean => (flagsOf(words, slot) & FLAGS_GHOST) === FLAGS_GHOST;

/** The id that the vehicle of the twin has for the one with this id. */
export const twinOf = (id: string): string => (-1n - BigInt(id)).toString();

/** What the server was asked for with `colour`. */
export const valueOf = (words: Uint32Array, slot: number): number => words[slot * RECORD_WORDS + 3] >>> 24;

/** The value of a vehicle that is where its twin is. */
export const SAME = 1;

export const styleOf = (words: Uint32Array, slot: number): number => (words[slot * RECORD_WORDS + 3] >>> 8) & 63;

/** In metres per second. */
export const speedOf = (words: Uint32Array, slot: number): number =>
  (words[slot * RECORD_WORDS + 3] & 255) / SPEED_STEPS_PER_MPS;

/** In radians, counter-clockwise from east. */
export const headingOf = (words: Uint32Array, slot: number): number =>
  ((words[slot * RECORD_WORDS + 2] & 0xffff) / FULL_TURN) * 2 * Math.PI;

/** In metres above the origin of the frame. */
export const heightOf = (words: Uint32Array, slot: number): number =>
  (words[slot * RECORD_WORDS + 2] >>> 16) / HEIGHT_STEPS_PER_METRE + LOWEST_HEIGHT;
