// What is done by hand: sliders, lights, lanes, vehicles; taken back, and saved so that a run repeats it.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import path from 'node:path';
import { hook, page, play, shoot, stands, state, until, view } from './browser.mjs';

/** The number beside the slider of a style's weight of speed. */
const field = (style) => `[data-style="${style}"][data-key="change.speed.weight"] ~ input[type=number]`;

/** Time over which a slider is judged. */
const MEASURED_S = 300;

const done = (opened) => opened.locator(`${hook('hands')} li`).allTextContents();

async function untilDone(opened, part) {
  await opened.waitForFunction(
    ([selector, text]) => [...document.querySelectorAll(selector)].some((it) => it.textContent.includes(text)),
    [`${hook('hands')} li`, part],
  );
}

/** Sliders, a vehicle of one's own, and a scenario that repeats it. */
export async function by_hand_and_saved({ browser, program, home, folder, shots }) {
  const server = await view(program, [path.join(home, 'maps/town.osm'), '--save', 'mine'], folder);
  const { page: opened, wrong, close } = await page(browser);
  await opened.goto(server.url);
  await until(opened, 'it is ready', (it) => it.ready);
  await opened.keyboard.press('Home');
  await opened.selectOption(hook('factor'), { index: (await opened.locator(`${hook('factor')} option`).count()) - 1 });
  await play(opened);
  await until(opened, 'there are vehicles', (it) => it.vehicles >= 20);
  await opened.selectOption(hook('factor'), '1');
  await opened.click(hook('hands'));
  // The number field beside a slider, and the slider by keyboard.
  await opened.fill(field('aggressive'), '0');
  await opened.keyboard.press('Enter');
  await untilDone(opened, 'change.speed.weight of aggressive');
  // A car is put on the road and driven.
  await opened.click(hook('pause'));
  await opened.locator(hook('put-car')).focus();
  for (let turn = 0; turn < 6; turn += 1) await opened.keyboard.press('+');
  await shoot(opened, shots, 'by_hand');
  await opened.click(hook('undo'));
  await opened.waitForSelector(`${hook('hands')} li s`);
  await play(opened);
  await opened.waitForTimeout(1500);
  await opened.click(hook('pause'));
  await stands(opened);
  await opened.click(hook('save'));
  await opened.waitForSelector(`${hook('saved')} code`);
  const saved = await opened.textContent(`${hook('saved')} code`);
  const [time, all] = [(await state(opened)).time_s, await done(opened)];
  assert.ok(all.length >= 1 && time > 1);
  assert.deepEqual(wrong, []);
  await close();
  await server.end();
  const summary = JSON.parse(execFileSync(program, ['run', saved, '--json', '--out', 'again'], { cwd: folder, stdio: ['ignore', 'pipe', 'ignore'] }));
  assert.ok(Math.abs(summary.duration_s - time) < 1.5, `${summary.duration_s} s instead of ${time} s`);
}

/** A slider end to end: drivers to whom speed means much more change lanes more often than those to whom it means nothing. */
export async function a_slider_moves_the_rate({ browser, program, home, folder }) {
  const events = [];
  for (const weight of ['0', '10']) {
    const server = await view(program, [path.join(home, 'maps/ramps.osm')], folder);
    const { page: opened, close } = await page(browser);
    let changes = 0;
    opened.on('websocket', (socket) => socket.on('framereceived', ({ payload }) => {
      if (typeof payload !== 'string' || !payload.startsWith('{"events"')) return;
      changes += JSON.parse(payload).events.filter(({ kind, time_s }) => kind === 'lane_change' && time_s <= MEASURED_S).length;
    }));
    await opened.goto(server.url);
    await until(opened, 'it is ready', (it) => it.ready);
    await opened.click(hook('hands'));
    for (const style of ['aggressive', 'conservative']) {
      await opened.selectOption(hook('style'), style);
      await opened.fill(field(style), weight);
      await opened.keyboard.press('Enter');
      await untilDone(opened, `change.speed.weight of ${style}`);
    }
    // Pages are told what happened in the last minute: a slow one would miss some if time went as fast as it goes.
    await opened.selectOption(hook('factor'), '50');
    await play(opened);
    await until(opened, 'the time is over', (it) => it.time_s > MEASURED_S);
    events.push(changes);
    await close();
    await server.end();
  }
  assert.ok(events[1] > 1.15 * events[0], `${events}`);
  return `${events[0]} lane changes with the weight 0, ${events[1]} with 10`;
}
