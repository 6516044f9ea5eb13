// A cut through the boundary layers, voxel by voxel, as GET /api/layers sends it.
import type { Vec3 } from "./types";

export const axes = ["x", "y", "z"] as const;
export type Axis = (typeof axes)[number];

export interface Layers {
  version: number;
  corner_m: Vec3;
  /** The cut's two sides. */
  across_m: Vec3;
  up_m: Vec3;
  across: number;
  up: number;
  /** How many layers lie around what is occupied. */
  layers: number;
  /** Across first. 0: beyond all layers, 255: occupied. */
  layer: Uint8Array;
}

export function readLayers(data: ArrayBuffer): Layers {
  const bytes = new DataView(data).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, bytes))) as Omit<Layers, "layer">;
  return { ...head, layer: new Uint8Array(data, 4 + bytes, head.across * head.up) };
}
