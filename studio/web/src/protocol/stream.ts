// The stream of frames, opened again with growing pauses where it breaks off. A stream that says nothing for
// longer than the program ever does (it sends something every two seconds) counts as broken.
import { FrameReader, type Frame } from "./frames";

export type Line = "connecting" | "open" | "lost" | "ended";

const firstPause_ms = 400;
const longestPause_ms = 8000;
const silence_ms = 9000;

export interface StreamWatcher {
  frame(frame: Frame): void;
  /** With "lost" comes when it is tried again. */
  line(state: Line, retryIn_ms: number): void;
}

export class Stream {
  private pause_ms = firstPause_ms;
  private timer = 0;
  private ended = false;
  private abort = new AbortController();

  constructor(private readonly watcher: StreamWatcher) {
    window.addEventListener("online", () => this.retryNow());
  }

  open(): void {
    void this.run();
  }

  /** Where it waits to try again, it does so at once. */
  retryNow(): void {
    if (this.timer === 0) return;
    window.clearTimeout(this.timer);
    this.timer = 0;
    void this.run();
  }

  private async run(): Promise<void> {
    this.timer = 0;
    this.ended = false;
    this.abort = new AbortController();
    this.watcher.line("connecting", 0);
    let watchdog = 0;
    const heard = () => {
      window.clearTimeout(watchdog);
      watchdog = window.setTimeout(() => this.abort.abort(), silence_ms);
    };
    try {
      heard();
      const answer = await fetch("/api/stream", { signal: this.abort.signal, cache: "no-store" });
      if (!answer.ok || !answer.body) throw new Error(answer.statusText);
      const reader = answer.body.getReader();
      const frames = new FrameReader();
      this.pause_ms = firstPause_ms;
      this.watcher.line("open", 0);
      for (;;) {
        const { done, value } = await reader.read();
        if (done) break;
        heard();
        for (const frame of frames.push(value)) {
          if (frame.kind === "event" && frame.event.event === "end") this.ended = true;
          this.watcher.frame(frame);
        }
      }
    } catch (error) {
      // A connection that breaks needs no word here: the line below says so. A fault of ours does.
      if (error instanceof SyntaxError || error instanceof RangeError || error instanceof TypeError) console.warn(error);
    } finally {
      window.clearTimeout(watchdog);
    }
    this.watcher.line(this.ended ? "ended" : "lost", this.pause_ms);
    this.timer = window.setTimeout(() => void this.run(), this.pause_ms);
    this.pause_ms = Math.min(longestPause_ms, this.pause_ms * 1.8);
  }
}
