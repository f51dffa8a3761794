// The reports of runs, and pages and pictures of maps: at all widths, light, dark and on paper.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdirSync, readFileSync, readdirSync } from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import { page } from './browser.mjs';
import { crowded, faults, figures } from './faults.mjs';

const WIDTHS = [390, 1280, 2560];
/** The width of A4 without its margins. */
const PAPER = 680;
const LOOKS = [
  ...WIDTHS.flatMap((width) => [false, true].map((dark) => ({ width, dark, media: 'screen' }))),
  { width: PAPER, dark: true, media: 'print' },
];
const [SPEED, DENSITY, CHANGES] = ['Mean speed on the map', 'Density on the map', 'Lane changes on the map'];
const COLLISIONS = 'Collisions and overlaps on the map';
/** Figures that every report has. */
const ALWAYS = [SPEED, DENSITY, CHANGES, 'Queues on the map', 'Speeds', 'Accelerations', 'Vehicles over time'];

/** Maps and a scenario of the project, and all Lanelet2 maps beside it. */
function sources({ home, data }) {
  const own = ['maps/ramps.osm', 'maps/town.osm', 'scenarios/demo.toml'].map((it) => path.join(home, it));
  if (!data) return own;
  const within = ['lanelet2', 'minimal'].flatMap((it) => {
    const folder = path.join(data, it);
    return readdirSync(folder).filter((file) => file.endsWith('.osm')).map((file) => path.join(folder, file));
  });
  return [...own, ...within, path.join(data, 'recordings/mona_east/map.osm')];
}

/** A name for what is made of a source. */
const named = (source) => source.split(path.sep).slice(-2).join('_').replace(/\.\w+$/, '');

/** Runs a scenario or a map for a short time: the file of its report. */
function reported({ program }, source, out, options) {
  const args = ['run', source, ...options, '--record', '0', '--out', out, '--quiet'];
  execFileSync(program, args, { stdio: ['ignore', 'ignore', 'inherit'] });
  return path.join(out, 'report.html');
}

/** Of several looks, those in which file number `at` is seen: every second one, unless tests run whole. */
const seen = (looks, at) => looks.filter((_, number) => (
  process.env.LANEWEAVE_TESTS === 'full' || looks.length === 1 || (number + at) % 2 === 0));

/** Looks at files in these looks with `look`, which returns what is wrong; says how many there were. */
async function looked_at({ browser, shots }, files, looks, look) {
  const { page: opened, wrong, asked, close } = await page(browser, { offline: true });
  const found = [];
  mkdirSync(path.join(shots, 'reports'), { recursive: true });
  try {
    for (const [at, file] of files.entries()) {
      const name = path.relative(path.dirname(path.dirname(file)), file).replaceAll(path.sep, '_');
      await opened.goto(pathToFileURL(file).href);
      for (const { width, dark, media } of seen(looks, at)) {
        await opened.setViewportSize({ width, height: 900 });
        await opened.emulateMedia({ media, colorScheme: dark ? 'dark' : 'light' });
        // What a page does when its size changes, it has done after two frames.
        await opened.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
        const all = await look(opened, file);
        found.push(...all.map((it) => `${name}, ${width} px, ${dark ? 'dark' : 'light'}, ${media}: ${it}`));
        if (all.length > 0) {
          const shot = `${name}_${width}_${dark ? 'dark' : 'light'}_${media}.png`;
          await opened.screenshot({ path: path.join(shots, 'reports', shot), fullPage: true });
        }
      }
    }
    assert.deepEqual([...asked].filter((it) => !/^(file|data|blob):/.test(it)), [], 'requests to a network');
    assert.deepEqual(wrong, [], 'errors of a page');
    assert.deepEqual(found, [], 'the look of pages');
  } finally {
    await close();
  }
  return `${files.length} files in ${looks.length} looks`;
}

/** What is wrong with the figures of a report. */
function missing(all, summary) {
  const titles = all.map((it) => it.title);
  const wanted = summary.collisions + summary.overlaps > 0 ? [...ALWAYS, COLLISIONS] : ALWAYS;
  const wrong = wanted.filter((it) => !titles.includes(it)).map((it) => `no figure “${it}”`);
  if (titles.length !== new Set(titles).size) wrong.push(`two figures of one title: ${titles}`);
  const changes = summary.lane_changes_discretionary + summary.lane_changes_route_driven;
  for (const { title, size, roads, lanes, marks, shapes } of all) {
    const isEmpty = Math.min(...size) < 50 || shapes === 0
      || (title.endsWith('on the map') && roads === 0)
      || ([SPEED, DENSITY].includes(title) && lanes === 0)
      || (title === COLLISIONS && marks === 0)
      || (title === CHANGES && changes > 0 && marks === 0);
    if (isEmpty) wrong.push(`the figure “${title}” is empty`);
  }
  return wrong;
}

/** A short run of every map: its report has all its figures, and nothing in it overlaps. */
export async function reports_of_all_maps(around) {
  const options = ['--duration', '60', '--warmup', '30'];
  const reports = sources(around).map((source) => (
    reported(around, source, path.join(around.folder, 'reports', named(source)), options)));
  return looked_at(around, reports, LOOKS, async (opened, file) => {
    const summary = JSON.parse(readFileSync(path.join(path.dirname(file), 'summary.json')));
    return [...missing(await opened.evaluate(figures), summary), ...await opened.evaluate(faults)];
  });
}

/** The number of the values in each line of a table; values with a comma stand in quotation marks. */
const widths = (csv) => csv.trimEnd().split('\n').map((line) => line.replace(/"[^"]*"/g, '').split(',').length);

/** The download of a link. A browser on a busy machine may not answer a click: a reader would click again. */
async function downloaded(opened, link) {
  for (let tries = 1; ; tries += 1) {
    try {
      const [download] = await Promise.all([opened.waitForEvent('download', { timeout: 20_000 }), link.click()]);
      return download;
    } catch (error) {
      if (tries === 5) throw error;
    }
  }
}

/** Every figure of a report, as a drawing and as a table. */
export async function figures_to_take_along(around) {
  const report = reported(around, path.join(around.home, 'maps/ramps.osm'), path.join(around.folder, 'taken'), ['--duration', '120']);
  const { page: opened, wrong, close } = await page(around.browser, { offline: true });
  await opened.goto(pathToFileURL(report).href);
  const links = await opened.locator('figure .downloads > *').all();
  for (const link of links) {
    const download = await downloaded(opened, link);
    const name = download.suggestedFilename();
    const text = readFileSync(await download.path(), 'utf8');
    if (name.endsWith('.svg')) assert.match(text, /^<svg [^]*xmlns="http:\/\/www.w3.org\/2000\/svg"[^]*<\/svg>$/, name);
    else assert.ok(name.endsWith('.csv') && new Set(widths(text)).size === 1 && widths(text).length > 1, name);
  }
  assert.deepEqual(wrong, []);
  await close();
  assert.ok(links.length >= 20, `${links.length} downloads`);
  return `${links.length} downloads`;
}

/** Busy roads, where marks of lane changes would lie on each other. */
export async function marks_of_busy_roads(around) {
  const reports = ['motorway_4_lanes', 'weaving'].map((name) => {
    const source = path.join(around.home, `maps/${name}.osm`);
    return reported(around, source, path.join(around.folder, 'busy', name), ['--duration', '300']);
  });
  return looked_at(around, reports, LOOKS.slice(0, 1), (opened) => opened.evaluate(crowded, CHANGES));
}

/** The page and the picture of every map that the check of maps draws. */
export async function pages_and_pictures_of_all_maps(around) {
  const folder = path.join(around.folder, 'checks');
  mkdirSync(folder, { recursive: true });
  const maps = sources(around).filter((it) => it.endsWith('.osm'));
  const files = maps.flatMap((map) => {
    const both = ['html', 'svg'].map((kind) => path.join(folder, `${named(map)}.${kind}`));
    execFileSync(around.program, ['check', map, '--html', both[0], '--svg', both[1]], { stdio: 'ignore' });
    return both;
  });
  const [html, svg] = ['html', 'svg'].map((kind) => files.filter((it) => it.endsWith(kind)));
  const said = await looked_at(around, html, LOOKS, (opened) => opened.evaluate(faults));
  const pictures = LOOKS.filter((it) => !it.dark && it.media === 'screen');
  return `${said}, ${await looked_at(around, svg, pictures, (opened) => opened.evaluate(faults))}`;
}
