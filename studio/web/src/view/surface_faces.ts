// What is measured on the site's surfaces, drawn as the open faces of its voxels: one call, a square for each face,
// coloured by the map. Faces of which nothing is known are left out.
import * as THREE from "three";
import type { Surfaces } from "../protocol/surfaces";
import { mapTexture } from "./palette";

const vertexShader = /* glsl */ `
attribute vec3 aVoxel;
attribute vec2 aFace;
uniform vec3 uLow;
uniform float uVoxel;
varying float vShare;
varying float vShade;
void main() {
  float axis = floor(aFace.x * 0.5);
  float sign = mod(aFace.x, 2.0) < 0.5 ? -1.0 : 1.0;
  vec2 p = position.xy;
  vec3 corner = axis < 0.5 ? vec3(0.503 * sign, p.x * sign, p.y)
              : axis < 1.5 ? vec3(p.y * sign, 0.503 * sign, p.x)
                           : vec3(p.x * sign, p.y, 0.503 * sign);
  vShare = aFace.y;
  vShade = axis > 0.5 && axis < 1.5 ? (sign > 0.0 ? 1.0 : 0.72) : axis < 0.5 ? 0.9 : 0.95;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(uLow + (aVoxel + corner) * uVoxel, 1.0);
}`;

const fragmentShader = /* glsl */ `
uniform sampler2D uMap;
uniform float uCut;
varying float vShare;
varying float vShade;
void main() {
  vec3 colour = texture2D(uMap, vec2(vShare * 0.996 + 0.002, 0.5)).rgb;
  if (uCut >= 0.0) colour = vShare >= uCut ? vec3(0.36, 0.56, 0.16) : vec3(0.16, 0.13, 0.17);
  gl_FragColor = vec4(colour * vShade, 1.0);
  #include <colorspace_fragment>
}`;

export class SurfaceFaces {
  readonly root = new THREE.Group();
  private mesh: THREE.Mesh<THREE.InstancedBufferGeometry, THREE.ShaderMaterial> | null = null;
  private readonly map = mapTexture();

  /** `cut` is a share of the channel's span: with it, what reaches it is told from what does not. */
  show(surfaces: Surfaces, channelName: string, cut: number | null): void {
    this.clear();
    const channel = surfaces.channels.find((each) => each.name === channelName);
    if (!channel) return;
    let faces = 0;
    for (let i = 0; i < surfaces.count; i++) if (channel.values[i] !== 255) faces += bits(surfaces.faces[i] ?? 0);
    const voxel = new Float32Array(3 * faces);
    const face = new Float32Array(2 * faces);
    let slot = 0;
    for (let i = 0; i < surfaces.count; i++) {
      const value = channel.values[i] ?? 255;
      if (value === 255) continue;
      for (let side = 0; side < 6; side++) {
        if (!((surfaces.faces[i] ?? 0) & (1 << side))) continue;
        for (let k = 0; k < 3; k++) voxel[3 * slot + k] = surfaces.voxels[3 * i + k] ?? 0;
        face[2 * slot] = side;
        face[2 * slot + 1] = value / 254;
        slot += 1;
      }
    }
    const geometry = new THREE.InstancedBufferGeometry();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute([-0.5, -0.5, 0, 0.5, -0.5, 0, 0.5, 0.5, 0, -0.5, 0.5, 0], 3));
    geometry.setIndex([0, 1, 2, 0, 2, 3]);
    geometry.setAttribute("aVoxel", new THREE.InstancedBufferAttribute(voxel, 3));
    geometry.setAttribute("aFace", new THREE.InstancedBufferAttribute(face, 2));
    geometry.instanceCount = faces;
    const material = new THREE.ShaderMaterial({
      vertexShader, fragmentShader, side: THREE.DoubleSide, toneMapped: false,
      uniforms: {
        uLow: { value: new THREE.Vector3(...surfaces.low_m) }, uVoxel: { value: surfaces.voxel_m },
        uMap: { value: this.map }, uCut: { value: cut ?? -1 },
      },
    });
    this.mesh = new THREE.Mesh(geometry, material);
    this.mesh.frustumCulled = false;
    this.root.add(this.mesh);
  }

  set cut(cut: number | null) {
    if (this.mesh) this.mesh.material.uniforms["uCut"]!.value = cut ?? -1;
  }

  clear(): void {
    if (!this.mesh) return;
    this.root.remove(this.mesh);
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
    this.mesh = null;
  }
}

function bits(byte: number): number {
  let sum = 0;
  for (let b = byte; b; b >>= 1) sum += b & 1;
  return sum;
}
