const KEY = 'token';

/** What it needs of a window. */
interface Tab {
  location: { href: string };
  history: { state: unknown; replaceState(state: unknown, unused: string, address: string): void };
}

/** The token of the address. It leaves the address bar; the history of the tab keeps it for when the page is loaded again. */
export function takeToken({ location, history }: Tab): string {
  const address = new URL(location.href);
  const given = address.searchParams.get(KEY);
  if (given === null) return (history.state as { token?: string } | null)?.token ?? '';
  address.searchParams.delete(KEY);
  history.replaceState({ token: given }, '', address.href);
  return given;
}
