// A skeleton's limbs: at each fork the thickest child goes on, of equals the straightest, and the others begin limbs of
// their own at the node that they leave.
import type { Skeleton } from "./plants";

export interface Limb {
  /** From the seed, or from the node that it leaves, to its tip. */
  nodes: Int32Array;
  /** Whether the first of them belongs to another limb. */
  side: boolean;
}

export function limbsOf(skeleton: Skeleton): Limb[] {
  const { count, parent, radius } = skeleton;
  const next = new Int32Array(count).fill(-1);
  for (let node = 0; node < count; node++) {
    const from = parent[node] ?? -1;
    if (from < 0) continue;
    const best = next[from] ?? -1;
    if (best < 0 || goesOnBetter(skeleton, node, best, radius)) next[from] = node;
  }
  const limbs: Limb[] = [];
  for (let node = 0; node < count; node++) {
    const from = parent[node] ?? -1;
    if (from >= 0 && next[from] === node) continue;
    const nodes: number[] = from >= 0 ? [from] : [];
    for (let at = node; at >= 0; at = next[at] ?? -1) nodes.push(at);
    if (nodes.length >= 2) limbs.push({ nodes: Int32Array.from(nodes), side: from >= 0 });
  }
  return limbs;
}

function goesOnBetter(skeleton: Skeleton, node: number, best: number, radius: Float32Array): boolean {
  const [mine, its] = [radius[node] ?? 0, radius[best] ?? 0];
  if (Math.abs(mine - its) > 1e-6 * Math.max(mine, its)) return mine > its;
  return straightness(skeleton, node) > straightness(skeleton, best) + 1e-6;
}

/** Cosine between a segment and the one before it. */
function straightness({ parent, position }: Skeleton, node: number): number {
  const at = parent[node] ?? -1;
  const before = at >= 0 ? (parent[at] ?? -1) : -1;
  if (before < 0) return 1;
  const [ax, ay, az] = between(position, before, at);
  const [bx, by, bz] = between(position, at, node);
  return (ax * bx + ay * by + az * bz) / (Math.hypot(ax, ay, az) * Math.hypot(bx, by, bz) || 1);
}

function between(position: Float32Array, from: number, to: number): [number, number, number] {
  const axis = (k: number) => (position[3 * to + k] ?? 0) - (position[3 * from + k] ?? 0);
  return [axis(0), axis(1), axis(2)];
}
