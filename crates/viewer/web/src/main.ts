import './style.css';
import { SocketFeed } from './feed/socket_feed.ts';
import { Page } from './page.ts';
import { element } from './panels/dom.ts';

function hasWebGl(): boolean {
  return document.createElement('canvas').getContext('webgl2') !== null;
}

if (hasWebGl()) {
  new Page(new SocketFeed()).start();
} else {
  document.body.append(
    element('p', { class: 'plain' }, 'This page needs WebGL 2, which this browser does not offer. Turn on hardware acceleration, or use another browser.'),
  );
}
