// Pictures by their addresses, each loaded once and let go when nobody draws with it any more.
import * as THREE from "three";

export class Textures {
  private readonly held = new Map<string, { texture: THREE.Texture; users: number }>();
  private readonly loader = new THREE.TextureLoader();

  constructor(private readonly changed: () => void) {}

  take(address: string): THREE.Texture {
    const found = this.held.get(address);
    if (found) {
      found.users += 1;
      return found.texture;
    }
    const texture = this.loader.load(address, this.changed);
    texture.colorSpace = THREE.SRGBColorSpace;
    texture.anisotropy = 4;
    texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
    // Our pictures' first line is their top, as in glTF.
    texture.flipY = false;
    this.held.set(address, { texture, users: 1 });
    return texture;
  }

  giveBack(address: string): void {
    const found = this.held.get(address);
    if (!found) return;
    found.users -= 1;
    if (found.users > 0) return;
    found.texture.dispose();
    this.held.delete(address);
  }
}
