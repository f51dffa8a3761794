import * as assert from 'node:assert/strict';
import { test } from 'node:test';
import { Hands } from '../src/hands.ts';
import type { HandEntry, PageMessage } from '../src/protocol/messages.ts';
import { State } from '../src/state.ts';

const entry = (number: number, text: string, is_undone = false, vehicle: string | null = null): HandEntry => ({ number, time_s: 0, text, vehicle, is_undone });

function begin(): { state: State; hands: Hands; said: PageMessage[]; set: (value: number, reverted: string) => void; reverted: string[] } {
  const said: PageMessage[] = [];
  const reverted: string[] = [];
  const state = new State(true, (message) => said.push(message));
  const hands = new Hands(state);
  const set = (value: number, name: string) => {
    hands.do({ set_parameter: { style: 'calm', parameter: 'change.theta', value } }, { revert: () => reverted.push(name) });
  };
  return { state, hands, said, set, reverted };
}

test('what is taken back is shown as it was before', () => {
  const { state, hands, said, set, reverted } = begin();
  set(1, 'first');
  state.hands.set([entry(1, 'change.theta of calm to 1')]);
  hands.undo();
  state.hands.set([entry(1, 'change.theta of calm to 1', true)]);
  state.hands.set([entry(1, 'change.theta of calm to 1', true)]);
  assert.deepEqual(reverted, ['first']);
  assert.deepEqual(said.at(-1), { undo: true });
});

test('deeds that the server joins to one entry do not disturb later ones', () => {
  const { state, set, reverted } = begin();
  set(1, 'first');
  state.hands.set([entry(1, 'change.theta of calm to 1')]);
  set(2, 'joined');
  state.hands.set([entry(1, 'change.theta of calm to 2')]);
  set(3, 'third');
  state.hands.set([entry(1, 'change.theta of calm to 2'), entry(2, 'change.theta of calm to 3')]);
  state.hands.set([entry(1, 'change.theta of calm to 2'), entry(2, 'change.theta of calm to 3', true)]);
  assert.deepEqual(reverted, ['third']);
});

test('what is refused is shown as it was before', () => {
  const { state, set, reverted } = begin();
  set(1e9, 'refused');
  state.refused.tell({ what: 'too large', remedy: 'choose less' });
  assert.deepEqual(reverted, ['refused']);
});

test('a vehicle that was put on the road is told once', () => {
  const { state, hands } = begin();
  const told: string[] = [];
  hands.do({ put: { x: 0, y: 0, class: 'car' } }, { hasPut: (vehicle) => told.push(vehicle) });
  state.hands.set([entry(1, 'a car on lanelet 7', false, '1000')]);
  state.hands.set([entry(1, 'a car on lanelet 7', false, '1000')]);
  assert.deepEqual(told, ['1000']);
});
