import * as assert from 'node:assert/strict';
import { test } from 'node:test';
import type { Scene } from '../src/protocol/scene.ts';
import { LaneletIndex } from '../src/road/lanelet_index.ts';
import { localise } from '../src/road/localise.ts';
import { terrainOf } from '../src/road/terrain.ts';

/** A lane from west to east that rises by 10 m in a kilometre. */
function slope(): Scene {
  const line = (y: number) => Array.from({ length: 51 }, (_, index) => [100 + index * 20, y, index * 0.2]).flat();
  return {
    version: 1,
    title: 'slope',
    driving_side: 'right',
    origin: [5000, 7000, 0],
    bounds: [100, -2, 1100, 2],
    lanelets: [{ id: '1', left: line(2), right: line(-2), centre: line(0), limit_kmh: 50, is_conflict: false, only_for: null }],
    markings: [],
    crosswalks: [],
    stop_lines: [],
    lights: [],
    entrances: [],
    exits: [],
  };
}

test('the ground is below the road everywhere, and near it', () => {
  const scene = localise(slope());
  const { xs, ys, heights } = terrainOf(scene);
  const { left } = scene.lanelets[0];
  for (let at = 0; at < left.length; at += 3) {
    const column = xs.findLastIndex((x) => x <= left[at]);
    const row = ys.findLastIndex((y) => y <= left[at + 1]);
    for (const node of [0, 1, xs.length, xs.length + 1]) {
      const height = heights[row * xs.length + column + node];
      assert.ok(height < left[at + 2] && height > left[at + 2] - 2, `${height} under ${left[at + 2]}`);
    }
  }
});

test('the middle of the map becomes zero, and the map keeps its places', () => {
  const scene = localise(slope());
  assert.deepEqual(scene.bounds, [-500, -2, 500, 2]);
  assert.equal(scene.lanelets[0].left[0] + scene.origin[0], 5100);
});

test('a point finds its lanelet and the height of the road', () => {
  const index = new LaneletIndex(slope().lanelets);
  assert.equal(index.at(600, 0), 0);
  assert.equal(index.at(600, 3), null);
  assert.ok(Math.abs(index.height(600, 0) - 5) < 0.3);
  assert.ok(!index.hasRoadBelow(600, 0, -3));
});
