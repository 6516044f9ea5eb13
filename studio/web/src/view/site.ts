// The scene's own meshes, as GET /api/site/ID.glb gives them. The old ones stay until the new ones have come.
import * as THREE from "three";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";

export class Site {
  readonly root = new THREE.Group();
  readonly box = new THREE.Box3();
  private id = "";
  private wanted = "";
  private current: THREE.Object3D | null = null;
  private readonly loader: GLTFLoader;

  constructor(private readonly changed: () => void, private readonly failed: (words: string) => void) {
    this.loader = new GLTFLoader();
    // Pictures inside of a file come through <img>: the page's policy lets it read pictures from blobs, but not fetch them.
    this.loader.register((parser) => {
      parser.textureLoader = new THREE.TextureLoader(parser.options.manager);
      return { name: "espalier_pictures" };
    });
  }

  async show(id: string): Promise<void> {
    if (id === this.wanted) return;
    this.wanted = id;
    try {
      const model = await this.loader.loadAsync(`/api/site/${id}.glb`);
      if (this.wanted !== id) {
        release(model.scene);
        return;
      }
      this.replace(model.scene);
      this.id = id;
      this.changed();
    } catch (error) {
      if (this.wanted !== id) return;
      this.wanted = this.id;
      this.failed(error instanceof Error ? error.message : String(error));
    }
  }

  /** Where a ray meets a surface first. */
  hit(ray: THREE.Raycaster): THREE.Intersection | null {
    return ray.intersectObject(this.root, true)[0] ?? null;
  }

  private replace(next: THREE.Object3D): void {
    if (this.current) {
      this.root.remove(this.current);
      release(this.current);
    }
    next.traverse((object) => {
      if (!(object instanceof THREE.Mesh)) return;
      object.castShadow = object.receiveShadow = true;
      const materials = [object.material].flat() as THREE.Material[];
      for (const material of materials) {
        // What is behind a face seen edge-on must not shade it: depth comes from the back of what is closed.
        material.shadowSide = THREE.DoubleSide;
        material.polygonOffset = true;
        material.polygonOffsetFactor = 1;
        material.polygonOffsetUnits = 1;
      }
    });
    this.current = next;
    this.root.add(next);
    this.box.setFromObject(next);
  }
}

export function release(object: THREE.Object3D): void {
  object.traverse((each) => {
    if (!(each instanceof THREE.Mesh)) return;
    each.geometry.dispose();
    for (const material of [each.material].flat() as THREE.Material[]) {
      for (const value of Object.values(material)) if (value instanceof THREE.Texture) value.dispose();
      material.dispose();
    }
  });
}
