// The scrubber: what stood after each iteration, and play. At its end it stands for "as it is", so that growth streams.
import { drawing, make, refill } from "../base/dom";

const play = '<path d="M4 2.5L12 8L4 13.5Z" fill="currentColor"/>';
const pause = '<path d="M4 2.5H7V13.5H4ZM9 2.5H12V13.5H9Z" fill="currentColor"/>';
const play_s = 5;

export class Scrubber {
  private readonly range = make("input", { type: "range", min: 0, max: 1000, step: 1, value: 1000, "aria-label": "Iteration that is shown" });
  private readonly button = make("button", { type: "button", "aria-label": "Play growth" });
  private readonly words = make("output", {});
  private iterations = 1;
  private reached = 0;
  private share = 1;
  private frame = 0;

  constructor(place: HTMLElement, private readonly show: (until: number) => void) {
    refill(place, this.button, this.range, this.words);
    this.range.addEventListener("input", () => {
      this.stop();
      this.set(Number(this.range.value) / 1000);
    });
    this.button.addEventListener("click", () => (this.frame ? this.stop() : this.play()));
    this.draw();
  }

  /** How far growth has come. */
  grown(reached: number, iterations: number): void {
    this.reached = reached;
    this.iterations = Math.max(1, iterations);
    this.draw();
    this.tell();
  }

  private set(share: number): void {
    this.share = share;
    this.draw();
    this.tell();
  }

  private tell(): void {
    this.show(this.share >= 1 ? Infinity : this.share * this.reached);
  }

  private draw(): void {
    const at = this.share >= 1 ? this.reached : Math.floor(this.share * this.reached);
    this.words.textContent = `${at} / ${this.iterations}`;
    this.range.value = String(Math.round(1000 * this.share));
    this.range.setAttribute("aria-valuetext", this.share >= 1 ? "all of it" : `iteration ${at} of ${this.iterations}`);
    refill(this.button, drawing(16, 16, this.frame ? pause : play));
  }

  private play(): void {
    const from = this.share >= 1 ? 0 : this.share;
    const began = performance.now();
    const step = (now: number): void => {
      const share = Math.min(1, from + (now - began) / (1000 * play_s));
      this.frame = share < 1 ? requestAnimationFrame(step) : 0;
      this.set(share);
      this.button.setAttribute("aria-label", this.frame ? "Pause growth" : "Play growth");
    };
    this.frame = requestAnimationFrame(step);
  }

  private stop(): void {
    if (this.frame) cancelAnimationFrame(this.frame);
    this.frame = 0;
    this.button.setAttribute("aria-label", "Play growth");
    this.draw();
  }
}
