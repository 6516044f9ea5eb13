// The stems of all plants, one mesh for each look, made anew where a plant of it has grown.
import * as THREE from "three";
import type { Generation, Skeleton } from "../growth/plants";
import { buildTubes, type TubeOptions } from "../growth/tubes";
import type { PlantLooks } from "../protocol/types";
import { plantMaterials, type PlantMaterials, type PlantUniforms } from "./plant_material";

interface Group {
  mesh: THREE.Mesh<THREE.BufferGeometry, THREE.MeshStandardMaterial>;
  materials: PlantMaterials;
}

export class Stems {
  readonly root = new THREE.Group();
  private readonly groups = new Map<string, Group>();

  /** `fineness` 1 is as fine as it comes. */
  constructor(private readonly uniforms: PlantUniforms, private readonly fineness: number) {}

  update(shown: Generation, looks: PlantLooks[], changed: "all" | ReadonlySet<number>): void {
    const wanted = new Map<string, { look: PlantLooks; plants: number[] }>();
    for (const plant of shown.skeletons.keys()) {
      const look = looks[plant] ?? looks[0];
      if (!look) continue;
      const key = JSON.stringify(look.stem);
      const entry = wanted.get(key) ?? { look, plants: [] };
      wanted.set(key, entry);
      entry.plants.push(plant);
    }
    for (const [key, group] of this.groups) if (!wanted.has(key)) this.drop(key, group);
    const options = optionsFor(shown, this.fineness);
    for (const [key, { look, plants }] of wanted) {
      const group = this.groups.get(key) ?? this.add(key, look);
      if (changed === "all" || plants.some((plant) => changed.has(plant)) || !group.mesh.geometry.index) {
        const skeletons = plants.map((plant) => shown.skeletons.get(plant)).filter((each): each is Skeleton => !!each);
        group.mesh.geometry.dispose();
        group.mesh.geometry = geometryOf(skeletons, options);
      }
    }
  }

  private add(key: string, look: PlantLooks): Group {
    const { stem } = look;
    const materials = plantMaterials("stem", {
      colour: new THREE.Color(...stem.colour), shoot: new THREE.Color(...(stem.shoot_colour ?? stem.colour)),
      emits: stem.emits ? new THREE.Color(...stem.emits) : null, opacity: stem.opacity ?? 1, map: null,
    }, this.uniforms);
    const mesh = new THREE.Mesh(new THREE.BufferGeometry(), materials.surface);
    mesh.customDepthMaterial = materials.depth;
    mesh.castShadow = mesh.receiveShadow = true;
    mesh.frustumCulled = false;
    this.root.add(mesh);
    const group = { mesh, materials };
    this.groups.set(key, group);
    return group;
  }

  private drop(key: string, group: Group): void {
    this.root.remove(group.mesh);
    group.mesh.geometry.dispose();
    group.materials.surface.dispose();
    group.materials.depth.dispose();
    this.groups.delete(key);
  }
}

function geometryOf(skeletons: Skeleton[], options: TubeOptions): THREE.BufferGeometry {
  const tubes = buildTubes(skeletons, options);
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(tubes.position, 3));
  geometry.setAttribute("normal", new THREE.BufferAttribute(tubes.normal, 3));
  geometry.setAttribute("aData", new THREE.BufferAttribute(tubes.data, 4));
  geometry.setIndex(new THREE.BufferAttribute(tubes.index, 1));
  return geometry;
}

/** The more there is of a plant, the fewer sides each limb gets: about half a million triangles at most. */
function optionsFor(shown: Generation, fineness: number): TubeOptions {
  const segments = shown.segments / fineness;
  let [thick, thin] = [0, Infinity];
  for (const skeleton of shown.skeletons.values()) {
    for (let i = 1; i < skeleton.count; i += 7) {
      thick = Math.max(thick, skeleton.radius[i] ?? 0);
      thin = Math.min(thin, skeleton.radius[i] ?? Infinity);
    }
  }
  const middleRadius_m = Math.sqrt(Math.max(thick, 1e-6) * Math.max(Math.min(thin, thick), 1e-6)) || 1e-3;
  if (segments < 12000) return { middleRadius_m, leastSides: 5, mostSides: 12, pieces: 3 };
  if (segments < 40000) return { middleRadius_m, leastSides: 4, mostSides: 10, pieces: 2 };
  return { middleRadius_m, leastSides: 3, mostSides: 8, pieces: 1 };
}
