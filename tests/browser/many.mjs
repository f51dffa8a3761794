// Many vehicles in one view.

import assert from 'node:assert/strict';
import { createWriteStream } from 'node:fs';
import { once } from 'node:events';
import path from 'node:path';
import { hook, measure, page, play, shoot, until, view } from './browser.mjs';

const LANES = 25;
const SECONDS = 16;
const FRAMES_A_SECOND = 10;

/** Writes a recording of so many vehicles in rows on a wide plain, in the layout of INTERACTION. */
async function crowd(file, vehicles) {
  const out = createWriteStream(file);
  out.write('track_id,frame_id,timestamp_ms,agent_type,x,y,vx,vy,psi_rad,length,width\n');
  for (let id = 1; id <= vehicles; id += 1) {
    const [lane, place] = [id % LANES, Math.floor(id / LANES)];
    const speed = 8 + (id % 7);
    let rows = '';
    for (let frame = 1; frame <= SECONDS * FRAMES_A_SECOND; frame += 1) {
      const time = frame / FRAMES_A_SECOND;
      rows += `${id},${frame},${time * 1000},car,${(place * 12 + speed * time).toFixed(2)},${(lane * 3.5).toFixed(2)},${speed},0,0,4.5,1.8\n`;
    }
    if (!out.write(rows)) await once(out, 'drain');
  }
  out.end();
  await once(out, 'finish');
}

async function measured({ browser, program, home, folder, shots }, vehicles) {
  const file = path.join(folder, `crowd_${vehicles}.csv`);
  await crowd(file, vehicles);
  const server = await view(program, [file, '--map', path.join(home, 'maps/motorway_2_lanes.osm')], folder);
  const { page: opened, wrong, close } = await page(browser);
  await opened.goto(server.url);
  await until(opened, 'it is ready', (it) => it.ready);
  await opened.keyboard.press('Home');
  await play(opened);
  await until(opened, 'all are in view', (it) => it.vehicles >= 0.98 * vehicles);
  const { drawCalls, scriptMs, fps } = await measure(opened);
  await shoot(opened, shots, `crowd_${vehicles}`);
  assert.deepEqual(wrong, []);
  await close();
  await server.end();
  assert.ok(drawCalls <= 30, `${drawCalls} draw calls`);
  return { scriptMs, said: `${vehicles}: ${drawCalls} draw calls, ${scriptMs.toFixed(1)} ms of script, ${fps.toFixed(0)} pictures a second` };
}

/** Five times the vehicles cost five times the script, or less; if each looked at each, it would be 25 times. */
export async function many_vehicles_cost_script_in_proportion(around) {
  const [few, many] = [await measured(around, 2000), await measured(around, 10_000)];
  const said = `${few.said}; ${many.said}`;
  assert.ok(many.scriptMs <= 11 * few.scriptMs, said);
  return said;
}
