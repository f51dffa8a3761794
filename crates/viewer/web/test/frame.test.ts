import * as assert from 'node:assert/strict';
import { test } from 'node:test';
import { FrameStore } from '../src/feed/replay_file.ts';
import { classOf, flagsOf, headingOf, heightOf, readFrame, speedOf, styleOf } from '../src/protocol/frame.ts';
import { Playback } from '../src/traffic/playback.ts';
import { Slots } from '../src/traffic/slots.ts';
import { frameBytes } from './frames.ts';

test('a frame is read as it was written', () => {
  const { number, time_s, origin, words, floats, slotCount } = readFrame(frameBytes(7, 12.5, 3, [{ slot: 1, id: 42n, x: 3.25, hasCome: true }]));
  assert.deepEqual([number, time_s, origin, slotCount], [7, 12.5, [1000, 0, 0], 3]);
  assert.deepEqual([classOf(words, 0), classOf(words, 1), flagsOf(words, 1), styleOf(words, 1)], [0, 1, 9, 3]);
  assert.equal(floats[4], 3.25);
  assert.equal(speedOf(words, 1), 12.5);
  assert.equal(headingOf(words, 1), Math.PI / 2);
  assert.ok(Math.abs(heightOf(words, 1) - 12.5) < 1e-9);
});

test('other bytes are refused', () => {
  assert.throws(() => readFrame(new ArrayBuffer(10)), /another version/);
});

test('a slot keeps its vehicle, and ids of 64 bits stay exact', () => {
  const slots = new Slots();
  const id = 9_007_199_254_740_993n;
  slots.take(readFrame(frameBytes(1, 0, 2, [{ slot: 1, id, x: 0, hasCome: true }, { slot: 0, id: -5n, x: 0, hasCome: true }])));
  assert.ok(slots.hasJustCome(1));
  assert.equal(slots.id(0), '-5');
  assert.equal(slots.find('-5', -1), 0);
  slots.take(readFrame(frameBytes(2, 0.1, 2, [{ slot: 1, id, x: 1, hasCome: false }])));
  assert.ok(!slots.hasJustCome(1));
  assert.equal(slots.id(1), String(id));
  assert.equal(slots.find('-5', 0), -1, 'a vehicle that has left is found no more');
  assert.equal(slots.find(String(id), -1), 1);
  assert.equal(slots.find('17', 1), -1);
  assert.deepEqual([slots.length(1), slots.width(1)], [4.5, 1.8]);
});

test('time goes on between two frames, and never past the later one', () => {
  const playback = new Playback();
  const push = (number: number, time_s: number, wall_s: number) => playback.push(readFrame(frameBytes(number, time_s, 0, [])), wall_s);
  push(1, 10, 100);
  assert.equal(playback.advance(100)?.number, 1);
  playback.advance(100.1);
  push(2, 10.1, 100.1);
  assert.equal(playback.advance(100.101)?.number, 2);
  assert.ok(playback.mix() < 0.02, String(playback.mix()));
  playback.advance(100.15);
  assert.ok(playback.mix() > 0.3 && playback.mix() < 0.7, String(playback.mix()));
  playback.advance(100.4);
  assert.equal(playback.mix(), 1);
  assert.equal(playback.time_s, 10.1);
});

test('a time that is sent again while time stands does not stop what comes after it', () => {
  const playback = new Playback();
  let wall_s = 100;
  const push = (number: number, time_s: number): void => playback.push(readFrame(frameBytes(number, time_s, 0, [])), wall_s);
  const see = (seconds: number): void => {
    for (const end = wall_s + seconds; wall_s < end; wall_s += 0.02) playback.advance(wall_s);
  };
  for (let number = 1; number <= 5; number += 1) {
    push(number, 10 + number * 0.1);
    see(0.1);
  }
  see(1.5);
  for (let again = 0; again < 2; again += 1) {
    push(5, 10.5);
    see(0.25);
  }
  see(1.5);
  push(6, 10.6);
  see(1.5);
  assert.equal(playback.time_s, 10.6);
  push(7, 10.7);
  see(1.5);
  assert.equal(playback.time_s, 10.7);
});

test('after a jump in time vehicles are where they are, without motion', () => {
  const playback = new Playback();
  playback.push(readFrame(frameBytes(1, 10, 0, [])), 100);
  playback.advance(100);
  playback.push(readFrame(frameBytes(2, 5, 0, [])), 100.05);
  assert.equal(playback.advance(100.06)?.number, 2);
  assert.equal(playback.mix(), 1);
  assert.equal(playback.time_s, 5);
});

test('a frame of a file tells all vehicles to a page that jumps to it', () => {
  const frames = [
    frameBytes(1, 0, 2, [{ slot: 0, id: 1n, x: 0, hasCome: true }]),
    frameBytes(2, 1, 2, [{ slot: 0, id: 1n, x: 9, hasCome: false }, { slot: 1, id: 2n, x: 0, hasCome: true }]),
    frameBytes(3, 2, 2, [{ slot: 0, id: 3n, x: 5, hasCome: true }, { slot: 1, id: 2n, x: 8, hasCome: false }]),
  ];
  const packed = new Uint8Array(frames.reduce((sum, { byteLength }) => sum + 4 + byteLength, 0));
  let at = 0;
  for (const frame of frames) {
    new DataView(packed.buffer).setUint32(at, frame.byteLength, true);
    packed.set(new Uint8Array(frame), at + 4);
    at += 4 + frame.byteLength;
  }
  const store = new FrameStore(packed.buffer);
  assert.deepEqual([store.count, store.at(-1), store.at(1.5), store.at(99)], [3, 0, 1, 2]);
  const slots = new Slots();
  slots.take(readFrame(store.alone(2)));
  assert.deepEqual([slots.id(0), slots.id(1)], ['3', '2']);
  slots.take(readFrame(store.alone(1)));
  assert.deepEqual([slots.id(0), slots.id(1)], ['1', '2']);
});
