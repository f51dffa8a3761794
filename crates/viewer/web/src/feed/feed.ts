import type { PageMessage, ServerMessage } from '../protocol/messages.ts';
import type { Scene } from '../protocol/scene.ts';

export type Connection =
  | { state: 'connecting' }
  | { state: 'open' }
  | { state: 'lost'; retry_s: number }
  | { state: 'refused'; what: string };

export interface FeedListener {
  scene(scene: Scene): void;
  message(message: ServerMessage): void;
  frame(bytes: ArrayBuffer): void;
  connection(connection: Connection): void;
}

/** Where scenes, frames and messages come from: a server, or the file that the page is. */
export interface Feed {
  /** Whether it can measure lanes, and say of vehicles what a frame has no room for. */
  readonly hasServer: boolean;
  start(listener: FeedListener): void;
  say(message: PageMessage): void;
}
