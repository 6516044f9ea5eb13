// The sun with its soft shadow, the sky's light, the backdrop and a quiet ground that fades into it.
import * as THREE from "three";
import type { SceneEvent } from "../protocol/types";

const backdrop = {
  light: { zenith: "#c9d6da", horizon: "#f1eee4", ground: "#dedacb" },
  dark: { zenith: "#10151a", horizon: "#2a302b", ground: "#1e221d" },
};

const domeVertex = /* glsl */ `
varying vec3 vWay;
void main() {
  vWay = position;
  vec4 at = projectionMatrix * vec4(mat3(viewMatrix) * position, 1.0);
  gl_Position = at.xyww;
}`;

const domeFragment = /* glsl */ `
uniform vec3 uZenith;
uniform vec3 uHorizon;
varying vec3 vWay;
void main() {
  float up = normalize(vWay).y;
  vec3 colour = mix(uHorizon, uZenith, smoothstep(-0.02, 0.75, up));
  // A little noise, so that eight bits show no bands.
  float grain = fract(sin(dot(gl_FragCoord.xy, vec2(12.9898, 78.233))) * 43758.5453) - 0.5;
  gl_FragColor = vec4(colour + grain / 255.0, 1.0);
}`;

export class Lights {
  readonly root = new THREE.Group();
  private readonly sun = new THREE.DirectionalLight(0xffffff, 3);
  private readonly sky = new THREE.HemisphereLight(0xffffff, 0x888888, 1.2);
  private readonly ground: THREE.Mesh<THREE.CircleGeometry, THREE.MeshStandardMaterial>;
  private readonly dome: THREE.Mesh<THREE.SphereGeometry, THREE.ShaderMaterial>;
  private readonly centre = new THREE.Vector3();
  /** To the sun, of length 1. */
  readonly way = new THREE.Vector3(0.4, 0.8, 0.5).normalize();
  readonly sunLight = new THREE.Color(1, 1, 1);

  constructor(shadow_px: number) {
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(shadow_px, shadow_px);
    this.sun.shadow.radius = 3.2;
    this.sun.shadow.blurSamples = 12;
    this.ground = new THREE.Mesh(new THREE.CircleGeometry(1, 96), groundMaterial());
    this.ground.rotation.x = -Math.PI / 2;
    this.ground.receiveShadow = true;
    this.ground.renderOrder = -1;
    this.dome = new THREE.Mesh(
      new THREE.SphereGeometry(1, 48, 24),
      new THREE.ShaderMaterial({
        vertexShader: domeVertex, fragmentShader: domeFragment, side: THREE.BackSide, depthWrite: false, toneMapped: false,
        uniforms: { uZenith: { value: new THREE.Vector3() }, uHorizon: { value: new THREE.Vector3() } },
      }),
    );
    this.dome.frustumCulled = false;
    this.dome.renderOrder = -10;
    this.root.add(this.sun, this.sun.target, this.sky, this.ground, this.dome);
    this.theme(false);
  }

  theme(dark: boolean): void {
    const colours = dark ? backdrop.dark : backdrop.light;
    const encoded = (hex: string) => {
      const n = parseInt(hex.slice(1), 16);
      return new THREE.Vector3((n >> 16) / 255, ((n >> 8) & 255) / 255, (n & 255) / 255);
    };
    this.dome.material.uniforms["uZenith"]!.value = encoded(colours.zenith);
    this.dome.material.uniforms["uHorizon"]!.value = encoded(colours.horizon);
    this.ground.material.color.set(colours.ground);
  }

  /** `floor` is where the ground lies: just below what stands there. */
  scene(scene: SceneEvent, box: THREE.Box3): void {
    const low = new THREE.Vector3(...scene.low_m);
    const high = new THREE.Vector3(...scene.high_m);
    const radius = Math.max(1e-3, low.distanceTo(high) / 2);
    this.centre.addVectors(low, high).multiplyScalar(0.5);
    this.way.set(...scene.sun.direction);
    if (this.way.lengthSq() < 1e-9) this.way.set(0, 1, 0);
    this.way.normalize();
    const strength = Math.min(scene.sun.strength, 2);
    this.sun.visible = strength > 0 && this.way.y > -0.02;
    this.sun.intensity = 3.4 * strength;
    this.sun.color.setRGB(...scene.sun.colour);
    this.sunLight.copy(this.sun.color).multiplyScalar(this.sun.visible ? this.sun.intensity / 3.4 : 0);
    this.sun.position.copy(this.centre).addScaledVector(this.way, 2 * radius);
    this.sun.target.position.copy(this.centre);
    const camera = this.sun.shadow.camera;
    camera.left = camera.bottom = -radius;
    camera.right = camera.top = radius;
    camera.near = 0.5 * radius;
    camera.far = 3.5 * radius;
    camera.updateProjectionMatrix();
    this.sun.shadow.bias = -0.0004;
    this.sun.shadow.normalBias = radius / 700;
    const skyColour = new THREE.Color().setRGB(...scene.sky.colour);
    const white = new THREE.Color(1, 1, 1);
    this.sky.color.copy(skyColour.lerp(white, 0.45));
    this.sky.groundColor.set(0x8a7f6a).convertSRGBToLinear();
    this.sky.intensity = 1.5 * Math.min(scene.sky.strength, 2);
    const bottom = box.isEmpty() ? scene.low_m[1] : box.min.y;
    this.ground.position.set(this.centre.x, bottom - 0.002 * radius, this.centre.z);
    this.ground.scale.setScalar(4 * radius);
  }
}

/** Its rim fades, so that there is no edge between it and the backdrop. */
function groundMaterial(): THREE.MeshStandardMaterial {
  const material = new THREE.MeshStandardMaterial({ roughness: 1, metalness: 0, transparent: true, depthWrite: false });
  material.onBeforeCompile = (shader) => {
    shader.vertexShader = shader.vertexShader
      .replace("#include <common>", "#include <common>\nvarying vec2 vAt;")
      .replace("#include <begin_vertex>", "#include <begin_vertex>\nvAt = position.xy;");
    shader.fragmentShader = shader.fragmentShader
      .replace("#include <common>", "#include <common>\nvarying vec2 vAt;")
      .replace("#include <color_fragment>", "#include <color_fragment>\ndiffuseColor.a *= 1.0 - smoothstep(0.18, 0.85, length(vAt));");
  };
  return material;
}
