import assert from 'node:assert/strict';
import { test } from 'node:test';
import { withNews } from '../src/hands.ts';
import type { Hand, HandEntry, Hands } from '../src/protocol/messages.ts';

const entry = (number: number, is_undone = false): HandEntry => ({ number, time_s: number, text: `${number}`, is_undone });
const share = (style: string, weight: number): Hand => ({ set_share: { style, weight } });
const close = (lanelet: string, is_closed: boolean): Hand => ({ close_lanelet: { lanelet, is_closed } });

test('news are added to what is known, or take its place', () => {
  const first: Hands = { done: [entry(1), entry(2)], set: [share('a', 1), share('b', 2), close('7', true)] };
  const all = withNews({ done: [], set: [] }, first);
  assert.deepEqual(all, first);
  const news: Hands = { done: [entry(2, true), entry(3)], set: [share('b', 3), close('8', true)] };
  assert.deepEqual(withNews(all, news), {
    done: [entry(1), entry(2, true), entry(3)],
    set: [share('a', 1), share('b', 3), close('7', true), close('8', true)],
  });
});

test('numbers of the same style are told apart', () => {
  const set = (parameter: string, value: number): Hand => ({ set_parameter: { style: 'a', parameter, value } });
  const known: Hands = { done: [], set: [set('x', 1), set('y', 2), share('a', 3)] };
  assert.deepEqual(withNews(known, { done: [], set: [set('y', 4)] }).set, [set('x', 1), set('y', 4), share('a', 3)]);
});
