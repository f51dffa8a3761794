// Pages come, go and reload, and lose their server.

import assert from 'node:assert/strict';
import path from 'node:path';
import { hook, page, play, shoot, state, until, view } from './browser.mjs';

/** A page that is loaded again shows the same traffic, and what was done by hand; time goes on meanwhile. */
export async function a_page_that_reloads({ browser, program, home, folder, shots }) {
  const server = await view(program, [path.join(home, 'maps/ramps.osm')], folder);
  const { page: opened, wrong, close } = await page(browser);
  await opened.goto(server.url);
  await until(opened, 'it is ready', (it) => it.ready);
  await play(opened);
  await opened.click(hook('hands'));
  const share = opened.locator('input[type=number][aria-label^="aggressive"]');
  await share.fill('7');
  await share.press('Enter');
  await opened.waitForSelector(`${hook('hands')} li >> text=/share of aggressive/`);
  const { time_s } = await state(opened);
  await opened.reload();
  await until(opened, 'it is ready again', (it) => it.ready && it.time_s >= time_s);
  await opened.click(hook('hands'));
  await opened.waitForSelector(`${hook('hands')} li >> text=/share of aggressive/`);
  assert.equal(await share.inputValue(), '7');
  await until(opened, 'time goes on', (it) => it.time_s > time_s + 1);
  assert.deepEqual(wrong, []);
  // Without a server it says so, and what is there can still be looked at.
  await server.end();
  await opened.waitForSelector(`${hook('connection')} >> text=/connection to laneweave is lost/`);
  await opened.keyboard.press('Home');
  await shoot(opened, shots, 'connection_lost');
  // Another server is at its address now.
  const another = await view(program, [path.join(home, 'maps/town.osm'), '--port', new URL(server.url).port], folder);
  await opened.waitForSelector(`${hook('connection')} >> text=Open the address that laneweave view prints`);
  await close();
  await another.end();
}
