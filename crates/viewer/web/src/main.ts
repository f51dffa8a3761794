import './style.css';
import { FileFeed } from './feed/file_feed.ts';
import type { ReplayFile } from './feed/replay_file.ts';
import { SocketFeed } from './feed/socket_feed.ts';
import { Page } from './page.ts';
import { element } from './panels/dom.ts';

const NO_WEBGL = 'This page needs WebGL 2, which this browser does not offer. Turn on hardware acceleration, or use another browser.';

function hasWebGl(): boolean {
  return document.createElement('canvas').getContext('webgl2') !== null;
}

/** The replay that an exported page brings along, if it is one. */
function replay(): ReplayFile | null {
  const text = document.getElementById('replay')?.textContent;
  return text ? (JSON.parse(text) as ReplayFile) : null;
}

function start(): void {
  if (!hasWebGl()) {
    document.body.append(element('p', { class: 'plain', role: 'alert' }, NO_WEBGL));
    return;
  }
  const file = replay();
  new Page(file ? new FileFeed(file) : new SocketFeed()).start();
}

start();
