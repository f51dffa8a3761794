import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { Hand } from '../src/protocol/messages.ts';
import { closedBy, settingOf } from '../src/settings.ts';

const parameter = (style: string, key: string, value: number): Hand => ({ set_parameter: { style, parameter: key, value } });

test('what sets the same number has the same name, and nothing else has', () => {
  const all: Hand[] = [
    parameter('aggressive', 'change.speed.weight', 1),
    parameter('aggressive', 'change.comfort.weight', 2),
    parameter('conservative', 'change.speed.weight', 3),
    { set_share: { style: 'aggressive', weight: 4 } },
    { set_demand: { origin: '7', vehicles_per_hour: 5 } },
    { set_offset: { light: '7', offset_s: 6 } },
  ];
  const names = all.map((hand) => settingOf(hand)?.name);
  assert.equal(new Set(names).size, all.length);
  assert.deepEqual(all.map((hand) => settingOf(hand)?.value), [1, 2, 3, 4, 5, 6]);
  assert.equal(settingOf(parameter('aggressive', 'change.speed.weight', 9))?.name, names[0]);
  assert.equal(settingOf({ remove: { vehicle: '7' } }), null);
});

test('a lanelet is closed until it is opened', () => {
  const close = (lanelet: string, is_closed: boolean): Hand => ({ close_lanelet: { lanelet, is_closed } });
  assert.deepEqual([...closedBy([close('1', true), close('2', false), parameter('a', 'b', 1)])], ['1']);
});
