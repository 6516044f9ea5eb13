// What the stream says, put where it belongs: texts' problems, the scene, what has grown.
import { Signal } from "./base/signal";
import { Growth } from "./growth/plants";
import type { Workspace } from "./editor/workspace";
import type { Frame } from "./protocol/frames";
import type { GrowthEvent, LooksEvent, SceneEvent, ServerEvent, StagesEvent } from "./protocol/types";

export interface LiveWatcher {
  scene(scene: SceneEvent): void;
  /** Something of what is shown has changed. */
  grown(changed: "all" | ReadonlySet<number>): void;
  growth(event: GrowthEvent): void;
  stages(event: StagesEvent): void;
  busy(stage: string, share: number): void;
  project(): void;
  hello(): void;
}

export class Live {
  readonly growth = new Growth(() => performance.now());
  readonly scene = new Signal<SceneEvent | null>(null);
  looks: LooksEvent | null = null;
  /** Of the newest plant that has grown to its end. */
  readonly done = new Signal<GrowthEvent | null>(null);
  private newLooks: LooksEvent | null = null;
  private timer = 0;
  private frame = 0;
  private isDone = true;

  constructor(private readonly workspace: Workspace, private readonly watcher: LiveWatcher) {}

  take(frame: Frame): void {
    if (frame.kind === "nothing") return;
    if (frame.kind === "event") {
      this.event(frame.event);
      return;
    }
    this.isDone = false;
    this.growth.take(frame);
    this.soon();
  }

  private event(event: ServerEvent): void {
    switch (event.event) {
      case "hello":
        this.growth.restart();
        this.watcher.hello();
        break;
      case "problems":
        this.workspace.tell(event.version, event.problems);
        break;
      case "project":
        this.watcher.project();
        break;
      case "busy":
        this.watcher.busy(event.stage, event.share);
        break;
      case "scene":
        this.scene.value = event;
        this.watcher.scene(event);
        break;
      case "looks":
        this.newLooks = event;
        this.soon();
        break;
      case "growth":
        this.watcher.growth(event);
        if (event.done) {
          this.isDone = true;
          this.done.value = event;
        }
        this.soon();
        break;
      case "stages":
        this.watcher.stages(event);
        break;
      case "disk":
        this.workspace.disk(event.file, event.text, event.saved);
        break;
      case "end":
        break;
    }
  }

  /** Many frames come at once: they are shown together, at most once a picture. */
  private soon(): void {
    if (this.frame) return;
    this.frame = requestAnimationFrame(() => {
      this.frame = 0;
      this.show();
    });
  }

  private show(): void {
    window.clearTimeout(this.timer);
    const something = this.growth.settle(this.isDone);
    const waits = this.growth.waits_ms;
    if (waits) this.timer = window.setTimeout(() => this.show(), waits);
    // New looks belong to the new plant: while the old one is still shown, it keeps its own.
    const looks = waits ? null : this.newLooks;
    if (looks) {
      this.looks = looks;
      this.newLooks = null;
    }
    if (something || looks) {
      const changes = this.growth.changes();
      this.watcher.grown(looks ? "all" : changes);
    }
  }
}
