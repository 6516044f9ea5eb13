// Leaves and whatever else rules place: each kind of element is drawn with at most two calls, one for those near the
// camera, with all their corners, and one for those afar, with four. Which is which follows from a budget of triangles.
import * as THREE from "three";
import { shapeKey, simplified, wholeWithin, writeMatrices, type ShapeMesh } from "../growth/leaf_shapes";
import type { Generation, Leaves } from "../growth/plants";
import type { LeafShape, PlantLooks } from "../protocol/types";
import { plantMaterials, type PlantMaterials, type PlantUniforms } from "./plant_material";
import type { Textures } from "./textures";

interface Kind {
  materials: PlantMaterials;
  near: THREE.InstancedMesh;
  far: THREE.InstancedMesh | null;
  trianglesNear: number;
  trianglesFar: number;
  count: number;
  matrices: Float32Array;
  data: Float32Array;
  texture: string | null;
}

export class Foliage {
  readonly root = new THREE.Group();
  private readonly kinds = new Map<string, Kind>();
  private sortedFrom = new THREE.Vector3(NaN, 0, 0);

  constructor(private readonly uniforms: PlantUniforms, private readonly textures: Textures, private readonly budget_triangles: number) {}

  update(shown: Generation, looks: PlantLooks[], eye: THREE.Vector3): void {
    const wanted = new Map<string, { shape: LeafShape; sources: Leaves[]; count: number }>();
    for (const [plant, shapes] of shown.leaves) {
      for (const [index, leaves] of shapes) {
        const shape = shapesOf(looks, plant)[index];
        if (!shape || leaves.count === 0) continue;
        const key = shapeKey(shape);
        const entry = wanted.get(key) ?? { shape, sources: [], count: 0 };
        wanted.set(key, entry);
        entry.sources.push(leaves);
        entry.count += leaves.count;
      }
    }
    for (const [key, kind] of this.kinds) if (!wanted.has(key)) this.drop(key, kind);
    for (const [key, { shape, sources, count }] of wanted) this.gather(this.kinds.get(key) ?? this.add(key, shape), sources, count);
    this.sort(eye, true);
  }

  /** Deals leaves to near and far anew where the camera has moved enough; true where something changed. */
  sort(eye: THREE.Vector3, always = false): boolean {
    const kinds = [...this.kinds.values()];
    const all = kinds.reduce((sum, kind) => sum + kind.count * kind.trianglesNear, 0);
    if (!always && all <= this.budget_triangles) return false;
    if (!always && this.sortedFrom.distanceTo(eye) < 0.05 * eye.length() + 0.02) return false;
    this.sortedFrom.copy(eye);
    for (const kind of kinds) deal(kind, eye, (this.budget_triangles * kind.count * kind.trianglesNear) / Math.max(all, 1));
    return true;
  }

  private add(key: string, shape: LeafShape): Kind {
    const colour = new THREE.Color(...shape.colour);
    const materials = plantMaterials("leaf", {
      colour, shoot: colour, emits: shape.emits ? new THREE.Color(...shape.emits) : null,
      opacity: shape.opacity ?? 1, map: shape.texture ? this.textures.take(shape.texture) : null,
    }, this.uniforms);
    const simple = simplified(shape);
    const kind: Kind = {
      materials, near: this.mesh(shape, materials), far: simple === shape ? null : this.mesh(simple, materials),
      trianglesNear: shape.indices.length / 3, trianglesFar: simple.indices.length / 3,
      count: 0, matrices: new Float32Array(0), data: new Float32Array(0), texture: shape.texture,
    };
    this.kinds.set(key, kind);
    return kind;
  }

  private mesh(shape: ShapeMesh, materials: PlantMaterials): THREE.InstancedMesh {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(shape.positions, 3));
    if (shape.uvs.length) geometry.setAttribute("uv", new THREE.Float32BufferAttribute(shape.uvs, 2));
    geometry.setIndex(shape.indices);
    if (shape.normals.length) geometry.setAttribute("normal", new THREE.Float32BufferAttribute(shape.normals, 3));
    else geometry.computeVertexNormals();
    geometry.setAttribute("aData", new THREE.InstancedBufferAttribute(new Float32Array(2), 2));
    const mesh = new THREE.InstancedMesh(geometry, materials.surface, 1);
    mesh.count = 0;
    mesh.customDepthMaterial = materials.depth;
    mesh.castShadow = mesh.receiveShadow = true;
    mesh.frustumCulled = false;
    this.root.add(mesh);
    return mesh;
  }

  private gather(kind: Kind, sources: Leaves[], count: number): void {
    if (kind.matrices.length < 16 * count) {
      const room = Math.ceil(count * 1.25);
      kind.matrices = new Float32Array(16 * room);
      kind.data = new Float32Array(2 * room);
    }
    kind.count = count;
    let slot = 0;
    for (const leaves of sources) {
      writeMatrices(kind.matrices, slot, leaves);
      for (let i = 0; i < leaves.count; i++) {
        kind.data[2 * (slot + i)] = leaves.born[i] ?? 0;
        kind.data[2 * (slot + i) + 1] = (leaves.exposure[i] ?? 255) / 255;
      }
      slot += leaves.count;
    }
  }

  private drop(key: string, kind: Kind): void {
    for (const mesh of [kind.near, kind.far]) {
      if (!mesh) continue;
      this.root.remove(mesh);
      mesh.geometry.dispose();
      mesh.dispose();
    }
    kind.materials.surface.dispose();
    kind.materials.depth.dispose();
    if (kind.texture) this.textures.giveBack(kind.texture);
    this.kinds.delete(key);
  }
}

/** A plant without shapes of its own has those of the plant before it. */
function shapesOf(looks: PlantLooks[], plant: number): LeafShape[] {
  for (let i = plant; i >= 0; i--) {
    const shapes = looks[i]?.shapes;
    if (shapes) return shapes;
  }
  return [];
}

function deal(kind: Kind, eye: THREE.Vector3, budget: number): void {
  const { count, matrices } = kind;
  let within = Infinity;
  const distances = new Float32Array(kind.far ? count : 0);
  if (kind.far) {
    for (let i = 0; i < count; i++) {
      distances[i] = Math.hypot((matrices[16 * i + 12] ?? 0) - eye.x, (matrices[16 * i + 13] ?? 0) - eye.y, (matrices[16 * i + 14] ?? 0) - eye.z);
    }
    within = wholeWithin(distances, count, kind.trianglesNear, kind.trianglesFar, budget);
  }
  const near: number[] = [];
  const far: number[] = [];
  if (within !== Infinity) for (let i = 0; i < count; i++) ((distances[i] ?? 0) < within ? near : far).push(i);
  fill(kind.near, kind, within === Infinity ? null : near);
  if (kind.far) fill(kind.far, kind, far);
}

/** Writes these leaves into a mesh, or all of them. Room doubles, so that growth does not make new buffers each time. */
function fill(mesh: THREE.InstancedMesh, kind: Kind, picked: number[] | null): void {
  const count = picked ? picked.length : kind.count;
  if (mesh.instanceMatrix.count < count) {
    const room = Math.max(count, 2 * mesh.instanceMatrix.count);
    mesh.dispose();
    mesh.instanceMatrix = new THREE.InstancedBufferAttribute(new Float32Array(16 * room), 16);
    // A geometry's buffers go when it is disposed of; it makes them again when it is drawn next.
    mesh.geometry.dispose();
    mesh.geometry.setAttribute("aData", new THREE.InstancedBufferAttribute(new Float32Array(2 * room), 2));
  }
  const matrices = mesh.instanceMatrix.array as Float32Array;
  const attribute = mesh.geometry.getAttribute("aData") as THREE.InstancedBufferAttribute;
  const data = attribute.array as Float32Array;
  if (!picked) {
    matrices.set(kind.matrices.subarray(0, 16 * count));
    data.set(kind.data.subarray(0, 2 * count));
  } else {
    picked.forEach((from, to) => {
      matrices.set(kind.matrices.subarray(16 * from, 16 * from + 16), 16 * to);
      data.set(kind.data.subarray(2 * from, 2 * from + 2), 2 * to);
    });
  }
  mesh.count = count;
  mesh.instanceMatrix.needsUpdate = true;
  attribute.needsUpdate = true;
}
