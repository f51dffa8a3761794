/** A value that tells those who watch it when it changes. */
export class Signal<T> {
  private readonly watchers = new Set<(value: T) => void>();
  private held: T;

  constructor(value: T) {
    this.held = value;
  }

  get value(): T {
    return this.held;
  }

  set(value: T): void {
    this.held = value;
    for (const watcher of this.watchers) watcher(value);
  }

  /** Calls the watcher now and after every change. */
  watch(watcher: (value: T) => void): void {
    this.watchers.add(watcher);
    watcher(this.held);
  }
}

/** Something that happens again and again. */
export class Happening<T> {
  private readonly listeners = new Set<(value: T) => void>();

  tell(value: T): void {
    for (const listener of this.listeners) listener(value);
  }

  listen(listener: (value: T) => void): void {
    this.listeners.add(listener);
  }
}
