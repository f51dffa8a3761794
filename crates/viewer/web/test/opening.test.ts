import assert from 'node:assert/strict';
import { test } from 'node:test';
import { opening } from '../src/road/opening.ts';

const lane = (...centre: number[]) => ({ id: '1', left: [], right: [], centre, limit_kmh: 50, is_conflict: false, only_for: null });

test('a small map is shown as a whole', () => {
  assert.deepEqual(opening({ bounds: [-100, -50, 900, 50], lanelets: [lane(0, 0, 0, 10, 0, 0)] }), [-100, -50, 900, 50]);
});

test('a large map opens where most road is, in its own parts', () => {
  const lonely = lane(-5000, 0, 0, -4900, 0, 0);
  const town = [0, 1, 2].map((row) => lane(2000, 10 * row, 0, 2080, 10 * row, 0));
  assert.deepEqual(opening({ bounds: [-5000, 0, 2100, 50], lanelets: [lonely, ...town] }), [1690, -340, 2390, 360]);
});
