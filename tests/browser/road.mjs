// What is clicked, dragged and driven on the road: lights, lanes, vehicles; by mouse and by finger; seen by every page.

import assert from 'node:assert/strict';
import path from 'node:path';
import { hook, page, play, shoot, state, until, view } from './browser.mjs';

/** A place of this kind that is well inside the free part of the window. */
async function place(opened, kind, isFine = () => true) {
  const all = await opened.evaluate((of) => window.laneweave.places(of), kind);
  const inside = all.filter(({ left, top }) => left > 150 && left < 700 && top > 150 && top < 550);
  const found = inside.find(isFine);
  assert.ok(found, `none of ${all.length} ${kind} in the window`);
  return found;
}

const pressed = (opened, name) => opened.waitForSelector(`${hook(name)}[aria-pressed=true]`);
const said = (opened, text) => opened.waitForSelector(`${hook('hands')} li >> text=${text}`, { state: 'attached' });

async function opened_on({ browser, program, folder }, map, work) {
  const server = await view(program, [map], folder);
  const { page: opened, wrong, close } = await page(browser);
  await opened.goto(server.url);
  await until(opened, 'it is ready', (it) => it.ready);
  await opened.keyboard.press('Home');
  await opened.keyboard.press('m');
  await opened.waitForTimeout(2500);
  await work(opened, server);
  assert.deepEqual(wrong, []);
  await close();
  await server.end();
}

/** A light is clicked, and set; its junction gets another offset; another page shows both, and takes the last one back. */
export async function lights_by_hand(around) {
  await opened_on(around, path.join(around.home, 'maps/grid.osm'), async (opened, server) => {
    const light = await place(opened, 'lights');
    await opened.mouse.click(light.left, light.top);
    await opened.waitForSelector(`${hook('panel-light')}:visible`);
    await opened.click(hook('light-red'));
    await pressed(opened, 'light-red');
    await opened.waitForSelector(`${hook('light-shows')} >> text=shows red`);
    const offset = opened.locator(`${hook('panel-light')} input[type=number]`);
    await offset.fill('20');
    await offset.press('Enter');
    await opened.mouse.move(light.left, light.top);
    await shoot(opened, around.shots, 'light');
    await opened.click(hook('hands'));
    await said(opened, /offset of light .* to 20 s/);
    const other = await page(around.browser);
    await other.page.goto(server.url);
    await until(other.page, 'it is ready', (it) => it.ready);
    await other.page.click(hook('hands'));
    await said(other.page, /offset of light .* to 20 s/);
    await other.page.click(hook('undo'));
    await opened.waitForFunction((selector) => document.querySelector(selector).value === '0', `${hook('panel-light')} input[type=number]`);
    await other.close();
  });
}

/** A lane is clicked, closed, and opened again. */
export async function lanes_by_hand(around) {
  await opened_on(around, path.join(around.home, 'maps/motorway_3_lanes.osm'), async (opened) => {
    const { left, top } = await place(opened, 'lanelets');
    await opened.mouse.click(left, top);
    await opened.waitForSelector(`${hook('panel-lane')}:visible`);
    await opened.click(hook('block-lane'));
    await opened.waitForSelector(`${hook('open-lane')}:visible`);
    await opened.mouse.move(left, top);
    for (let turn = 0; turn < 5; turn += 1) await opened.mouse.wheel(0, -500);
    await opened.waitForTimeout(2500);
    await shoot(opened, around.shots, 'closed_lane');
    await opened.click(hook('open-lane'));
    await opened.waitForSelector(`${hook('block-lane')}:visible`);
  });
}

/** A car is dragged onto the road, driven with the keys, given back, and removed. */
export async function a_car_dragged_and_driven(around) {
  await opened_on(around, path.join(around.home, 'maps/ramps.osm'), async (opened) => {
    await play(opened);
    await opened.click(hook('hands'));
    const { left, top } = await place(opened, 'lanelets');
    const button = await opened.locator(hook('put-truck')).boundingBox();
    await opened.mouse.move(button.x + 8, button.y + 8);
    await opened.mouse.down();
    await opened.mouse.move(left, top, { steps: 8 });
    await shoot(opened, around.shots, 'dragged');
    await opened.mouse.up();
    await until(opened, 'the truck is selected', (it) => it.selected.length === 1);
    await opened.locator(hook('picture')).focus();
    await opened.keyboard.press('ArrowDown');
    await opened.waitForSelector(`${hook('held-speed')} >> text=/holds \\d+ km/`);
    await opened.keyboard.press('ArrowLeft');
    await said(opened, /km\/h, to the left/);
    await shoot(opened, around.shots, 'driven');
    await opened.click(hook('drive'));
    await said(opened, /back to its driver/);
    await opened.click(hook('remove'));
    await said(opened, /taken off the road/);
  });
}

/** The share of a style, by a slider that is moved: it acts while it moves, and is taken back as one. */
export async function a_share_by_slider(around) {
  await opened_on(around, path.join(around.home, 'maps/ramps.osm'), async (opened) => {
    await opened.click(hook('hands'));
    const slider = opened.locator('input[type=range][data-share="aggressive"]');
    await slider.scrollIntoViewIfNeeded();
    const { x, y, width, height } = await slider.boundingBox();
    await opened.mouse.move(x + width * 0.2, y + height / 2);
    await opened.mouse.down();
    for (let part = 0.2; part <= 0.8; part += 0.1) {
      await opened.mouse.move(x + width * part, y + height / 2);
      await opened.waitForTimeout(150);
    }
    await said(opened, /share of aggressive/);
    await opened.mouse.up();
    await opened.waitForTimeout(500);
    const entries = await opened.locator(`${hook('hands')} li`).allTextContents();
    assert.equal(entries.filter((it) => it.includes('share of aggressive')).length, 1, entries.join());
    const before = await opened.locator('input[type=number][aria-label^="aggressive"]').inputValue();
    await opened.click(hook('undo'));
    await opened.waitForSelector(`${hook('hands')} li s`, { state: 'attached' });
    assert.notEqual(await opened.locator('input[type=number][aria-label^="aggressive"]').inputValue(), before);
  });
}

/** Traffic that stands, so near that single vehicles can be told apart. One of them is clicked: it is returned. */
async function clicked(opened) {
  await opened.selectOption(hook('factor'), { index: (await opened.locator(`${hook('factor')} option`).count()) - 1 });
  await play(opened);
  await until(opened, 'there are vehicles', (it) => it.vehicles >= 60);
  await opened.click(hook('pause'));
  const some = await place(opened, 'vehicles');
  await opened.mouse.move(some.left, some.top);
  for (let turn = 0; turn < 4; turn += 1) await opened.mouse.wheel(0, -500);
  await opened.waitForTimeout(3000);
  const one = await place(opened, 'vehicles');
  await opened.mouse.click(one.left, one.top);
  await until(opened, 'one is selected', (it) => it.selected[0] === one.id);
  await opened.waitForTimeout(1500);
  return one;
}

/** A driver gets another style, and is sent to another lane. */
export async function another_style(around) {
  await opened_on(around, path.join(around.home, 'maps/ramps.osm'), async (opened) => {
    const { id } = await clicked(opened);
    const shows = opened.locator(`${hook('panel-driver')} dl dd`).first();
    const style = (await shows.textContent()) === 'conservative' ? 'aggressive' : 'conservative';
    await opened.click(hook('hands'));
    await opened.selectOption(hook('set-style'), style);
    await said(opened, new RegExp(`${id}.*${style}`));
    await opened.click(hook('step'));
    await shows.filter({ hasText: style }).waitFor();
    await opened.click(hook('drive'));
    await opened.click(hook('faster'));
    await opened.waitForSelector(`${hook('held-speed')} >> text=/holds \\d+ km/`);
    await opened.click(hook('to-right'));
    await said(opened, /km\/h, to the right/);
  });
}

/** Two vehicles are clicked, the second one with the shift key: the gap between them, and the time to collision. */
export async function two_vehicles(around) {
  await opened_on(around, path.join(around.home, 'maps/ramps.osm'), async (opened) => {
    const first = await clicked(opened);
    const second = await place(opened, 'vehicles', ({ id }) => id !== first.id);
    await opened.keyboard.down('Shift');
    await opened.mouse.click(second.left, second.top);
    await opened.keyboard.up('Shift');
    await until(opened, 'two are selected', (it) => it.selected.join() === [first.id, second.id].join());
    await opened.waitForSelector(`${hook('pair')} >> text=/time to collision/`);
    assert.match(await opened.textContent(hook('pair')), /gap[\d.,\s]+ m/);
    await shoot(opened, around.shots, 'two_vehicles');
  });
}

/** By keyboard alone: a vehicle in the middle is selected, and then a second one. While time stands, all can be seen. */
export async function by_keyboard(around) {
  await opened_on(around, path.join(around.home, 'maps/ramps.osm'), async (opened) => {
    const { id } = await clicked(opened);
    await opened.keyboard.press('Home');
    await until(opened, 'all are seen', (it) => it.vehicles >= 60);
    await opened.keyboard.press('/');
    await opened.keyboard.type(id);
    await opened.keyboard.press('Enter');
    await until(opened, 'it is followed', (it) => it.selected[0] === id && it.camera.mode === 'follow');
    await opened.locator(hook('picture')).focus();
    await opened.waitForTimeout(2500);
    await opened.keyboard.press('Escape');
    await until(opened, 'nobody is selected', (it) => it.selected.length === 0);
    await opened.keyboard.press('Enter');
    await until(opened, 'it is selected', (it) => it.selected[0] === id);
    for (let turn = 0; turn < 60 && (await state(opened)).selected.length < 2; turn += 1) {
      await opened.keyboard.press('ArrowRight');
      await opened.waitForTimeout(400);
      await opened.keyboard.press('Shift+Enter');
    }
    await until(opened, 'a second one is selected', (it) => it.selected.length === 2 && it.selected[0] === id);
    await opened.waitForSelector(`${hook('pair')} >> text=/gap/`);
  });
}

/** Fingers: one selects, one drags the road, two zoom. */
export async function fingers({ browser, program, folder, home, shots }) {
  const server = await view(program, [path.join(home, 'maps/town.osm')], folder);
  const context = await browser.newContext({ viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true, deviceScaleFactor: 2 });
  const opened = await context.newPage();
  await opened.goto(server.url);
  const before = await until(opened, 'it is ready', (it) => it.ready);
  const session = await context.newCDPSession(opened);
  const touch = (type, ...points) => session.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
  await touch('touchStart', [200, 300]);
  for (let n = 1; n <= 6; n += 1) await touch('touchMove', [200 - 12 * n, 300]);
  await touch('touchEnd');
  const moved = await until(opened, 'the road is dragged', (it) => Math.hypot(it.camera.x - before.camera.x, it.camera.y - before.camera.y) > 1);
  await touch('touchStart', [180, 300], [220, 300]);
  for (let n = 1; n <= 6; n += 1) await touch('touchMove', [180 - 12 * n, 300], [220 + 12 * n, 300]);
  await touch('touchEnd');
  await until(opened, 'it is nearer', (it) => it.camera.distance < 0.8 * moved.camera.distance);
  await opened.waitForTimeout(1500);
  const all = await opened.evaluate(() => window.laneweave.places('lanelets'));
  const lane = all.find(({ left, top }) => left > 40 && left < 350 && top > 120 && top < 500);
  assert.ok(lane, 'no lanelet in the window');
  await opened.touchscreen.tap(lane.left, lane.top);
  await opened.waitForSelector(`${hook('panel-lane')}:visible, ${hook('panel-driver')}:visible, ${hook('panel-light')}:visible`);
  await shoot(opened, shots, 'fingers');
  await context.close();
  await server.end();
}
