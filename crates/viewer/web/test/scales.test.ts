import * as assert from 'node:assert/strict';
import { test } from 'node:test';
import { PATTERNS, styleColour, stylePattern } from '../src/colour/palette.ts';
import { byteColours, colourAt, VEHICLE_SCALES } from '../src/colour/scales.ts';
import { rounded, sliderScale } from '../src/panels/slider_scale.ts';
import { nextMark, previousMark, TimelineScale } from '../src/panels/timeline_scale.ts';
import { clockTime, short } from '../src/panels/words.ts';
import type { TrafficEvent, TrafficEventKind } from '../src/protocol/messages.ts';
import { pairs, stations } from '../src/road/ribbon.ts';

test('no two of the 64 styles look the same', () => {
  const looks = new Set(Array.from({ length: 64 }, (_, style) => `${styleColour(style)} ${stylePattern(style)}`));
  assert.equal(looks.size, 64);
  assert.equal(PATTERNS.length, 8);
});

test('sequential scales get lighter or darker all the way', () => {
  for (const name of ['speed', 'delay', 'since_change', 'difference'] as const) {
    const light = [0, 0.2, 0.4, 0.6, 0.8, 1].map((share) => {
      const [red, green, blue] = colourAt(VEHICLE_SCALES[name].colours, share);
      return red * 0.3 + green * 0.59 + blue * 0.11;
    });
    const grows = light.every((value, index) => index === 0 || value > light[index - 1]);
    const falls = light.every((value, index) => index === 0 || value < light[index - 1]);
    assert.ok(grows || falls, name);
  }
});

test('the byte 0 is unknown, and 128 is no desire', () => {
  const bytes = byteColours('desire');
  assert.deepEqual([...bytes.slice(0, 3)], [0x8d, 0x93, 0x9b]);
  assert.ok(bytes[128 * 4] > 210 && bytes[128 * 4 + 2] > 210);
});

test('who does not differ from its twin is grey, and who differs by little is not', () => {
  const bytes = byteColours('difference');
  assert.deepEqual([...bytes.slice(4, 7)], [0x8d, 0x93, 0x9b]);
  assert.ok(bytes[8] > 240 && bytes[10] < 120);
});

test('a slider gives back the value that it shows', () => {
  for (const [minimum, maximum, usual] of [[0.1, 10, 1.2], [1, 10_000, 98], [null, null, 0.61], [0, null, 0.00125], [-10, 10, 0], [0, 3600, 14]] as const) {
    const scale = sliderScale(minimum, maximum, usual);
    assert.ok(Math.abs(scale.value(scale.place(usual)) - usual) < 1e-9, `${minimum} ${maximum} ${usual}`);
    assert.ok(scale.minimum <= usual && usual <= scale.maximum);
    assert.ok(Math.abs(scale.value(0) - scale.minimum) < 1e-6 && Math.abs(scale.value(1) - scale.maximum) < 1e-6 * Math.max(scale.maximum, 1));
    assert.ok(scale.value(0.4) < scale.value(0.6));
  }
  assert.equal(rounded(0.123456), 0.123);
});

test('a wide range gives its usual value a place with room around it', () => {
  const place = sliderScale(1, 10_000, 98).place(98);
  assert.ok(place > 0.1 && place < 0.9, String(place));
});

const mark = (kind: TrafficEventKind, time_s: number): TrafficEvent => ({ kind, time_s, x: 0, y: 0, vehicle: '1', other: null, side: null, text: null });

test('keys jump to the important mark that is nearest in their direction', () => {
  const marks = [mark('collision', 1), mark('lane_change', 5), mark('missed_turn', 8), mark('collision', 20)];
  assert.equal(nextMark(marks, 4)?.time_s, 8);
  assert.equal(nextMark(marks, 8)?.time_s, 20);
  assert.equal(previousMark(marks, 8)?.time_s, 1);
  assert.equal(nextMark(marks, 20), null);
  assert.equal(nextMark([mark('lane_change', 5)], 4)?.time_s, 5);
});

test('the time line finds its times again', () => {
  const scale = new TimelineScale(100, 700, 300);
  assert.equal(scale.time(scale.x(250)), 250);
  assert.equal(scale.time(-50), 100);
  assert.deepEqual(scale.ticks(100), [300, 600]);
});

test('numbers and times read well', () => {
  assert.deepEqual([short(0), short(-0.31), short(0.004387), short(1.26), short(600), short(0.00001)], ['0', '−0.31', '0.004', '1.26', '600', '1.0e−5']);
  assert.deepEqual([clockTime(0), clockTime(75.25), clockTime(3661)], ['00:00.0', '01:15.3', '1:01:01.0']);
});

test('a lane is filled between borders with different points', () => {
  const left = stations([0, 1, 0, 10, 1, 0, 20, 1, 0]);
  const right = stations([0, -1, 0, 20, -1, 0]);
  const found = pairs(left, right).map(([a, b]) => [a.x, b.x]);
  assert.deepEqual(found, [[0, 0], [10, 0], [20, 20]]);
  assert.deepEqual(left.map(({ leftX, leftY }) => [Math.abs(leftX), leftY]), [[0, 1], [0, 1], [0, 1]]);
});
