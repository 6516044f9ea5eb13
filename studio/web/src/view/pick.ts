// What lies under the pointer: the nearest limb on the screen, or a seed. All is projected on the processor, which takes
// a millisecond or two for a hundred thousand nodes and needs no second picture.
import * as THREE from "three";
import type { Generation } from "../growth/plants";
import type { SceneSeed } from "../protocol/types";

export interface Picked {
  plant: number;
  node: number;
}

const reach_px = 11;

/** Nodes that are born later than `until` are not there. Nearer than `limit_m` only: what a wall hides is not picked. */
export function pickLimb(shown: Generation, camera: THREE.PerspectiveCamera, x_px: number, y_px: number, width: number, height: number, until: number, limit_m: number): Picked | null {
  const matrix = new THREE.Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse).elements;
  let best: Picked | null = null;
  let bestCost = Infinity;
  for (const [plant, skeleton] of shown.skeletons) {
    const { count, position, parent, born } = skeleton;
    const screen = new Float32Array(3 * count);
    for (let i = 0; i < count; i++) {
      const [px, py, pz] = [position[3 * i] ?? 0, position[3 * i + 1] ?? 0, position[3 * i + 2] ?? 0];
      const w = (matrix[3] ?? 0) * px + (matrix[7] ?? 0) * py + (matrix[11] ?? 0) * pz + (matrix[15] ?? 0);
      screen[3 * i] = ((((matrix[0] ?? 0) * px + (matrix[4] ?? 0) * py + (matrix[8] ?? 0) * pz + (matrix[12] ?? 0)) / w) * 0.5 + 0.5) * width;
      screen[3 * i + 1] = (0.5 - (((matrix[1] ?? 0) * px + (matrix[5] ?? 0) * py + (matrix[9] ?? 0) * pz + (matrix[13] ?? 0)) / w) * 0.5) * height;
      screen[3 * i + 2] = w;
    }
    for (let i = 0; i < count; i++) {
      const from = parent[i] ?? -1;
      if (from < 0 || (born[i] ?? 0) > until) continue;
      const [wa, wb] = [screen[3 * from + 2] ?? 0, screen[3 * i + 2] ?? 0];
      if (wa <= 0 || wb <= 0 || wb > limit_m) continue;
      const [ax, ay] = [screen[3 * from] ?? 0, screen[3 * from + 1] ?? 0];
      const [bx, by] = [screen[3 * i] ?? 0, screen[3 * i + 1] ?? 0];
      const [dx, dy] = [bx - ax, by - ay];
      const along = Math.min(1, Math.max(0, ((x_px - ax) * dx + (y_px - ay) * dy) / (dx * dx + dy * dy || 1)));
      const off = Math.hypot(ax + along * dx - x_px, ay + along * dy - y_px);
      if (off > reach_px) continue;
      const distance = wa + along * (wb - wa);
      const cost = off / reach_px + distance / (limit_m === Infinity ? 1e4 : limit_m);
      if (cost < bestCost) {
        bestCost = cost;
        best = { plant, node: along < 0.5 ? from : i };
      }
    }
  }
  return best;
}

export function pickSeed(seeds: SceneSeed[], camera: THREE.Camera, x_px: number, y_px: number, width: number, height: number): number {
  const at = new THREE.Vector3();
  let [best, nearest] = [-1, 13];
  seeds.forEach((seed, i) => {
    at.set(...seed.at_m).project(camera);
    if (at.z > 1) return;
    const off = Math.hypot((at.x * 0.5 + 0.5) * width - x_px, (0.5 - at.y * 0.5) * height - y_px);
    if (off < nearest) [best, nearest] = [i, off];
  });
  return best;
}
