import type { Hand, Hands } from './protocol/messages.ts';

/** The fields that name what something is set of. */
const NAMES = ['style', 'parameter', 'origin', 'light', 'lanelet'];

/** The same for all that set the same thing. */
function subject(hand: Hand): string {
  const [[kind, fields]] = Object.entries(hand) as [[string, Record<string, unknown>]];
  return JSON.stringify([kind, ...NAMES.map((name) => fields[name] ?? null)]);
}

/** What was done by hand and is set by it, with what is new or has changed. */
export function withNews(known: Hands, news: Hands): Hands {
  const done = [...known.done];
  for (const entry of news.done) done[entry.number - 1] = entry;
  const set = new Map([...known.set, ...news.set].map((hand) => [subject(hand), hand]));
  return { done, set: [...set.values()] };
}
