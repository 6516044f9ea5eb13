// A slider with one handle or two, for the hand, the keys and screen readers. It tells what it is turned to; what that
// does is not its concern.
import { clamp, make } from "../base/dom";
import { stepOf } from "../yaml/amount";

export interface SliderSpec {
  label: string;
  low: number;
  high: number;
  whole: boolean;
  /** One value, or the two ends of a range. */
  values: number[];
  /** A value in words, such as "4 cm". */
  words: (value: number) => string;
}

export interface SliderWatcher {
  /** While it is turned; `step` is how fine it turns. */
  turn(values: number[], step: number): void;
  /** When it is let go. */
  rest(): void;
}

export class Slider {
  readonly element: HTMLElement;
  private readonly track: HTMLElement;
  private readonly span: HTMLElement;
  private handles: HTMLElement[] = [];
  private spec: SliderSpec;
  private step = 1;
  private held = -1;
  turning = false;

  constructor(spec: SliderSpec, private readonly watcher: SliderWatcher) {
    this.spec = spec;
    this.span = make("span", { class: "slider-span" });
    this.track = make("span", { class: "slider-track" }, this.span);
    this.element = make("span", { class: "slider" }, this.track);
    this.element.addEventListener("pointerdown", (event) => this.press(event));
    this.element.addEventListener("pointermove", (event) => this.move(event));
    this.element.addEventListener("pointerup", (event) => this.release(event));
    this.element.addEventListener("pointercancel", (event) => this.release(event));
    this.set(spec);
  }

  /** What the text says now. While the hand is on it, its ends stay where they are. */
  set(spec: SliderSpec): void {
    this.spec = this.turning ? { ...spec, low: this.spec.low, high: this.spec.high } : spec;
    this.step = stepOf(this.spec.high - this.spec.low, spec.whole);
    if (this.handles.length !== spec.values.length) this.remake();
    this.write();
  }

  private remake(): void {
    for (const handle of this.handles) handle.remove();
    this.handles = this.spec.values.map((_, index) => {
      const handle = make("span", { class: "slider-handle", role: "slider", tabindex: 0 });
      handle.addEventListener("keydown", (event) => this.key(event, index));
      this.track.append(handle);
      return handle;
    });
  }

  private write(): void {
    const { values, low, high } = this.spec;
    const share = (value: number) => 100 * clamp((value - low) / (high - low || 1), 0, 1);
    const shares = values.map(share);
    const zero = low < 0 && high > 0 ? share(0) : 0;
    const [from, to] = shares.length === 2 ? [shares[0] ?? 0, shares[1] ?? 0] : [Math.min(zero, shares[0] ?? 0), Math.max(zero, shares[0] ?? 0)];
    this.span.style.left = `${from}%`;
    this.span.style.width = `${Math.max(0, to - from)}%`;
    this.handles.forEach((handle, index) => {
      const value = values[index] ?? 0;
      handle.style.left = `${shares[index] ?? 0}%`;
      const end = values.length === 2 ? (index === 0 ? ", from" : ", to") : "";
      handle.setAttribute("aria-label", this.spec.label + end);
      handle.setAttribute("aria-valuemin", String(low));
      handle.setAttribute("aria-valuemax", String(high));
      handle.setAttribute("aria-valuenow", String(value));
      handle.setAttribute("aria-valuetext", this.spec.words(value));
    });
  }

  private valueAt(event: PointerEvent): number {
    const box = this.track.getBoundingClientRect();
    const share = clamp((event.clientX - box.left) / (box.width || 1), 0, 1);
    return this.rounded(this.spec.low + share * (this.spec.high - this.spec.low));
  }

  private rounded(value: number): number {
    const stepped = Math.round(value / this.step) * this.step;
    return clamp(Number(stepped.toPrecision(10)), this.spec.low, this.spec.high);
  }

  private press(event: PointerEvent): void {
    if (event.button !== 0) return;
    event.preventDefault();
    const value = this.valueAt(event);
    const offs = this.spec.values.map((each) => Math.abs(each - value));
    this.held = offs.indexOf(Math.min(...offs));
    const [first, second] = this.spec.values;
    if (first !== undefined && first === second) this.held = value < first ? 0 : 1;
    this.turning = true;
    this.element.setPointerCapture(event.pointerId);
    this.handles[this.held]?.focus({ preventScroll: true });
    this.put(this.held, value);
  }

  private move(event: PointerEvent): void {
    if (this.held >= 0) this.put(this.held, this.valueAt(event));
  }

  private release(event: PointerEvent): void {
    if (this.held < 0) return;
    this.held = -1;
    this.turning = false;
    this.element.releasePointerCapture(event.pointerId);
    this.watcher.rest();
  }

  private put(index: number, value: number): void {
    const values = [...this.spec.values];
    const [low, high] = [index === 1 ? (values[0] ?? value) : -Infinity, index === 0 ? (values[1] ?? Infinity) : Infinity];
    const next = clamp(value, low, high);
    if (next === values[index]) return;
    values[index] = next;
    this.spec = { ...this.spec, values };
    this.write();
    this.watcher.turn(values, this.step);
  }

  private key(event: KeyboardEvent, index: number): void {
    const value = this.spec.values[index] ?? 0;
    const big = 10 * this.step;
    const next: Record<string, number> = {
      ArrowLeft: value - this.step, ArrowDown: value - this.step, ArrowRight: value + this.step, ArrowUp: value + this.step,
      PageDown: value - big, PageUp: value + big, Home: this.spec.low, End: this.spec.high,
    };
    const to = next[event.key];
    if (to === undefined || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    this.put(index, this.rounded(to));
    this.watcher.rest();
  }
}
