// The eye: orbit, pan and zoom by mouse, touch and keys; the scene's own cameras to jump to. Where it stood is kept
// over a reload, and no regrowth moves it.
import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { remembered } from "../base/settings";
import type { SceneCamera, SceneEvent, Vec3 } from "../protocol/types";

interface Stand {
  scene: string;
  eye_m: Vec3;
  target_m: Vec3;
  fov_deg: number;
}

const isStand = (value: unknown): value is Stand =>
  typeof value === "object" && value !== null && Array.isArray((value as Stand).eye_m) && Array.isArray((value as Stand).target_m);

/** Of images, where a scene says nothing else. */
const pictureAspect = 4 / 3;

const still: Stand = { scene: "\u0000", eye_m: [0, 0, 0], target_m: [0, 0, 0], fov_deg: 37 };

export class Eye {
  readonly camera = new THREE.PerspectiveCamera(37, 1, 0.01, 1000);
  readonly controls: OrbitControls;
  private readonly stand = remembered<Stand>("eye", still, isStand);
  private placed = false;
  private size_m = 1;
  private flight = 0;
  private fov_deg = 37;
  private sceneName = "";

  constructor(canvas: HTMLCanvasElement, private readonly changed: () => void) {
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = !window.matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.controls.dampingFactor = 0.14;
    this.controls.zoomToCursor = true;
    this.controls.maxPolarAngle = Math.PI * 0.97;
    this.controls.addEventListener("change", changed);
    this.controls.addEventListener("start", () => this.stop());
    this.controls.addEventListener("end", () => this.remember());
    canvas.addEventListener("keydown", (event) => this.key(event));
  }

  scene(scene: SceneEvent): void {
    const low = new THREE.Vector3(...scene.low_m);
    this.size_m = Math.max(1e-3, low.distanceTo(new THREE.Vector3(...scene.high_m)));
    this.camera.near = this.size_m / 2000;
    this.camera.far = this.size_m * 20;
    this.controls.minDistance = this.size_m / 400;
    this.controls.maxDistance = this.size_m * 6;
    this.camera.updateProjectionMatrix();
    this.sceneName = scene.name;
    if (this.placed) return;
    this.placed = true;
    const kept = this.stand.value;
    if (kept.scene === scene.name) this.place(kept.eye_m, kept.target_m, kept.fov_deg);
    else this.jump(scene.cameras[0] ?? around(scene), false);
  }

  jump(camera: SceneCamera, slowly = true): void {
    if (!slowly || window.matchMedia("(prefers-reduced-motion: reduce)").matches) {
      this.place(camera.eye_m, camera.target_m, camera.fov_deg);
      this.remember();
      return;
    }
    this.fly(camera);
  }

  get here(): { eye_m: Vec3; target_m: Vec3 } {
    return { eye_m: this.camera.position.toArray() as Vec3, target_m: this.controls.target.toArray() as Vec3 };
  }

  resize(width: number, height: number): void {
    this.camera.aspect = width / Math.max(1, height);
    this.widen();
  }

  /** In a view that is narrower than pictures are, as much is seen from side to side as there. */
  private widen(): void {
    const narrow = Math.max(1, pictureAspect / this.camera.aspect);
    this.camera.fov = (360 / Math.PI) * Math.atan(narrow * Math.tan((this.fov_deg * Math.PI) / 360));
    this.camera.updateProjectionMatrix();
  }

  private place(eye_m: Vec3, target_m: Vec3, fov_deg: number): void {
    this.camera.position.set(...eye_m);
    this.controls.target.set(...target_m);
    this.fov_deg = fov_deg;
    this.widen();
    this.controls.update();
    this.changed();
  }

  private fly(to: SceneCamera): void {
    this.stop();
    const { eye_m, target_m } = this.here;
    const fov = this.fov_deg;
    const began = performance.now();
    const step = (now: number): void => {
      const t = Math.min(1, (now - began) / 420);
      const s = t * t * (3 - 2 * t);
      const mix = (a: Vec3, b: Vec3): Vec3 => a.map((each, k) => each + ((b[k] ?? 0) - each) * s) as Vec3;
      this.place(mix(eye_m, to.eye_m), mix(target_m, to.target_m), fov + (to.fov_deg - fov) * s);
      this.flight = t < 1 ? requestAnimationFrame(step) : 0;
      if (t >= 1) this.remember();
    };
    this.flight = requestAnimationFrame(step);
  }

  private stop(): void {
    if (this.flight) cancelAnimationFrame(this.flight);
    this.flight = 0;
  }

  private remember(): void {
    this.stand.value = { scene: this.sceneName, ...this.here, fov_deg: this.fov_deg };
  }

  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const turn = 0.08;
    const spherical = new THREE.Spherical().setFromVector3(this.camera.position.clone().sub(this.controls.target));
    const pan = new THREE.Vector3();
    const step = spherical.radius * 0.05;
    const [right, up] = [new THREE.Vector3(), new THREE.Vector3()];
    this.camera.matrixWorld.extractBasis(right, up, new THREE.Vector3());
    switch (event.key) {
      case "ArrowLeft": if (event.shiftKey) pan.addScaledVector(right, -step); else spherical.theta -= turn; break;
      case "ArrowRight": if (event.shiftKey) pan.addScaledVector(right, step); else spherical.theta += turn; break;
      case "ArrowUp": if (event.shiftKey) pan.addScaledVector(up, step); else spherical.phi -= turn; break;
      case "ArrowDown": if (event.shiftKey) pan.addScaledVector(up, -step); else spherical.phi += turn; break;
      case "+": case "=": spherical.radius *= 0.9; break;
      case "-": spherical.radius /= 0.9; break;
      default: return;
    }
    event.preventDefault();
    this.stop();
    spherical.phi = Math.min(this.controls.maxPolarAngle, Math.max(0.02, spherical.phi));
    this.controls.target.add(pan);
    this.camera.position.setFromSpherical(spherical).add(this.controls.target);
    this.controls.update();
    this.remember();
    this.changed();
  }
}

/** A view of all of it from the front and a little above, where the scene has no camera. */
function around(scene: SceneEvent): SceneCamera {
  const middle = scene.low_m.map((low, k) => (low + (scene.high_m[k] ?? low)) / 2) as Vec3;
  const size = Math.hypot(...scene.low_m.map((low, k) => (scene.high_m[k] ?? low) - low));
  const eye_m: Vec3 = [middle[0] + 0.45 * size, middle[1] + 0.3 * size, middle[2] + 1.05 * size];
  return { name: "", eye_m, target_m: middle, fov_deg: 37 };
}
