import assert from 'node:assert/strict';
import { test } from 'node:test';
import { takeToken } from '../src/feed/token.ts';

/** A tab with this address. */
function tab(href: string) {
  const location = { href };
  const history = {
    state: null as unknown,
    replaceState(state: unknown, _unused: string, address: string) {
      history.state = state;
      location.href = address;
    },
  };
  return { location, history };
}

test('the token leaves the address, and is known when the page is loaded again', () => {
  const opened = tab('http://127.0.0.1:8080/?token=0123abcd&x=1#here');
  assert.equal(takeToken(opened), '0123abcd');
  assert.equal(opened.location.href, 'http://127.0.0.1:8080/?x=1#here');
  assert.equal(takeToken(opened), '0123abcd');
});

test('another token takes the place of the one that the tab has', () => {
  const opened = tab('http://127.0.0.1:8080/?token=old');
  takeToken(opened);
  opened.location.href = 'http://127.0.0.1:8080/?token=new';
  assert.equal(takeToken(opened), 'new');
  assert.equal(opened.location.href, 'http://127.0.0.1:8080/');
});

test('without a token there is none', () => {
  assert.equal(takeToken(tab('http://127.0.0.1:8080/')), '');
});
