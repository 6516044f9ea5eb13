// A cut through the boundary layers as a pane in the world: a texel for each voxel, the nearest layer the brightest.
import * as THREE from "three";
import type { Layers } from "../protocol/layers";
import { mapColour } from "./palette";

const opaque = 225;
const faint = 26;

/** Of layer 1 to `layers`. */
export const layerShare = (layer: number, layers: number): number => 1 - (layer - 0.5) / Math.max(1, layers);

export class LayerCut {
  readonly root = new THREE.Group();
  private mesh: THREE.Mesh<THREE.BufferGeometry, THREE.MeshBasicMaterial> | null = null;

  show(cut: Layers): void {
    this.clear();
    const corner = new THREE.Vector3(...cut.corner_m);
    const [across, up] = [new THREE.Vector3(...cut.across_m), new THREE.Vector3(...cut.up_m)];
    const corners = [corner, corner.clone().add(across), corner.clone().add(across).add(up), corner.clone().add(up)];
    const geometry = new THREE.BufferGeometry().setFromPoints(corners);
    geometry.setAttribute("uv", new THREE.Float32BufferAttribute([0, 0, 1, 0, 1, 1, 0, 1], 2));
    geometry.setIndex([0, 1, 2, 0, 2, 3]);
    const map = textureOf(cut);
    const material = new THREE.MeshBasicMaterial({ map, transparent: true, side: THREE.DoubleSide, toneMapped: false, depthWrite: false });
    this.mesh = new THREE.Mesh(geometry, material);
    this.mesh.renderOrder = 2;
    this.root.add(this.mesh);
  }

  clear(): void {
    if (!this.mesh) return;
    this.root.remove(this.mesh);
    this.mesh.geometry.dispose();
    this.mesh.material.map?.dispose();
    this.mesh.material.dispose();
    this.mesh = null;
  }
}

function textureOf(cut: Layers): THREE.DataTexture {
  const data = new Uint8Array(4 * cut.across * cut.up);
  cut.layer.forEach((layer, i) => {
    const colour = layer === 255 ? [0.23, 0.22, 0.21] : layer === 0 ? [0.5, 0.5, 0.5] : mapColour(layerShare(layer, cut.layers));
    colour.forEach((c, k) => (data[4 * i + k] = Math.round(255 * c)));
    data[4 * i + 3] = layer === 0 ? faint : opaque;
  });
  const texture = new THREE.DataTexture(data, cut.across, cut.up, THREE.RGBAFormat);
  texture.colorSpace = THREE.SRGBColorSpace;
  texture.needsUpdate = true;
  return texture;
}
