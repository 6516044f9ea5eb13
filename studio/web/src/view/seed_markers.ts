// Seeds as small rings that keep their size on the screen, wherever the camera stands.
import * as THREE from "three";
import type { SceneSeed, Vec3 } from "../protocol/types";

const markerVertex = /* glsl */ `
attribute vec3 aAt;
attribute float aState;
uniform vec2 uPixel;
varying vec2 vCorner;
varying float vState;
void main() {
  vCorner = position.xy;
  vState = aState;
  float radius = aState > 0.5 ? 11.0 : 8.0;
  vec4 at = projectionMatrix * modelViewMatrix * vec4(aAt, 1.0);
  at.xy += position.xy * radius * uPixel * at.w;
  at.z -= 0.0008 * at.w;
  gl_Position = at;
}`;

const markerFragment = /* glsl */ `
varying vec2 vCorner;
varying float vState;
void main() {
  float r = length(vCorner);
  if (r > 1.0) discard;
  vec3 core = vState > 0.5 ? vec3(0.98, 0.74, 0.28) : vec3(0.99, 0.96, 0.88);
  float rim = smoothstep(0.62, 0.7, r);
  gl_FragColor = vec4(mix(core, vec3(0.17, 0.13, 0.08), rim), 1.0 - smoothstep(0.9, 1.0, r));
}`;

export class SeedMarkers {
  readonly root = new THREE.Group();
  seeds: SceneSeed[] = [];
  private selected = -1;
  private readonly geometry = new THREE.InstancedBufferGeometry();
  private readonly material = new THREE.ShaderMaterial({
    vertexShader: markerVertex, fragmentShader: markerFragment, transparent: true, depthWrite: false, toneMapped: false,
    uniforms: { uPixel: { value: new THREE.Vector2(0.001, 0.001) } },
  });

  constructor() {
    this.geometry.setAttribute("position", new THREE.Float32BufferAttribute([-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0], 3));
    this.geometry.setIndex([0, 1, 2, 0, 2, 3]);
    const mesh = new THREE.Mesh(this.geometry, this.material);
    mesh.frustumCulled = false;
    mesh.renderOrder = 20;
    this.root.add(mesh);
    this.write();
  }

  set(seeds: SceneSeed[]): void {
    this.seeds = seeds.map((seed) => ({ ...seed, at_m: [...seed.at_m] as Vec3 }));
    this.selected = Math.min(this.selected, seeds.length - 1);
    this.write();
  }

  select(index: number): void {
    this.selected = index;
    this.write();
  }

  get selection(): number {
    return this.selected;
  }

  move(index: number, at_m: Vec3): void {
    const seed = this.seeds[index];
    if (!seed) return;
    seed.at_m = at_m;
    this.write();
  }

  size(width: number, height: number): void {
    (this.material.uniforms["uPixel"]!.value as THREE.Vector2).set(2 / Math.max(1, width), 2 / Math.max(1, height));
  }

  private write(): void {
    const count = this.seeds.length;
    const had = this.geometry.getAttribute("aAt") as THREE.InstancedBufferAttribute | undefined;
    if (!had || had.count < count) {
      this.geometry.dispose();
      this.geometry.setAttribute("aAt", new THREE.InstancedBufferAttribute(new Float32Array(3 * Math.max(8, 2 * count)), 3));
      this.geometry.setAttribute("aState", new THREE.InstancedBufferAttribute(new Float32Array(Math.max(8, 2 * count)), 1));
    }
    const at = this.geometry.getAttribute("aAt") as THREE.InstancedBufferAttribute;
    const state = this.geometry.getAttribute("aState") as THREE.InstancedBufferAttribute;
    this.seeds.forEach((seed, i) => {
      at.setXYZ(i, ...seed.at_m);
      state.setX(i, i === this.selected ? 1 : 0);
    });
    at.needsUpdate = state.needsUpdate = true;
    this.geometry.instanceCount = count;
  }
}
