// What has grown, as frames tell it. A plant of a newer version is gathered beside the one that is shown, and takes its
// place when the first of it has come, so that the view never goes blank between two keystrokes.
import type { ElementsFrame, NodesFrame } from "../protocol/frames";
import { withRoom } from "./arrays";

export class Skeleton {
  count = 0;
  parent = new Int32Array(64);
  position = new Float32Array(192);
  radius = new Float32Array(64);
  born = new Uint16Array(64);
  order = new Uint16Array(64);
  exposure = new Uint8Array(64);

  append(frame: NodesFrame): void {
    const total = frame.first + frame.count;
    const had = Math.min(this.count, frame.first);
    this.parent = withRoom(this.parent, had, total);
    this.position = withRoom(this.position, 3 * had, 3 * total);
    this.radius = withRoom(this.radius, had, Math.max(total, frame.total));
    this.born = withRoom(this.born, had, total);
    this.order = withRoom(this.order, had, total);
    this.exposure = withRoom(this.exposure, had, total);
    this.parent.set(frame.parent, frame.first);
    this.position.set(frame.position, 3 * frame.first);
    this.radius.set(frame.radius, 0);
    this.born.set(frame.born, frame.first);
    this.order.set(frame.order, frame.first);
    this.exposure.set(frame.exposure, frame.first);
    this.count = total;
  }
}

export class Leaves {
  count = 0;
  position = new Float32Array(192);
  scale = new Float32Array(64);
  rotation = new Int16Array(256);
  born = new Uint16Array(64);
  exposure = new Uint8Array(64);

  append(frame: ElementsFrame): void {
    const total = frame.first + frame.count;
    const had = Math.min(this.count, frame.first);
    this.position = withRoom(this.position, 3 * had, 3 * total);
    this.scale = withRoom(this.scale, had, total);
    this.rotation = withRoom(this.rotation, 4 * had, 4 * total);
    this.born = withRoom(this.born, had, total);
    this.exposure = withRoom(this.exposure, had, total);
    this.position.set(frame.position, 3 * frame.first);
    this.scale.set(frame.scale, frame.first);
    this.rotation.set(frame.rotation, 4 * frame.first);
    this.born.set(frame.born, frame.first);
    this.exposure.set(frame.exposure, frame.first);
    this.count = total;
  }
}

/** Plants by their number, leaves by plant and shape. */
export class Generation {
  readonly skeletons = new Map<number, Skeleton>();
  readonly leaves = new Map<number, Map<number, Leaves>>();
  iteration = 0;

  constructor(readonly version: number) {}

  nodes(frame: NodesFrame): void {
    if (frame.first === 0) this.skeletons.set(frame.plant, new Skeleton());
    const skeleton = this.skeletons.get(frame.plant) ?? new Skeleton();
    this.skeletons.set(frame.plant, skeleton);
    skeleton.append(frame);
    this.iteration = Math.max(this.iteration, frame.iteration);
  }

  elements(frame: ElementsFrame): void {
    const shapes = this.leaves.get(frame.plant) ?? new Map<number, Leaves>();
    this.leaves.set(frame.plant, shapes);
    if (frame.first === 0) shapes.set(frame.shape, new Leaves());
    const leaves = shapes.get(frame.shape) ?? new Leaves();
    shapes.set(frame.shape, leaves);
    leaves.append(frame);
    this.iteration = Math.max(this.iteration, frame.iteration);
  }

  get segments(): number {
    let sum = 0;
    for (const skeleton of this.skeletons.values()) sum += Math.max(0, skeleton.count - 1);
    return sum;
  }

  get elementCount(): number {
    let sum = 0;
    for (const shapes of this.leaves.values()) for (const leaves of shapes.values()) sum += leaves.count;
    return sum;
  }
}

/** For so long the old plant stands while a new one is still small; most edits are done by then. */
const hold_ms = 180;

export class Growth {
  shown = new Generation(0);
  private next: Generation | null = null;
  private nextSince_ms = 0;
  private readonly touched = new Set<number>();
  /** Plants that were replaced or grew since they were last asked for; null: all. */
  private all = true;
  private restarting = false;

  constructor(private readonly now_ms: () => number) {}

  /** Everything comes anew: what is shown stays until then. */
  restart(): void {
    this.next = null;
    this.restarting = true;
  }

  take(frame: NodesFrame | ElementsFrame): void {
    const target = this.target(frame.version);
    if (!target) return;
    if (frame.kind === "nodes") target.nodes(frame);
    else target.elements(frame);
    if (target === this.shown) this.touched.add(frame.plant);
  }

  /** True where there is something to show that was not shown before. */
  settle(done: boolean): boolean {
    if (this.next && (done || this.now_ms() - this.nextSince_ms >= hold_ms)) this.swap();
    return this.all || this.touched.size > 0;
  }

  /** How long to wait before asking settle() again; 0 where nothing waits. */
  get waits_ms(): number {
    return this.next ? Math.max(1, hold_ms - (this.now_ms() - this.nextSince_ms)) : 0;
  }

  /** What changed since the last call: "all", or the numbers of plants. */
  changes(): "all" | ReadonlySet<number> {
    const changes = this.all ? ("all" as const) : new Set(this.touched);
    this.all = false;
    this.touched.clear();
    return changes;
  }

  /** Nothing grows any more by what the text says now. */
  clear(version: number): void {
    this.next = null;
    this.shown = new Generation(version);
    this.all = true;
  }

  private target(version: number): Generation | null {
    const newest = this.next?.version ?? this.shown.version;
    if (version < newest) return null;
    if (version > newest || this.restarting) {
      this.restarting = false;
      this.next = new Generation(version);
      this.nextSince_ms = this.now_ms();
    }
    return this.next ?? this.shown;
  }

  private swap(): void {
    if (!this.next) return;
    const next = this.next;
    this.next = null;
    if (next.skeletons.size === 0) {
      // The limbs stand as they were and only leaves came anew.
      for (const [plant, skeleton] of this.shown.skeletons) next.skeletons.set(plant, skeleton);
    }
    this.shown = next;
    this.all = true;
  }
}
