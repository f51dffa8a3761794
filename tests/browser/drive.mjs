// Drives every feature of the viewer in a browser, and keeps pictures:
//
//   xvfb-run -a node drive.mjs PROGRAM [NAME...]
//
// Pictures go to shots/. LANEWEAVE_DATA names the folder of real maps and recordings. With LANEWEAVE_TESTS=full every
// report and page of a map is looked at in all looks.

import { mkdtempSync, rmSync } from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { open } from './browser.mjs';
import { dataFolder } from './data.mjs';
import * as many from './many.mjs';
import * as hands from './hands.mjs';
import * as looks from './looks.mjs';
import * as replays from './replays.mjs';
import * as reports from './reports.mjs';
import * as road from './road.mjs';
import * as twins from './twins.mjs';
import * as visits from './visits.mjs';

const here = path.dirname(fileURLToPath(import.meta.url));
const home = path.join(here, '../..');
const [program, ...names] = process.argv.slice(2);
if (!program) throw new Error('give the program: node drive.mjs PROGRAM');

const data = dataFolder(home);
const browser = await open();
const folder = mkdtempSync(path.join(os.tmpdir(), 'laneweave-view-'));
const around = { browser, program: path.resolve(program), home, folder, shots: path.join(here, 'shots'), data };
let failed = 0;
for (const [name, test] of Object.entries({ ...looks, ...hands, ...road, ...replays, ...twins, ...visits, ...reports, ...many })) {
  if (names.length > 0 && !names.includes(name)) continue;
  const begin = Date.now();
  try {
    const said = await test(around);
    console.log(`ok    ${name} (${((Date.now() - begin) / 1000).toFixed(1)} s)${said ? `: ${said}` : ''}`);
  } catch (error) {
    failed += 1;
    console.log(`WRONG ${name} (${((Date.now() - begin) / 1000).toFixed(1)} s): ${error.stack}`);
  }
}
await browser.close();
rmSync(folder, { recursive: true, force: true });
process.exit(failed > 0 ? 1 : 0);
