// The picture of the world: everything that is drawn, drawn when something has changed and never else.
import * as THREE from "three";
import type { Generation } from "../growth/plants";
import type { LooksEvent, SceneEvent } from "../protocol/types";
import { Eye } from "./camera";
import { Foliage } from "./foliage";
import { LayerCut } from "./layer_cut";
import { Lights } from "./lights";
import { coloursNumber, plantUniforms, type PlantColours } from "./plant_material";
import { qualityHere } from "./quality";
import { SeedMarkers } from "./seed_markers";
import { Site } from "./site";
import { Stems } from "./stems";
import { SurfaceFaces } from "./surface_faces";
import { Textures } from "./textures";
import { TrialLines } from "./trial_lines";

export interface DrawnCounts {
  triangles: number;
  calls: number;
  frame_ms: number;
  geometries: number;
  textures: number;
}

const rest_ms = 600;
const coarseRatio = 0.55;

export class World {
  readonly renderer: THREE.WebGLRenderer;
  readonly eye: Eye;
  readonly site: Site;
  readonly seeds = new SeedMarkers();
  readonly trials = new TrialLines();
  readonly faces = new SurfaceFaces();
  readonly cut = new LayerCut();
  private readonly scene = new THREE.Scene();
  private readonly quality = qualityHere();
  private readonly lights = new Lights(this.quality.shadow_px);
  private readonly uniforms = plantUniforms();
  private readonly textures = new Textures(() => this.changedScene());
  private readonly stems = new Stems(this.uniforms, this.quality.stems);
  private readonly foliage = new Foliage(this.uniforms, this.textures, this.quality.leaves_triangles);
  private described: SceneEvent | null = null;
  private pending = 0;
  private restTimer = 0;
  private shadowsDue = false;
  private counts: DrawnCounts = { triangles: 0, calls: 0, frame_ms: 0, geometries: 0, textures: 0 };

  constructor(readonly canvas: HTMLCanvasElement, private readonly host: HTMLElement, private readonly drawn: (counts: DrawnCounts) => void, failed: (words: string) => void) {
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: !this.quality.painted, powerPreference: "high-performance" });
    this.renderer.setPixelRatio(this.quality.painted ? coarseRatio : Math.min(2, window.devicePixelRatio));
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = THREE.PCFShadowMap;
    this.renderer.shadowMap.autoUpdate = false;
    this.renderer.toneMapping = THREE.AgXToneMapping;
    this.renderer.toneMappingExposure = 1.25;
    this.eye = new Eye(canvas, () => this.invalidate());
    this.site = new Site(() => this.siteCame(), failed);
    this.scene.add(this.lights.root, this.site.root, this.stems.root, this.foliage.root, this.faces.root, this.cut.root, this.seeds.root, this.trials.root);
    new ResizeObserver(() => this.resize()).observe(host);
    canvas.addEventListener("webglcontextrestored", () => this.changedScene());
    this.resize();
  }

  /** With `moveSeeds` false markers stay where the hand holds them. */
  describe(scene: SceneEvent, moveSeeds: boolean): void {
    this.described = scene;
    this.lights.scene(scene, this.site.box);
    this.uniforms.uSunLight.value.copy(this.lights.sunLight);
    this.eye.scene(scene);
    if (moveSeeds) this.seeds.set(scene.seeds);
    void this.site.show(scene.site);
    this.changedScene();
  }

  grow(shown: Generation, looks: LooksEvent | null, changed: "all" | ReadonlySet<number>): void {
    const plants = looks?.plants ?? [];
    this.stems.update(shown, plants, changed);
    this.foliage.update(shown, plants, this.eye.camera.position);
    this.uniforms.uLast.value = Math.max(1, shown.iteration);
    this.changedScene();
  }

  /** Shows growth as it stood after this iteration; Infinity: as it is. */
  until(iteration: number): void {
    this.uniforms.uUntil.value = Math.min(1e9, iteration);
    this.changedScene();
  }

  colours(colours: PlantColours): void {
    this.uniforms.uColours.value = coloursNumber[colours];
    this.invalidate();
  }

  theme(dark: boolean): void {
    this.lights.theme(dark);
    this.invalidate();
  }

  set plantsShown(shown: boolean) {
    this.stems.root.visible = this.foliage.root.visible = shown;
    this.changedScene();
  }

  set seedsShown(shown: boolean) {
    this.seeds.root.visible = shown;
    this.invalidate();
  }

  /** Shadows too have to be drawn anew: at once, or where that takes long, when nothing has changed for a while. */
  changedScene(): void {
    if (this.quality.painted) this.shadowsDue = true;
    else this.renderer.shadowMap.needsUpdate = true;
    this.invalidate();
  }

  invalidate(): void {
    if (this.quality.painted) this.coarse();
    this.soon();
  }

  private soon(): void {
    if (this.pending === 0) this.pending = requestAnimationFrame(() => this.draw());
  }

  /** Fewer pixels while something moves or grows, all of them and shadows once it rests. */
  private coarse(): void {
    if (this.renderer.getPixelRatio() !== coarseRatio) this.renderer.setPixelRatio(coarseRatio);
    window.clearTimeout(this.restTimer);
    this.restTimer = window.setTimeout(() => {
      this.renderer.setPixelRatio(1);
      if (this.shadowsDue) this.renderer.shadowMap.needsUpdate = true;
      this.shadowsDue = false;
      this.soon();
    }, rest_ms);
  }

  /** How long a picture takes until it is there, for measuring. */
  timeOfPicture_ms(): number {
    const began = performance.now();
    this.draw();
    const gl = this.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    return performance.now() - began;
  }

  /** The view as it is, as a PNG. */
  async picture(): Promise<Blob | null> {
    this.draw();
    return new Promise((resolve) => this.canvas.toBlob(resolve, "image/png"));
  }

  ray(x_px: number, y_px: number): THREE.Raycaster {
    const ray = new THREE.Raycaster();
    const { width, height } = this.size;
    ray.setFromCamera(new THREE.Vector2((2 * x_px) / width - 1, 1 - (2 * y_px) / height), this.eye.camera);
    return ray;
  }

  /** Where a seed is on the page. */
  seedPoint(index: number): { x: number; y: number } | null {
    const seed = this.seeds.seeds[index];
    return seed ? this.onPage(new THREE.Vector3(...seed.at_m)) : null;
  }

  pointOf(shown: Generation, plant: number, node: number): { x: number; y: number } | null {
    const skeleton = shown.skeletons.get(plant);
    return skeleton && node < skeleton.count ? this.onPage(new THREE.Vector3().fromArray(skeleton.position, 3 * node)) : null;
  }

  private onPage(at: THREE.Vector3): { x: number; y: number } {
    const box = this.canvas.getBoundingClientRect();
    at.project(this.eye.camera);
    return { x: box.left + (at.x * 0.5 + 0.5) * box.width, y: box.top + (0.5 - at.y * 0.5) * box.height };
  }

  get size(): { width: number; height: number } {
    return { width: Math.max(1, this.host.clientWidth), height: Math.max(1, this.host.clientHeight) };
  }

  private siteCame(): void {
    if (this.described) this.lights.scene(this.described, this.site.box);
    this.changedScene();
  }

  private resize(): void {
    const { width, height } = this.size;
    this.renderer.setSize(width, height, false);
    this.eye.resize(width, height);
    this.seeds.size(width, height);
    this.invalidate();
  }

  private draw(): void {
    if (this.pending) cancelAnimationFrame(this.pending);
    this.pending = 0;
    const began = performance.now();
    this.eye.controls.update();
    this.foliage.sort(this.eye.camera.position);
    const { camera } = this.eye;
    camera.updateMatrixWorld();
    this.uniforms.uSunView.value.copy(this.lights.way).transformDirection(camera.matrixWorldInverse);
    this.renderer.render(this.scene, camera);
    const { render, memory } = this.renderer.info;
    this.counts = { triangles: render.triangles, calls: render.calls, frame_ms: performance.now() - began, geometries: memory.geometries, textures: memory.textures };
    this.drawn(this.counts);
  }
}
