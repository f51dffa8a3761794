// Runs that have ended, recordings, and replays in one file.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { statSync } from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import { hook, page, play, shoot, until, view } from './browser.mjs';

const run = (program, folder, ...args) => execFileSync(program, args, { cwd: folder, stdio: 'ignore' });

/** Clicks the time line at this share of its length. */
async function click(opened, share) {
  const { x, y, width } = await opened.locator(hook('timeline')).boundingBox();
  await opened.mouse.click(x + width * share, y + 18);
}

async function scrubbed(browser, server, look) {
  const { page: opened, wrong, close } = await page(browser);
  await opened.goto(server.url);
  await until(opened, 'it is ready', (it) => it.ready);
  await opened.keyboard.press('Home');
  await look(opened);
  assert.deepEqual(wrong, []);
  await close();
  await server.end();
}

/** A jammed motorway, scrubbed along its time line. Drivers as printed miss turns, which are marks of importance. */
export async function a_run_that_has_ended({ browser, program, home, folder, shots }) {
  const drivers = ['--style', 'paper-aggressive=1', '--style', 'paper-conservative=7.4'];
  run(program, folder, 'run', path.join(home, 'maps/ramps.osm'), '--demand', '7000', '--duration', '300', ...drivers, '--out', 'jam', '--quiet');
  await scrubbed(browser, await view(program, ['jam'], folder), async (opened) => {
    // Time stands: what is waited for does not pass by.
    await opened.click(hook('pause'));
    await click(opened, 0.8);
    await until(opened, 'four minutes are reached', (it) => Math.abs(it.time_s - 240) < 8 && it.vehicles > 50);
    await shoot(opened, shots, 'jam');
    await click(opened, 0.2);
    const early = await until(opened, 'one minute is reached', (it) => Math.abs(it.time_s - 60) < 8);
    // The next important mark, and from later on the one before.
    await opened.keyboard.press(';');
    const next = await until(opened, 'the next mark is reached', (it) => it.time_s > early.time_s);
    await click(opened, 0.9);
    const late = await until(opened, 'a later time is reached', (it) => it.time_s > 260);
    await opened.keyboard.press(',');
    await until(opened, 'the mark before is reached', (it) => it.time_s >= next.time_s && it.time_s < late.time_s);
    // The list of important ones: a click goes there, and chooses the vehicle.
    await opened.click(hook('marks'));
    const last = opened.locator(`${hook('panel-marks')} button`).last();
    const text = await last.evaluate((it) => {
      it.click();
      return it.textContent;
    });
    const [, minutes, seconds, vehicle] = text.match(/(\d+):(\d+)\.\d\D+(\d+)/);
    const there = 60 * Number(minutes) + Number(seconds);
    await until(opened, 'it is there', (it) => Math.abs(it.time_s - there) < 2 && it.selected[0] === vehicle);
    await shoot(opened, shots, 'marks');
    // Before it came there was nothing to say of it.
    await click(opened, 0.02);
    await opened.waitForSelector(`${hook('act')} >> text=is not on the road now`);
    assert.equal(await opened.locator(`${hook('panel-driver')} dl.facts:visible dd`).count(), 0);
    // Who plays a run at its end sees it from its beginning.
    await click(opened, 0.999);
    await until(opened, 'it is near its end', (it) => it.time_s > 290);
    for (let step = 0; step < 40; step += 1) await opened.keyboard.press('.');
    await until(opened, 'it has ended', (it) => Math.abs(it.time_s - 300) < 0.05);
    await opened.click(hook('play'));
    await until(opened, 'it has begun again', (it) => it.time_s > 0 && it.time_s < 60);
  });
}

/** A recording. */
export async function a_recording({ browser, program, folder, data, shots }) {
  if (!data) return 'skipped: no data';
  const place = path.join(data, 'recordings/mona_east');
  const args = [path.join(place, 'vehicle_tracks_000.csv'), '--map', path.join(place, 'map.osm')];
  await scrubbed(browser, await view(program, args, folder), async (opened) => {
    await play(opened);
    await until(opened, 'vehicles are seen', (it) => it.vehicles > 5);
    await opened.waitForTimeout(2000);
    await shoot(opened, shots, 'mona_east');
  });
  return undefined;
}

/** The demo as one file, without a server and without a network. */
export async function one_file({ browser, program, home, folder, shots }) {
  run(program, folder, 'run', path.join(home, 'scenarios/demo.toml'), '--out', 'demo', '--quiet');
  run(program, folder, 'view', 'demo', '--export', 'replay.html');
  const file = path.join(folder, 'replay.html');
  const size = statSync(file).size / 1e6;
  assert.ok(size <= 10, `${size} MB`);
  const { page: opened, wrong, asked, close } = await page(browser, { offline: true });
  const begin = Date.now();
  await opened.goto(pathToFileURL(file).href);
  await until(opened, 'the first frame is there', (it) => it.ready);
  const first_s = (Date.now() - begin) / 1000;
  await opened.keyboard.press('Home');
  await play(opened);
  await until(opened, 'it plays', (it) => it.time_s > 0.5);
  await click(opened, 0.5);
  await until(opened, 'its middle is reached', (it) => it.vehicles > 50);
  await shoot(opened, shots, 'replay');
  assert.deepEqual([...asked].filter((it) => !/^(file|data|blob):/.test(it)), []);
  assert.deepEqual(wrong, []);
  await close();
  return `${size.toFixed(1)} MB, first frame after ${first_s.toFixed(1)} s`;
}
