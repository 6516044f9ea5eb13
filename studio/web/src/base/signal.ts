// A value that tells who listens when it changes. All of the page's state is made of these.

export type Stop = () => void;

export class Signal<T> {
  private readonly listeners = new Set<(value: T) => void>();

  constructor(private current: T) {}

  get value(): T {
    return this.current;
  }

  set value(next: T) {
    if (Object.is(next, this.current)) return;
    this.current = next;
    this.tell();
  }

  /** Tells listeners, also where the value is the same object with other contents. */
  tell(): void {
    for (const listener of [...this.listeners]) listener(this.current);
  }

  /** Calls at once and then at each change. */
  watch(listener: (value: T) => void): Stop {
    listener(this.current);
    return this.onChange(listener);
  }

  onChange(listener: (value: T) => void): Stop {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }
}
