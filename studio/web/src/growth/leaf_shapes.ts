// Leaves for afar: the four corners that a shape reaches farthest along its length and across it, which are two
// triangles in place of many. A shape of two triangles or fewer stays as it is.
import type { LeafShape } from "../protocol/types";

export interface ShapeMesh {
  positions: number[];
  normals: number[];
  uvs: number[];
  indices: number[];
}

export function simplified(shape: LeafShape): ShapeMesh {
  const count = shape.positions.length / 3;
  if (shape.indices.length <= 6 || count < 4) return shape;
  const extreme = (axis: number, sign: number): number => {
    let best = 0;
    for (let i = 1; i < count; i++) {
      if (sign * (shape.positions[3 * i + axis] ?? 0) > sign * (shape.positions[3 * best + axis] ?? 0)) best = i;
    }
    return best;
  };
  const picked = [extreme(1, -1), extreme(0, 1), extreme(1, 1), extreme(0, -1)];
  if (new Set(picked).size < 4) return shape;
  const take = (from: number[], width: number) => picked.flatMap((i) => from.slice(width * i, width * (i + 1)));
  return {
    positions: take(shape.positions, 3),
    normals: shape.normals.length ? take(shape.normals, 3) : [],
    uvs: shape.uvs.length ? take(shape.uvs, 2) : [],
    indices: [0, 1, 2, 0, 2, 3],
  };
}

/** Whether what was drawn for one may be drawn for the other. */
export function shapeKey(shape: LeafShape): string {
  return JSON.stringify([shape.name, shape.texture, shape.opacity, shape.colour, shape.emits, shape.positions.length, shape.positions.slice(0, 24), shape.indices.length]);
}

/** Column-major matrices from places, sizes and turns: 16 numbers a leaf, from `slot` on. */
export function writeMatrices(
  out: Float32Array, slot: number,
  leaves: { count: number; position: Float32Array; scale: Float32Array; rotation: Int16Array },
): void {
  for (let i = 0; i < leaves.count; i++) {
    const x = (leaves.rotation[4 * i] ?? 0) / 32767;
    const y = (leaves.rotation[4 * i + 1] ?? 0) / 32767;
    const z = (leaves.rotation[4 * i + 2] ?? 0) / 32767;
    const w = (leaves.rotation[4 * i + 3] ?? 0) / 32767;
    const s = leaves.scale[i] ?? 0;
    const at = 16 * (slot + i);
    out[at] = (1 - 2 * (y * y + z * z)) * s;
    out[at + 1] = 2 * (x * y + z * w) * s;
    out[at + 2] = 2 * (x * z - y * w) * s;
    out[at + 3] = 0;
    out[at + 4] = 2 * (x * y - z * w) * s;
    out[at + 5] = (1 - 2 * (x * x + z * z)) * s;
    out[at + 6] = 2 * (y * z + x * w) * s;
    out[at + 7] = 0;
    out[at + 8] = 2 * (x * z + y * w) * s;
    out[at + 9] = 2 * (y * z - x * w) * s;
    out[at + 10] = (1 - 2 * (x * x + y * y)) * s;
    out[at + 11] = 0;
    out[at + 12] = leaves.position[3 * i] ?? 0;
    out[at + 13] = leaves.position[3 * i + 1] ?? 0;
    out[at + 14] = leaves.position[3 * i + 2] ?? 0;
    out[at + 15] = 1;
  }
}

/** How near leaves must be to be drawn whole, so that all of them take `budget` triangles at most; Infinity: all are. */
export function wholeWithin(distances: Float32Array, count: number, whole: number, simple: number, budget: number): number {
  if (count * whole <= budget || whole <= simple) return Infinity;
  const most = Math.max(0, Math.floor((budget - count * simple) / (whole - simple)));
  if (most === 0) return 0;
  let [low, high] = [Infinity, 0];
  for (let i = 0; i < count; i++) {
    const distance = distances[i] ?? 0;
    low = Math.min(low, distance);
    high = Math.max(high, distance);
  }
  const bins = new Uint32Array(512);
  const perUnit = (bins.length - 1) / Math.max(high - low, 1e-9);
  for (let i = 0; i < count; i++) {
    const bin = Math.floor(((distances[i] ?? 0) - low) * perUnit);
    bins[bin] = (bins[bin] ?? 0) + 1;
  }
  let sum = 0;
  for (let bin = 0; bin < bins.length; bin++) {
    sum += bins[bin] ?? 0;
    if (sum > most) return low + bin / perUnit;
  }
  return Infinity;
}
