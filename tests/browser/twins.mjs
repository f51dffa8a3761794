// Twins: of traffic that is changed by hand, and of a run that has ended; as ghosts, and side by side.

import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import path from 'node:path';
import { hook, page, play, shoot, state, until, view } from './browser.mjs';

const NARROW = { width: 390, height: 844 };
/** The number beside the slider of a style's weight of speed. */
const field = (style) => `[data-style="${style}"][data-key="change.speed.weight"] ~ input[type=number]`;

async function opened(browser, server, size, look) {
  const { page: shown, wrong, close } = await page(browser, size);
  await shown.goto(server.url);
  await until(shown, 'it is ready', (it) => it.ready);
  await look(shown);
  assert.deepEqual(wrong, []);
  await close();
}

/** The labels of the halves, and that neither lies on the other or beyond the window. */
async function labels(shown) {
  const boxes = [];
  const texts = [];
  for (const name of ['half-traffic', 'half-twin']) {
    boxes.push(await shown.locator(hook(name)).boundingBox());
    texts.push(await shown.textContent(hook(name)));
  }
  const { width, height } = shown.viewportSize();
  for (const box of boxes) assert.ok(box.x >= 0 && box.y >= 0 && box.x + box.width <= width && box.y + box.height <= height, JSON.stringify(box));
  const [a, b] = boxes;
  assert.ok(a.x + a.width <= b.x || a.y + a.height <= b.y, JSON.stringify(boxes));
  return texts;
}

/** Clicks a vehicle of the right half: its id. */
async function clickInTwin(shown) {
  const { width, height } = shown.viewportSize();
  const all = await shown.evaluate(() => window.laneweave.places('vehicles'));
  const place = all.find(({ id, left, top }) => id.startsWith('-') && left > width * 0.55 && left < width * 0.95 && top > height * 0.2 && top < height * 0.8);
  assert.ok(place, `none of ${all.length} vehicles in the right half`);
  await shown.mouse.click(place.left, place.top);
  const { selected } = await until(shown, 'one is selected', (it) => it.selected.length > 0);
  return selected[0];
}

/** The weight of speed is changed by hand, and the twins of the drivers keep theirs. */
export async function a_twin_of_what_is_done_by_hand({ browser, program, home, folder, shots }) {
  const server = await view(program, [path.join(home, 'maps/ramps.osm')], folder);
  const fastest = (shown) => shown.locator(`${hook('factor')} option`).count().then((it) => shown.selectOption(hook('factor'), { index: it - 1 }));
  await opened(browser, server, {}, async (shown) => {
    await fastest(shown);
    await play(shown);
    await until(shown, 'there is traffic', (it) => it.time_s > 120);
    await shown.click(hook('pause'));
    assert.equal((await state(shown)).twin.vehicles, 0);
    // The key, and not only the list.
    await shown.keyboard.press('g');
    const begun = await until(shown, 'there are ghosts', (it) => it.twin.view === 'ghosts' && it.twin.vehicles > 0);
    assert.deepEqual([begun.colour, begun.twin.vehicles], ['difference', begun.vehicles]);
    await until(shown, 'nobody differs', (it) => it.twin.differ === 0);
    await shown.click(hook('hands'));
    for (const style of ['aggressive', 'conservative']) {
      await shown.selectOption(hook('style'), style);
      await shown.fill(field(style), '10');
      await shown.keyboard.press('Enter');
    }
    await play(shown);
    await until(shown, 'many differ', (it) => it.time_s > 200 && it.twin.differ > 20);
    await shown.click(hook('pause'));
    await shown.click(hook('hands'));
    await shoot(shown, shots, 'twin_ghosts');
    await shown.selectOption(hook('twin'), 'side');
    await until(shown, 'they are side by side', (it) => it.twin.view === 'side');
    await shown.waitForTimeout(1500);
    const [traffic, twin] = await labels(shown);
    assert.ok(traffic.includes('by hand') && twin.includes('unchanged'), `${traffic} | ${twin}`);
    await shoot(shown, shots, 'twin_side');
    const { drawCalls } = await state(shown);
    assert.ok(drawCalls <= 30, `${drawCalls} draw calls`);
    // A user chooses another colour; it stays.
    await shown.selectOption(hook('colour'), 'style');
    await shown.selectOption(hook('trails'), 'all');
    await shown.keyboard.press('Home');
    await play(shown);
    await shown.waitForTimeout(3000);
    await shoot(shown, shots, 'twin_side_trails');
    await shown.keyboard.press('g');
    const ended = await until(shown, 'there is no twin', (it) => it.twin.view === 'none' && it.twin.vehicles === 0);
    assert.equal(ended.colour, 'style');
  });
  await server.end();
}

/** A run that has ended, and its twin with another setting, along the time line. */
export async function a_run_and_its_twin({ browser, program, home, folder, shots }) {
  const run = (...args) => execFileSync(program, args, { cwd: folder, stdio: 'ignore' });
  run('run', path.join(home, 'maps/ramps.osm'), '--demand', '5000', '--duration', '240', '--out', 'base', '--quiet');
  const change = ['--at', '60', '--set', 'style.speed.weight=10'];
  for (const [args, part] of [[['view', 'base', '--set', 'style.speed.weight=2'], '--at'], [['view', path.join(home, 'maps/ramps.osm'), ...change], 'ended'], [['view', 'base', '--export', 'twin.html', ...change], '--export']]) {
    const { status, stderr } = spawnSync(program, args, { cwd: folder, encoding: 'utf8', timeout: 600_000 });
    assert.ok(status === 2 && stderr.includes(part), `${args}: ${status} ${stderr}`);
  }
  const server = await view(program, ['base', ...change], folder);
  const scrub = async (shown, share, time_s) => {
    const { x, y, width } = await shown.locator(hook('timeline')).boundingBox();
    await shown.mouse.click(x + width * share, y + 18);
    return until(shown, `${time_s} s are reached`, (it) => Math.abs(it.time_s - time_s) < 6);
  };
  await opened(browser, server, {}, async (shown) => {
    await until(shown, 'its twin is beside it', (it) => it.twin.view === 'side' && it.colour === 'difference');
    const texts = await labels(shown);
    assert.ok(texts[1].includes('style.speed.weight=10') && texts[1].includes('01:00'), texts.join(' | '));
    await shown.click(hook('pause'));
    await shown.keyboard.press('Home');
    await scrub(shown, 0.2, 48);
    await until(shown, 'both are the same', (it) => it.vehicles > 10 && it.twin.vehicles === it.vehicles && it.twin.differ === 0);
    await scrub(shown, 0.9, 216);
    await until(shown, 'they differ', (it) => it.twin.differ > 20);
    await shoot(shown, shots, 'twin_run');
    await scrub(shown, 0.22, 53);
    await until(shown, 'both are the same again', (it) => it.vehicles > 10 && it.twin.differ === 0);
    await scrub(shown, 0.6, 144);
    await shown.keyboard.press('m');
    for (let turn = 0; turn < 12; turn += 1) await shown.keyboard.press('+');
    await shown.waitForTimeout(2000);
    const id = await clickInTwin(shown);
    await shown.waitForSelector(`${hook('panel-driver')}:visible`);
    assert.ok((await shown.textContent(hook('panel-driver'))).includes(id) && !id.startsWith('-'), id);
    await shown.waitForTimeout(1500);
    await labels(shown);
    await shoot(shown, shots, 'twin_run_driver');
    await shown.keyboard.press('g');
    await shown.keyboard.press('g');
    await until(shown, 'there are ghosts', (it) => it.twin.view === 'ghosts' && it.twin.vehicles > 0);
    await shown.waitForTimeout(1500);
    await shoot(shown, shots, 'twin_run_ghosts');
  });
  await opened(browser, server, NARROW, async (shown) => {
    await until(shown, 'its twin is there', (it) => it.twin.view !== 'none' && it.twin.vehicles > 0);
    await shown.keyboard.press('Home');
    await shown.waitForTimeout(2000);
    await labels(shown);
    await shoot(shown, shots, 'twin_narrow');
  });
  await server.end();
}
