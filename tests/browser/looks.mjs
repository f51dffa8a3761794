// The road, the vehicles, the drivers, colours and cameras.

import assert from 'node:assert/strict';
import path from 'node:path';
import { hook, page, play, shoot, stands, state, until, view } from './browser.mjs';

/** Opens a page on what `laneweave view` serves with these arguments, and checks at the end that nothing went wrong. */
async function shown({ browser, program, folder }, args, size, look) {
  const server = await view(program, args, folder);
  const { page: opened, wrong, asked, close } = await page(browser, size);
  const ids = arrivals(opened);
  try {
    await opened.goto(server.url);
    await until(opened, 'it is ready', (it) => it.ready);
    await look(opened, ids);
    const own = new URL(server.url).origin.replace('http', '');
    assert.deepEqual([...asked].filter((it) => !it.includes(own) && !/^(data|blob):/.test(it)), [], 'other servers');
    assert.deepEqual(wrong, [], 'errors of the page');
  } finally {
    await close();
    await server.end();
  }
}

/** Lets the simulation go on as fast as it goes until so many vehicles are on the whole map, and then as fast as reality. */
async function fill(opened, vehicles) {
  await opened.keyboard.press('Home');
  await opened.selectOption(hook('factor'), { index: (await opened.locator(`${hook('factor')} option`).count()) - 1 });
  await play(opened);
  await until(opened, `there are ${vehicles} vehicles`, (it) => it.vehicles >= vehicles);
  await opened.selectOption(hook('factor'), '1');
}

/** The ids of the vehicles that came into view, the last one last, as the frames of the page name them. */
function arrivals(opened) {
  const ids = [];
  opened.on('websocket', (socket) => socket.on('framereceived', ({ payload }) => {
    if (typeof payload === 'string') return;
    const [slots, entered] = [payload.readUInt32LE(40), payload.readUInt32LE(44)];
    for (let n = 0; n < entered; n += 1) ids.push(String(payload.readBigInt64LE(48 + 16 * (slots + n) + 4)));
  }));
  return ids;
}

/** Finds a vehicle that came lately and has a lane beside it, and returns its id. */
async function anybody(opened, ids) {
  for (const id of ids.toReversed()) {
    await opened.fill(hook('find'), id);
    await opened.press(hook('find'), 'Enter');
    await opened.waitForTimeout(1000);
    const { selected } = await state(opened);
    const bars = await opened.locator('[data-name][data-side]').count();
    if (selected[0] === id && bars > 0) return id;
  }
  throw new Error('no vehicle was found');
}

/** The demo: a driver with its bars, found, followed and seen through. */
export async function the_demo_and_a_driver(around) {
  await shown(around, [], {}, async (opened, ids) => {
    await fill(opened, 60);
    await shoot(opened, around.shots, 'demo');
    await opened.keyboard.press('m');
    await shoot(opened, around.shots, 'demo_map');
    await opened.keyboard.press('m');
    const before = await state(opened);
    assert.ok(before.drawCalls <= 30, `${before.drawCalls} draw calls`);
    // Time stands, and goes on by steps.
    await opened.click(hook('pause'));
    const paused = await stands(opened);
    await opened.click(hook('step'));
    await until(opened, 'a step is made', (it) => Math.abs(it.time_s - paused.time_s - 0.1) < 0.02);
    // A driver: its bars and words. It is found by its id, and then clicked.
    const id = await anybody(opened, ids);
    await opened.keyboard.press('Escape');
    await until(opened, 'nobody is selected', (it) => it.selected.length === 0);
    await opened.waitForTimeout(1500);
    const { width, height } = await opened.locator(hook('picture')).boundingBox();
    await opened.mouse.click(width / 2, height / 2);
    await until(opened, 'the vehicle in the middle is selected', (it) => it.selected[0] === id);
    await opened.waitForSelector(`${hook('panel-driver')}:visible`);
    assert.ok((await opened.textContent(hook('panel-driver'))).includes(id));
    assert.ok((await opened.textContent(hook('act'))).length > 5);
    assert.ok((await opened.locator('[data-name][data-side]').count()) >= 1, 'bars');
    await shoot(opened, around.shots, 'driver');
    // It is found by its id, by keyboard alone. Time stands, so that it does not leave while a slow machine looks for it.
    await opened.keyboard.press('Escape');
    await until(opened, 'nobody is selected again', (it) => it.selected.length === 0);
    await opened.keyboard.press('/');
    await opened.keyboard.type(id);
    await opened.keyboard.press('Enter');
    await until(opened, 'it is found and followed', (it) => it.selected[0] === id && it.camera.mode === 'follow');
    await opened.click(hook('follow'));
    await until(opened, 'it is no longer followed', (it) => it.camera.mode === 'free');
    await opened.click(hook('follow'));
    await until(opened, 'it is followed again', (it) => it.camera.mode === 'follow');
    await opened.click(hook('eye'));
    await until(opened, 'it looks through the eyes of the driver', (it) => it.camera.mode === 'eye');
    await play(opened);
    await shoot(opened, around.shots, 'eye');
    await opened.fill(hook('find'), '99999999');
    await opened.keyboard.press('Enter');
    await opened.waitForSelector(`${hook('toasts')} >> text=99999999`);
  });
}

/** All colours, heat maps, trails, marks and arrows, by day and by night. */
export async function colours_and_nights(around) {
  await shown(around, [path.join(around.home, 'maps/ramps.osm')], { dark: true }, async (opened) => {
    await fill(opened, 80);
    for (const colour of ['speed', 'state', 'desire', 'delay', 'since_change', 'style']) {
      await opened.selectOption(hook('colour'), colour);
      await opened.waitForTimeout(500);
      const legend = await opened.textContent(hook('legend'));
      assert.ok(legend.length > 5, `a legend of ${colour}`);
    }
    for (const heat of ['speed', 'density', 'changes']) {
      await opened.selectOption(hook('heat'), heat);
      await opened.waitForTimeout(1500);
      await shoot(opened, around.shots, `heat_${heat}`);
    }
    await opened.selectOption(hook('trails'), 'all');
    await opened.click(hook('changes'));
    await opened.click(hook('arrows'));
    await opened.click(hook('night'));
    await opened.waitForTimeout(2000);
    await shoot(opened, around.shots, 'trails');
    assert.ok((await state(opened)).drawCalls <= 30);
    await opened.keyboard.press('?');
    await opened.waitForSelector(`${hook('panel-help')}[open]`);
    await shoot(opened, around.shots, 'help');
  });
}

/** Narrow, usual and very large windows. */
export async function windows_of_all_sizes(around) {
  for (const [width, height] of [[390, 844], [1280, 720], [2560, 1440], [3840, 2160]]) {
    await shown(around, [path.join(around.home, 'maps/town.osm')], { width, height }, async (opened) => {
      await fill(opened, 30);
      await shoot(opened, around.shots, `town_${width}`);
      const sizes = await opened.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
      assert.ok(sizes[0] <= sizes[1], `${sizes[0]} px in a window of ${sizes[1]}`);
    });
  }
}

/** Maps of others. */
export async function real_maps(around) {
  if (!around.data) return 'skipped: no data';
  for (const name of ['karlsruhe', 'town10', 'tianjin', 'four_track_highway']) {
    await shown(around, [path.join(around.data, `lanelet2/${name}.osm`)], {}, async (opened) => {
      await fill(opened, 5);
      await shoot(opened, around.shots, name);
      const { drawCalls } = await state(opened);
      assert.ok(drawCalls <= 30, `${drawCalls} draw calls on ${name}`);
    });
  }
  return undefined;
}
