// The materials of stems and leaves: three's own, with a few lines of ours. They hide what is born later than the
// scrubber says, colour by age or exposure where that is asked, darken what sees little light, and let the sun shine
// through leaves.
import * as THREE from "three";
import { mapTexture } from "./palette";

export type PlantColours = "natural" | "age" | "exposure";

/** Shared by every material of plants, so that a switch is one write. */
export interface PlantUniforms {
  uUntil: { value: number };
  uLast: { value: number };
  uColours: { value: number };
  uMap: { value: THREE.Texture };
  /** To the sun, in the camera's space, and its light. */
  uSunView: { value: THREE.Vector3 };
  uSunLight: { value: THREE.Color };
}

export const plantUniforms = (): PlantUniforms => ({
  uUntil: { value: 1e9 },
  uLast: { value: 1 },
  uColours: { value: 0 },
  uMap: { value: mapTexture() },
  uSunView: { value: new THREE.Vector3(0, 1, 0) },
  uSunLight: { value: new THREE.Color(1, 1, 1) },
});

export const coloursNumber: Record<PlantColours, number> = { natural: 0, age: 1, exposure: 2 };

const declared = /* glsl */ `
uniform float uUntil;
uniform float uLast;
uniform float uColours;
`;

const stemVertex = /* glsl */ `
attribute vec4 aData;
varying vec3 vGrown;
${declared}
float grownShare(float born) {
  return clamp((uUntil - born) / max(uLast - born, 0.5), 0.0, 1.0);
}
`;

const stemMove = /* glsl */ `
transformed -= objectNormal * aData.y * (1.0 - max(0.18, sqrt(grownShare(aData.x))));
vGrown = vec3(aData.x, aData.z, aData.w);
`;

const leafVertex = /* glsl */ `
attribute vec2 aData;
varying vec3 vGrown;
${declared}
float hashOf(vec3 p) {
  return fract(sin(dot(p, vec3(12.9898, 78.233, 37.719))) * 43758.5453);
}
`;

const leafMove = /* glsl */ `
transformed *= clamp((uUntil - aData.x + 1.0) / 3.0, 0.0, 1.0);
vGrown = vec3(aData.x, aData.y, hashOf(instanceMatrix[3].xyz));
`;

const fragmentHead = /* glsl */ `
varying vec3 vGrown;
uniform sampler2D uMap;
uniform vec3 uSunView;
uniform vec3 uSunLight;
uniform vec3 uShoot;
${declared}
`;

const hideUnborn = /* glsl */ `if (vGrown.x > uUntil) discard;`;

const stemColour = /* glsl */ `
diffuseColor.rgb = mix(diffuseColor.rgb, uShoot, smoothstep(0.72, 1.0, vGrown.x / max(min(uUntil, uLast), 1.0)));
`;

const leafColour = /* glsl */ `
diffuseColor.rgb *= 0.86 + 0.28 * vGrown.z;
diffuseColor.r *= 0.9 + 0.22 * fract(vGrown.z * 7.13);
`;

const measured = /* glsl */ `
if (uColours > 0.5) {
  float share = uColours < 1.5 ? vGrown.x / max(uLast, 1.0) : vGrown.y;
  diffuseColor.rgb = texture2D(uMap, vec2(clamp(share, 0.0, 1.0) * 0.996 + 0.002, 0.5)).rgb;
}
`;

const dimmed = /* glsl */ `
reflectedLight.indirectDiffuse *= mix(0.42, 1.0, clamp(vGrown.y * 1.3, 0.0, 1.0));
`;

const throughLeaf = /* glsl */ `
totalEmissiveRadiance += diffuseColor.rgb * vec3(1.05, 1.0, 0.45) * uSunLight
  * (0.22 * max(0.0, dot(-normal, uSunView)) * clamp(vGrown.y * 1.4, 0.0, 1.0));
`;

function patched<M extends THREE.Material>(material: M, kind: "stem" | "leaf", uniforms: PlantUniforms, shoot: THREE.Color, depth: boolean): M {
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, uniforms, { uShoot: { value: shoot } });
    const [head, move] = kind === "stem" ? [stemVertex, stemMove] : [leafVertex, leafMove];
    let vertex = shader.vertexShader.replace("#include <common>", `#include <common>\n${head}`);
    // The depth pass has no normals unless something asks for them.
    const normal = depth && kind === "stem" ? "vec3 objectNormal = vec3(normal);\n" : "";
    vertex = vertex.replace("#include <begin_vertex>", `#include <begin_vertex>\n${normal}${move}`);
    shader.vertexShader = vertex;
    let fragment = shader.fragmentShader.replace("#include <common>", `#include <common>\n${fragmentHead}`);
    if (depth) fragment = fragment.replace("#include <map_fragment>", `${hideUnborn}\n#include <map_fragment>`);
    else {
      const tint = kind === "stem" ? stemColour : leafColour;
      fragment = fragment
        .replace("#include <color_fragment>", `#include <color_fragment>\n${hideUnborn}\n${tint}\n${measured}`)
        .replace("#include <aomap_fragment>", `#include <aomap_fragment>\n${dimmed}`);
      if (kind === "leaf") fragment = fragment.replace("#include <emissivemap_fragment>", `#include <emissivemap_fragment>\n${throughLeaf}`);
    }
    shader.fragmentShader = fragment;
  };
  material.customProgramCacheKey = () => `plant-${kind}-${depth}`;
  return material;
}

export interface PlantLook {
  colour: THREE.Color;
  shoot: THREE.Color;
  emits: THREE.Color | null;
  opacity: number;
  map: THREE.Texture | null;
}

export interface PlantMaterials {
  surface: THREE.MeshStandardMaterial;
  depth: THREE.MeshDepthMaterial;
}

export function plantMaterials(kind: "stem" | "leaf", look: PlantLook, uniforms: PlantUniforms): PlantMaterials {
  const side = kind === "leaf" ? THREE.DoubleSide : THREE.FrontSide;
  const surface = new THREE.MeshStandardMaterial({
    color: look.colour, roughness: kind === "leaf" ? 0.62 : 0.86, metalness: 0, side,
    map: look.map, alphaTest: look.map ? 0.5 : 0,
    transparent: look.opacity < 1, opacity: look.opacity, depthWrite: look.opacity >= 1,
  });
  if (look.emits) surface.emissive = look.emits;
  const depth = new THREE.MeshDepthMaterial({ depthPacking: THREE.RGBADepthPacking, map: look.map, alphaTest: look.map ? 0.5 : 0 });
  return {
    surface: patched(surface, kind, uniforms, look.shoot, false),
    depth: patched(depth, kind, uniforms, look.shoot, true),
  };
}
