import { createHash } from 'node:crypto';
import { readdirSync, readFileSync } from 'node:fs';
import path from 'node:path';
import type { Plugin, Rolldown } from 'vite';

type Bundle = Rolldown.OutputBundle;

const LICENCES = 'LICENCES.txt';
const GENERATED = 'Generated from crates/viewer/web by npm run page. Do not edit.';

/** Puts script, style and licences into the HTML file. The licences are written beside it, too. */
export const oneFile: Plugin = {
  name: 'one-file',
  enforce: 'post',
  generateBundle(_options, bundle) {
    const html = asset(bundle, 'index.html');
    const style = asset(bundle, 'page.css').source;
    const script = bundle['page.js'];
    if (script?.type !== 'chunk') throw new Error('there is no page.js');
    const licences = licencesOf(script.moduleIds);
    html.source = inlined(String(html.source), script.code, String(style), licences);
    delete bundle['page.js'];
    delete bundle['page.css'];
    this.emitFile({ type: 'asset', fileName: LICENCES, source: licences });
  },
};

function asset(bundle: Bundle, name: string): Rolldown.OutputAsset {
  const found = bundle[name];
  if (found?.type !== 'asset') throw new Error(`there is no ${name}`);
  return found;
}

/** The HTML with all of it in place of its two references. */
function inlined(html: string, script: string, style: string, licences: string): string {
  if (/<\/script|<script|<!--/i.test(script)) throw new Error('the script has a text that would end it early');
  if (/<\/style/i.test(style)) throw new Error('the style has a text that would end it early');
  if (licences.includes('--')) throw new Error('a licence has a text that would end its comment early');
  // The browser runs this script and no other one.
  const code = `\n${script}`;
  const policy = `script-src 'sha256-${createHash('sha256').update(code).digest('base64')}'`;
  const parts = `<!-- ${GENERATED}\n\n${licences}-->
    <meta http-equiv="Content-Security-Policy" content="${policy}" />
    <script type="module">${code}</script>`;
  const withScript = replaced(html, /<script type="module"[^>]*><\/script>/, parts);
  return replaced(withScript, /<link rel="stylesheet"[^>]*>/, `<style>\n${style}</style>`);
}

function replaced(text: string, reference: RegExp, by: string): string {
  if (!reference.test(text)) throw new Error(`the page has no ${reference}`);
  return text.replace(reference, () => by);
}

/** The licences of the packages that these modules are from. */
function licencesOf(modules: string[]): string {
  const folders = modules.flatMap((it) => it.match(/^.*\/node_modules\/(@[^/]+\/)?[^/]+/)?.[0] ?? []);
  const texts = [...new Set(folders)].sort().map((folder) => {
    const name = readdirSync(folder).find((it) => /^licen[cs]e/i.test(it));
    if (!name) throw new Error(`${folder} has no licence`);
    return `${folder.split('node_modules/').at(-1)}\n\n${readFileSync(path.join(folder, name), 'utf8').trim()}\n`;
  });
  return `The page contains code of others:\n\n${texts.join('\n\n')}`;
}
