import type { PageMessage, ServerMessage } from '../protocol/messages.ts';
import type { Scene } from '../protocol/scene.ts';
import type { Feed, FeedListener } from './feed.ts';
import { takeToken } from './token.ts';

const FIRST_RETRY_S = 0.5;
const LONGEST_RETRY_S = 10;

/** The server that sent the page. It connects again whenever the connection is lost. */
export class SocketFeed implements Feed {
  readonly hasServer = true;
  private socket: WebSocket | null = null;
  private listener: FeedListener | null = null;
  private retry_s = FIRST_RETRY_S;
  private hasScene = false;
  /** Whether the last connection was open; if not, another server may be there now. */
  private wasOpen = true;
  private readonly token = takeToken(window);

  start(listener: FeedListener): void {
    this.listener = listener;
    void this.connect();
  }

  say(message: PageMessage): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }

  private async connect(): Promise<void> {
    const listener = this.listener;
    if (!listener) return;
    listener.connection({ state: 'connecting' });
    try {
      if (!this.hasScene) {
        listener.scene((await (await this.ask('GET')).json()) as Scene);
        this.hasScene = true;
      } else if (!this.wasOpen) {
        await this.ask('HEAD');
      }
    } catch (error) {
      if (error instanceof Forbidden) listener.connection({ state: 'refused', what: error.message });
      else this.retry();
      return;
    }
    this.open(listener);
  }

  /** Asks for the scene, or only whether there is one. */
  private async ask(method: 'GET' | 'HEAD'): Promise<Response> {
    const answer = await fetch(`/scene.json?token=${encodeURIComponent(this.token)}`, { method });
    if (answer.status === 401 || answer.status === 403) {
      throw new Forbidden('The server does not know this address. Open the address that laneweave view prints.');
    }
    if (!answer.ok) throw new Error(answer.statusText);
    return answer;
  }

  private open(listener: FeedListener): void {
    const scheme = location.protocol === 'https:' ? 'wss' : 'ws';
    const socket = new WebSocket(`${scheme}://${location.host}/live?token=${encodeURIComponent(this.token)}`);
    socket.binaryType = 'arraybuffer';
    this.socket = socket;
    this.wasOpen = false;
    socket.onopen = () => {
      this.wasOpen = true;
      this.retry_s = FIRST_RETRY_S;
      listener.connection({ state: 'open' });
    };
    socket.onmessage = (event: MessageEvent<string | ArrayBuffer>) => {
      if (typeof event.data === 'string') listener.message(JSON.parse(event.data) as ServerMessage);
      else listener.frame(event.data);
    };
    socket.onclose = () => this.retry();
  }

  private retry(): void {
    this.socket = null;
    this.listener?.connection({ state: 'lost', retry_s: this.retry_s });
    setTimeout(() => void this.connect(), this.retry_s * 1000);
    this.retry_s = Math.min(this.retry_s * 2, LONGEST_RETRY_S);
  }
}

class Forbidden extends Error {}
