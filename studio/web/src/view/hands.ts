// What the hand does in the view beside turning it: asks a limb why, moves a seed along the surfaces, adds one.
import * as THREE from "three";
import type { Generation } from "../growth/plants";
import type { SceneSeed, Vec3 } from "../protocol/types";
import { pickLimb, pickSeed, type Picked } from "./pick";
import type { World } from "./world";

export interface HandWatcher {
  shown(): Generation;
  until(): number;
  why(picked: Picked): void;
  /** While a seed is moved, and when it is let go. */
  seedAt(seed: SceneSeed, at_m: Vec3): void;
  seedDropped(): void;
  addSeed(at_m: Vec3): void;
  leave(): void;
}

const still_px = 4;

export class Hands {
  /** The marker that is held; -1: none. */
  private held = -1;
  private pressed: { x: number; y: number } | null = null;
  private voxel_m = 0.05;

  constructor(private readonly world: World, private readonly watcher: HandWatcher) {
    const { canvas } = world;
    // Before OrbitControls hears of it: what holds a seed does not turn the view.
    canvas.addEventListener("pointerdown", (event) => this.press(event), true);
    canvas.addEventListener("pointermove", (event) => this.move(event));
    canvas.addEventListener("pointerup", (event) => this.release(event));
    canvas.addEventListener("pointercancel", () => this.drop());
    canvas.addEventListener("keydown", (event) => this.key(event));
  }

  /** How far above a surface a seed stands, so that it is in the open. */
  set voxel(voxel_m: number) {
    this.voxel_m = voxel_m;
  }

  get holdsSeed(): boolean {
    return this.held >= 0;
  }

  private at(event: PointerEvent | MouseEvent): { x: number; y: number } {
    const box = this.world.canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  private press(event: PointerEvent): void {
    if (event.button !== 0) return;
    const { x, y } = (this.pressed = this.at(event));
    const { width, height } = this.world.size;
    const seeds = this.world.seeds;
    const found = seeds.root.visible ? pickSeed(seeds.seeds, this.world.eye.camera, x, y, width, height) : -1;
    if (found < 0) return;
    seeds.select(found);
    this.world.invalidate();
    if (!seeds.seeds[found]?.movable) return;
    this.held = found;
    this.world.eye.controls.enabled = false;
    this.world.canvas.setPointerCapture(event.pointerId);
  }

  private move(event: PointerEvent): void {
    const { x, y } = this.at(event);
    if (this.held < 0) {
      if (event.buttons === 0) this.hover(x, y);
      return;
    }
    const place = this.onSurface(x, y);
    if (place) this.put(this.held, place);
  }

  private put(index: number, place: Vec3): void {
    const seed = this.world.seeds.seeds[index];
    if (!seed) return;
    this.world.seeds.move(index, place);
    this.world.invalidate();
    this.watcher.seedAt(seed, place);
  }

  private release(event: PointerEvent): void {
    const { x, y } = this.at(event);
    const quiet = this.pressed && Math.hypot(x - this.pressed.x, y - this.pressed.y) <= still_px;
    this.pressed = null;
    if (this.held >= 0) {
      this.drop();
      return;
    }
    if (!quiet || event.button !== 0) return;
    if (event.altKey) {
      const place = this.onSurface(x, y);
      if (place) this.watcher.addSeed(place);
      return;
    }
    const picked = this.limbAt(x, y);
    if (picked) this.watcher.why(picked);
    else this.watcher.leave();
  }

  private drop(): void {
    if (this.held < 0) return;
    this.held = -1;
    this.world.eye.controls.enabled = true;
    this.watcher.seedDropped();
  }

  private hover(x: number, y: number): void {
    const { width, height } = this.world.size;
    const seeds = this.world.seeds;
    const onSeed = seeds.root.visible && pickSeed(seeds.seeds, this.world.eye.camera, x, y, width, height) >= 0;
    this.world.canvas.style.cursor = onSeed ? "move" : "";
  }

  limbAt(x: number, y: number): Picked | null {
    const { width, height } = this.world.size;
    const wall = this.world.site.hit(this.world.ray(x, y));
    // A limb lies on the wall that is behind it: a little slack, or it would be behind its own wall.
    const limit = wall ? wall.distance + 4 * this.voxel_m : Infinity;
    return pickLimb(this.watcher.shown(), this.world.eye.camera, x, y, width, height, this.watcher.until(), limit);
  }

  private onSurface(x: number, y: number): Vec3 | null {
    const ray = this.world.ray(x, y);
    const hit = this.world.site.hit(ray);
    if (!hit) return null;
    const normal = (hit.normal ?? hit.face?.normal ?? new THREE.Vector3(0, 1, 0)).clone().transformDirection(hit.object.matrixWorld);
    if (normal.dot(ray.ray.direction) > 0) normal.negate();
    const place = hit.point.addScaledVector(normal, this.voxel_m);
    return place.toArray().map((each) => Math.round(each * 1000) / 1000) as Vec3;
  }

  /** S chooses the next seed; with Shift and Control the arrows move it by a voxel, seen from where one stands. */
  private key(event: KeyboardEvent): void {
    const seeds = this.world.seeds;
    if (event.key === "s" && !event.ctrlKey && !event.metaKey && seeds.seeds.length) {
      seeds.select((seeds.selection + 1) % seeds.seeds.length);
      this.world.invalidate();
      return;
    }
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    const seed = seeds.seeds[seeds.selection];
    if (!step || !(event.ctrlKey || event.metaKey) || !seed?.movable) return;
    event.preventDefault();
    const ways = [new THREE.Vector3(), new THREE.Vector3()];
    this.world.eye.camera.matrixWorld.extractBasis(ways[0] as THREE.Vector3, ways[1] as THREE.Vector3, new THREE.Vector3());
    const place = [...seed.at_m] as Vec3;
    ways.forEach((way, i) => {
      const axis = nearestAxis(i === 1 && event.shiftKey ? new THREE.Vector3(0, 0, -1) : way);
      place[axis.index] += axis.sign * (step[i] ?? 0) * this.voxel_m;
    });
    this.put(seeds.selection, place.map((each) => Math.round(each * 1000) / 1000) as Vec3);
    this.watcher.seedDropped();
  }
}

function nearestAxis(way: THREE.Vector3): { index: 0 | 1 | 2; sign: number } {
  const sizes = way.toArray().map(Math.abs);
  const index = sizes.indexOf(Math.max(...sizes)) as 0 | 1 | 2;
  return { index, sign: Math.sign(way.getComponent(index)) || 1 };
}
