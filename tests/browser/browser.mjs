// A browser with software WebGL, the program that serves the page, and what both have in common in all tests.

import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { mkdirSync } from 'node:fs';
import { once } from 'node:events';
import path from 'node:path';
import { chromium } from 'playwright-core';

const PATIENCE_MS = 600_000;
const CHROMIUM = process.env.CHROMIUM ?? '/usr/bin/chromium';

/** A browser in which pictures are drawn by Mesa. It needs a display, such as that of xvfb-run. */
export async function open() {
  return chromium.launch({
    executablePath: CHROMIUM,
    headless: false,
    args: [
      '--no-sandbox', '--use-gl=angle', '--use-angle=gl', '--ignore-gpu-blocklist', '--disable-quic',
      '--disable-background-networking', '--disable-component-update', '--disable-sync',
    ],
  });
}

/** `laneweave view` with these arguments: its address, and how to end it. */
export async function view(program, args, cwd) {
  const server = spawn(program, ['view', '--no-browser', ...args], { cwd, stdio: ['ignore', 'pipe', 'pipe'] });
  let said = '';
  server.stdout.setEncoding('utf8');
  server.stderr.setEncoding('utf8').on('data', (text) => (said += text));
  const url = await new Promise((found, failed) => {
    let heard = '';
    server.stdout.on('data', (text) => {
      heard += text;
      const address = heard.match(/http:\S+/);
      if (address) found(address[0]);
    });
    server.on('exit', (code) => failed(new Error(`laneweave view ended with ${code}: ${said}`)));
  });
  const end = async () => {
    server.kill('SIGINT');
    const [code] = await once(server, 'exit');
    assert.equal(code, 0, said);
  };
  return { url, end };
}

/** A page of a browser, which counts what goes wrong in it and what it asks the network for. */
export async function page(browser, { width = 1280, height = 720, dark = false, offline = false } = {}) {
  const context = await browser.newContext({ viewport: { width, height }, colorScheme: dark ? 'dark' : 'light', offline });
  const opened = await context.newPage();
  opened.setDefaultTimeout(PATIENCE_MS);
  const wrong = [];
  const asked = new Set();
  opened.on('pageerror', (error) => wrong.push(String(error)));
  opened.on('console', (message) => message.type() === 'error' && wrong.push(message.text()));
  opened.on('request', (request) => asked.add(request.url()));
  return { page: opened, wrong, asked, close: () => context.close() };
}

export const hook = (name) => `[data-test="${name}"]`;

/** Lets time go on, if it does not already: it begins by itself when the first page opens. */
export async function play(opened) {
  const button = opened.locator(hook('play'));
  if (await button.isVisible()) await button.click();
}

/** What the page publishes of itself. */
export const state = (opened) => opened.evaluate(() => window.laneweave);

/** Waits until time stands. */
export async function stands(opened) {
  for (let before = -1; ; ) {
    const now = await state(opened);
    if (now.time_s === before) return now;
    before = now.time_s;
    await opened.waitForTimeout(2000);
  }
}

/** Waits until the page publishes something for which `test` holds. */
export async function until(opened, what, test) {
  const begin = Date.now();
  for (;;) {
    const now = await state(opened);
    if (now && test(now)) return now;
    assert.ok(Date.now() - begin < PATIENCE_MS, `waited in vain until ${what}: ${JSON.stringify(now)}`);
    await opened.waitForTimeout(100);
  }
}

/** Keeps a picture of the page. */
export async function shoot(opened, folder, name) {
  mkdirSync(folder, { recursive: true });
  await opened.waitForTimeout(400);
  await opened.screenshot({ path: path.join(folder, `${name}.png`) });
}

/**
 * The most draw calls of a picture, the script that it costs [ms of CPU], and pictures a second: medians over some seconds.
 * Script is all that runs in the page, such as what reads frames. Time in which other programs have the core is not counted.
 */
export async function measure(opened, seconds = 10) {
  const devtools = await opened.context().newCDPSession(opened);
  await devtools.send('Performance.enable', { timeDomain: 'threadTicks' });
  const look = async () => {
    const { metrics } = await devtools.send('Performance.getMetrics');
    const { drawCalls, pictures } = await state(opened);
    return { at: Date.now(), drawCalls, pictures, script_s: metrics.find(({ name }) => name === 'ScriptDuration').value };
  };
  const looks = [await look()];
  for (let n = 0; n < seconds; n += 1) {
    await opened.waitForTimeout(1000);
    looks.push(await look());
  }
  await devtools.detach();
  const median = (of) => looks.slice(1).map((it, n) => of(it, looks[n])).sort((a, b) => a - b)[seconds >> 1];
  return {
    drawCalls: Math.max(...looks.map((it) => it.drawCalls)),
    scriptMs: median((it, before) => (1000 * (it.script_s - before.script_s)) / (it.pictures - before.pictures)),
    fps: median((it, before) => (1000 * (it.pictures - before.pictures)) / (it.at - before.at)),
  };
}
