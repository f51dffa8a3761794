import { HEADER_BYTES, RECORD_BYTES } from '../src/protocol/frame.ts';

export interface Vehicle {
  slot: number;
  id: bigint;
  x: number;
  hasCome: boolean;
}

/** A frame with cars of 4.5 m by 1.8 m. */
export function frameBytes(number: number, time_s: number, slotCount: number, vehicles: Vehicle[]): ArrayBuffer {
  const came = vehicles.filter(({ hasCome }) => hasCome);
  const view = new DataView(new ArrayBuffer(HEADER_BYTES + (slotCount + came.length) * RECORD_BYTES));
  [76, 87, 70, 1].forEach((byte, at) => view.setUint8(at, byte));
  view.setUint32(4, number, true);
  view.setFloat64(8, time_s, true);
  view.setFloat64(16, 1000, true);
  view.setUint32(40, slotCount, true);
  view.setUint32(44, came.length, true);
  for (const { slot, x } of vehicles) {
    const at = HEADER_BYTES + slot * RECORD_BYTES;
    view.setFloat32(at, x, true);
    view.setUint16(at + 8, 16_384, true);
    view.setUint16(at + 10, Math.round((12.5 + 1638.4) * 20), true);
    view.setUint8(at + 12, 50);
    view.setUint8(at + 13, 3 | (2 << 6));
    view.setUint8(at + 14, 1 | 8);
  }
  came.forEach(({ slot, id }, index) => {
    const at = HEADER_BYTES + (slotCount + index) * RECORD_BYTES;
    view.setUint32(at, slot, true);
    view.setBigInt64(at + 4, id, true);
    view.setUint16(at + 12, 450, true);
    view.setUint16(at + 14, 180, true);
  });
  return view.buffer as ArrayBuffer;
}
