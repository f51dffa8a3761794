import * as assert from 'node:assert/strict';
import { test } from 'node:test';
import { halves, holds } from '../src/stage/halves.ts';

test('a wide window is halved from left to right, and both free parts are equally large', () => {
  const [left, right] = halves(1280, 720, { top: 60, right: 380, bottom: 90 });
  assert.deepEqual(left.free, { x: 0, y: 60, width: 450, height: 570 });
  assert.deepEqual(right.free, { x: 450, y: 60, width: 450, height: 570 });
  assert.deepEqual(left.picture, { x: 0, y: 0, width: 450, height: 720 });
  // The picture goes on behind the panels.
  assert.deepEqual(right.picture, { x: 450, y: 0, width: 830, height: 720 });
});

test('a narrow window is halved from above to below', () => {
  const [upper, lower] = halves(390, 844, { top: 60, right: 0, bottom: 184 });
  assert.deepEqual(upper.free, { x: 0, y: 60, width: 390, height: 300 });
  assert.deepEqual(lower.free, { x: 0, y: 360, width: 390, height: 300 });
  assert.deepEqual([upper.picture.height, lower.picture.y, lower.picture.height], [360, 360, 484]);
});

test('each place of the window is in one of the pictures', () => {
  for (const [width, height] of [[1280, 720], [390, 844], [401, 401]]) {
    const both = halves(width, height, { top: 51, right: 0, bottom: 32 });
    for (let x = 0; x < width; x += 13) {
      for (let y = 0; y < height; y += 13) assert.equal(both.filter(({ picture }) => holds(picture, x, y)).length, 1, `${x} ${y}`);
    }
  }
});
