// The colour map of what is measured: even steps look even. It goes through OKLCH (B. Ottosson, "A perceptual color
// space for image processing", 2020) from a dark violet over teal to a pale yellow, its lightness rising evenly, so that
// it also reads without colour.
import * as THREE from "three";

export const mapSize = 256;

export function mapColour(share: number): [number, number, number] {
  const t = Math.min(1, Math.max(0, share));
  const lightness = 0.26 + 0.68 * t;
  const hue = ((300 - 205 * t ** 0.92) * Math.PI) / 180;
  const chroma = 0.085 + 0.075 * Math.sin(Math.PI * Math.min(1, t * 1.02));
  return fromOklab(lightness, chroma * Math.cos(hue), chroma * Math.sin(hue));
}

function fromOklab(lightness: number, a: number, b: number): [number, number, number] {
  const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
  const linear = [
    4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
    -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
    -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s,
  ];
  const encoded = linear.map((c) => {
    const v = Math.min(1, Math.max(0, c));
    return v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055;
  });
  return encoded as [number, number, number];
}

export const css = (share: number): string =>
  `rgb(${mapColour(share).map((c) => Math.round(255 * c)).join(" ")})`;

export const cssGradient = (): string =>
  `linear-gradient(to right, ${Array.from({ length: 12 }, (_, i) => css(i / 11)).join(", ")})`;

/** One texture for all shaders that look values up; it lives as long as the page. */
export function mapTexture(): THREE.DataTexture {
  const data = new Uint8Array(4 * mapSize);
  for (let i = 0; i < mapSize; i++) {
    const colour = mapColour(i / (mapSize - 1));
    colour.forEach((c, k) => (data[4 * i + k] = Math.round(255 * c)));
    data[4 * i + 3] = 255;
  }
  const texture = new THREE.DataTexture(data, mapSize, 1, THREE.RGBAFormat);
  texture.colorSpace = THREE.SRGBColorSpace;
  texture.minFilter = texture.magFilter = THREE.LinearFilter;
  texture.needsUpdate = true;
  return texture;
}
