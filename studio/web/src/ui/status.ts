// One line on how things stand: the connection, what is being done, what is wrong.
import type { Line } from "../protocol/stream";

export class Status {
  private line: Line = "connecting";
  private retryAt_ms = 0;
  private busy = "";
  private faults = 0;
  private timer = 0;

  constructor(private readonly place: HTMLElement) {}

  connection(line: Line, retryIn_ms: number): void {
    this.line = line;
    this.retryAt_ms = performance.now() + retryIn_ms;
    this.write();
  }

  doing(stage: string, share: number): void {
    this.busy = stage ? `${stage.replaceAll("_", " ")}${share > 0 && share < 1 ? ` ${Math.round(100 * share)} %` : ""}` : "";
    this.write();
  }

  wrong(faults: number): void {
    this.faults = faults;
    this.write();
  }

  private write(): void {
    window.clearTimeout(this.timer);
    const { words, state } = this.words();
    this.place.dataset["state"] = state;
    if (this.place.textContent !== words) this.place.textContent = words;
    if (state === "lost") this.timer = window.setTimeout(() => this.write(), 500);
  }

  private words(): { words: string; state: string } {
    if (this.line === "lost" || this.line === "ended") {
      const in_s = Math.max(0, Math.ceil((this.retryAt_ms - performance.now()) / 1000));
      const what = this.line === "ended" ? "Espalier was closed" : "No connection";
      return { words: `${what}; your text is kept. Trying again${in_s ? ` in ${in_s} s` : " now"}`, state: "lost" };
    }
    if (this.line === "connecting") return { words: "Connecting", state: "busy" };
    if (this.faults) return { words: `${this.faults} ${this.faults === 1 ? "error" : "errors"}: the plant is that of the last good text`, state: "fault" };
    if (this.busy) return { words: this.busy, state: "busy" };
    return { words: "Up to date", state: "rest" };
  }
}
