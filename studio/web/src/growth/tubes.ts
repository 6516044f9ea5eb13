// Tubes around limbs: rings of vertices along each, turned from one to the next by parallel transport (the frame is
// turned by the least rotation that brings one tangent onto the next), so that no tube twists. Thick limbs have more
// sides. All plants of one look become one mesh, which is one call to draw them.
//
// Each vertex carries when it was born, so that the view can show any iteration without another mesh; between two rings
// that rises evenly, which lets limbs grow smoothly.
import { limbsOf, type Limb } from "./limbs";
import type { Skeleton } from "./plants";

export interface TubeMesh {
  position: Float32Array;
  normal: Float32Array;
  /** Iteration, radius in metres, exposure (0..1), position along the limb in metres: four a vertex. */
  data: Float32Array;
  index: Uint32Array;
  triangles: number;
}

export interface TubeOptions {
  /** Radii below a third of it get the fewest sides, from three times it on the most. */
  middleRadius_m: number;
  leastSides: number;
  mostSides: number;
  /** Rings between two nodes: 1 are straight pieces, 2 and more a curve through the nodes. */
  pieces: number;
}

export function buildTubes(skeletons: Iterable<Skeleton>, options: TubeOptions): TubeMesh {
  const work: { skeleton: Skeleton; limb: Limb; sides: number }[] = [];
  let [vertices, indices] = [0, 0];
  for (const skeleton of skeletons) {
    for (const limb of limbsOf(skeleton)) {
      const sides = sidesOf(skeleton, limb, options);
      const rings = (limb.nodes.length - 1) * options.pieces + 1;
      vertices += rings * sides + 1;
      indices += ((rings - 1) * 2 * sides + sides) * 3;
      work.push({ skeleton, limb, sides });
    }
  }
  const mesh: TubeMesh = {
    position: new Float32Array(3 * vertices),
    normal: new Float32Array(3 * vertices),
    data: new Float32Array(4 * vertices),
    index: new Uint32Array(indices),
    triangles: indices / 3,
  };
  const writer = new Writer(mesh);
  for (const { skeleton, limb, sides } of work) writer.limb(skeleton, limb, sides, options.pieces);
  return mesh;
}

function sidesOf(skeleton: Skeleton, limb: Limb, options: TubeOptions): number {
  const radius = skeleton.radius[limb.nodes[1] ?? 0] ?? 0;
  const share = Math.log(Math.max(radius, 1e-9) / options.middleRadius_m) / (2 * Math.log(3)) + 0.5;
  const spread = options.mostSides - options.leastSides;
  return Math.round(options.leastSides + spread * Math.min(1, Math.max(0, share)));
}

type V = [number, number, number];

class Writer {
  private vertex = 0;
  private slot = 0;

  constructor(private readonly mesh: TubeMesh) {}

  limb(skeleton: Skeleton, limb: Limb, sides: number, pieces: number): void {
    const { nodes } = limb;
    const points: V[] = [];
    const radii: number[] = [];
    const births: number[] = [];
    const lights: number[] = [];
    const last = nodes.length - 1;
    const place = (i: number): V => placeOf(skeleton, nodes[Math.min(last, Math.max(0, i))] ?? 0);
    // A side limb starts in the middle of the one that it leaves, as thick as it is itself there.
    const radiusAt = (i: number): number => skeleton.radius[nodes[i === 0 ? 1 : i] ?? 0] ?? 0;
    const bornAt = (i: number): number => skeleton.born[nodes[i === 0 && limb.side ? 1 : i] ?? 0] ?? 0;
    const lightAt = (i: number): number => lightOf(skeleton, nodes[i === 0 && limb.side ? 1 : i] ?? 0);
    for (let i = 0; i < last; i++) {
      const [p0, p1, p2, p3] = [place(i - 1), place(i), place(i + 1), place(i + 2)];
      for (let piece = 0; piece < pieces; piece++) {
        const t = piece / pieces;
        points.push(pieces === 1 ? p1 : throughPoints(p0, p1, p2, p3, t));
        radii.push(radiusAt(i) * (1 - t) + radiusAt(i + 1) * t);
        // The segment to a node grows during that node's iteration.
        births.push(bornAt(i) * (1 - t) + bornAt(i + 1) * t);
        lights.push(t < 0.5 ? lightAt(i) : lightAt(i + 1));
      }
    }
    points.push(place(last));
    radii.push(radiusAt(last) * 0.55);
    births.push(bornAt(last));
    lights.push(lightAt(last));
    this.rings(points, radii, births, lights, sides);
  }

  private rings(points: V[], radii: number[], births: number[], lights: number[], sides: number): void {
    const firstVertex = this.vertex;
    let tangent = direction(points[0] as V, points[1] as V);
    let across = anyAcross(tangent);
    let along = 0;
    for (let ring = 0; ring < points.length; ring++) {
      const point = points[ring] as V;
      const before = points[Math.max(0, ring - 1)] as V;
      const after = points[Math.min(points.length - 1, ring + 1)] as V;
      const next = direction(before, after);
      across = transported(across, tangent, next);
      tangent = next;
      along += Math.hypot(point[0] - before[0], point[1] - before[1], point[2] - before[2]);
      const other = cross(tangent, across);
      const data: [number, number, number, number] = [births[ring] ?? 0, radii[ring] ?? 0, lights[ring] ?? 1, along];
      for (let side = 0; side < sides; side++) {
        const angle = (2 * Math.PI * side) / sides;
        const [c, s] = [Math.cos(angle), Math.sin(angle)];
        const normal: V = [across[0] * c + other[0] * s, across[1] * c + other[1] * s, across[2] * c + other[2] * s];
        this.put(point, normal, radii[ring] ?? 0, data);
      }
      if (ring > 0) this.band(firstVertex + (ring - 1) * sides, firstVertex + ring * sides, sides);
    }
    const tip = points[points.length - 1] as V;
    const tipRadius = radii[radii.length - 1] ?? 0;
    const apex: V = [tip[0] + tangent[0] * tipRadius * 1.4, tip[1] + tangent[1] * tipRadius * 1.4, tip[2] + tangent[2] * tipRadius * 1.4];
    this.put(apex, tangent, 0, [births[births.length - 1] ?? 0, tipRadius, lights[lights.length - 1] ?? 1, along]);
    this.cap(this.vertex - 1 - sides, this.vertex - 1, sides);
  }

  private put(point: V, normal: V, radius: number, data: [number, number, number, number]): void {
    const at = 3 * this.vertex;
    for (let k = 0; k < 3; k++) {
      this.mesh.position[at + k] = (point[k] ?? 0) + radius * (normal[k] ?? 0);
      this.mesh.normal[at + k] = normal[k] ?? 0;
    }
    this.mesh.data.set(data, 4 * this.vertex);
    this.vertex += 1;
  }

  private band(low: number, high: number, sides: number): void {
    for (let side = 0; side < sides; side++) {
      const turn = (side + 1) % sides;
      this.triangle(low + side, low + turn, high + side);
      this.triangle(low + turn, high + turn, high + side);
    }
  }

  private cap(ring: number, apex: number, sides: number): void {
    for (let side = 0; side < sides; side++) this.triangle(ring + side, ring + ((side + 1) % sides), apex);
  }

  private triangle(a: number, b: number, c: number): void {
    this.mesh.index[this.slot++] = a;
    this.mesh.index[this.slot++] = b;
    this.mesh.index[this.slot++] = c;
  }
}

const placeOf = (skeleton: Skeleton, node: number): V => [
  skeleton.position[3 * node] ?? 0,
  skeleton.position[3 * node + 1] ?? 0,
  skeleton.position[3 * node + 2] ?? 0,
];

function lightOf(skeleton: Skeleton, node: number): number {
  const byte = skeleton.exposure[node] ?? 255;
  return byte / 255;
}

/** Catmull and Rom's cubic through p1 and p2. */
function throughPoints(p0: V, p1: V, p2: V, p3: V, t: number): V {
  const axis = (k: 0 | 1 | 2) =>
    0.5 * (2 * p1[k] + (p2[k] - p0[k]) * t + (2 * p0[k] - 5 * p1[k] + 4 * p2[k] - p3[k]) * t * t + (3 * p1[k] - p0[k] - 3 * p2[k] + p3[k]) * t * t * t);
  return [axis(0), axis(1), axis(2)];
}

function direction(from: V, to: V): V {
  const [x, y, z] = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
  const length = Math.hypot(x, y, z);
  return length > 1e-12 ? [x / length, y / length, z / length] : [0, 1, 0];
}

const cross = (a: V, b: V): V => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const dot = (a: V, b: V): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

function anyAcross(tangent: V): V {
  const [x, y, z] = tangent.map(Math.abs) as V;
  const axis: V = x <= y && x <= z ? [1, 0, 0] : y <= z ? [0, 1, 0] : [0, 0, 1];
  return direction([0, 0, 0], cross(tangent, axis));
}

/** `across` after the least rotation that turns one tangent onto the next, made square to it again. */
export function transported(across: V, from: V, to: V): V {
  const axis = cross(from, to);
  const cosine = dot(from, to);
  let turned = across;
  if (cosine > -0.999999) {
    // Rodrigues' formula with the half-angle's denominator, which is steady near 0 degrees.
    const c = cross(axis, across);
    const d = dot(axis, across) / (1 + cosine);
    turned = [across[0] * cosine + c[0] + axis[0] * d, across[1] * cosine + c[1] + axis[1] * d, across[2] * cosine + c[2] + axis[2] * d];
  }
  const off = dot(turned, to);
  const square: V = [turned[0] - to[0] * off, turned[1] - to[1] * off, turned[2] - to[2] * off];
  return Math.hypot(...square) > 1e-6 ? direction([0, 0, 0], square) : anyAcross(to);
}
