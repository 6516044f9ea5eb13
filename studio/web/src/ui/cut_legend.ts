// Where the cut through the boundary layers lies, and what its colours mean.
import { make, refill } from "../base/dom";
import { axes, type Axis } from "../protocol/layers";
import { layerShare } from "../view/layer_cut";
import { css } from "../view/palette";

export interface CutSpec {
  axis: Axis;
  /** From 0 to 1 through the world. */
  share: number;
  at_m: (share: number) => number;
  layers: number;
  move: (axis: Axis, share: number) => void;
}

export function showCutLegend(place: HTMLElement, spec: CutSpec): void {
  place.hidden = false;
  const shown = Math.min(spec.layers, 12);
  const swatches = Array.from({ length: shown }, (_, i) => {
    const swatch = make("i", {});
    swatch.style.background = css(layerShare(((i + 0.5) * spec.layers) / shown + 0.5, spec.layers));
    return swatch;
  });
  const where = make("output", {}, `${spec.at_m(spec.share).toFixed(2)} m`);
  const range = make("input", { type: "range", min: 0, max: 1000, value: Math.round(1000 * spec.share), "aria-label": "Where the cut lies" });
  range.addEventListener("input", () => {
    const share = Number(range.value) / 1000;
    where.textContent = `${spec.at_m(share).toFixed(2)} m`;
    spec.move(spec.axis, share);
  });
  const buttons = axes.map((axis) =>
    make("button", { class: "axis", type: "button", "aria-pressed": String(axis === spec.axis), "aria-label": `At right angles to ${axis}`, onclick: () => spec.move(axis, spec.share) }, axis));
  refill(place, make("h2", {}, "Boundary layers"), make("div", { class: "layers" }, ...swatches),
    make("div", { class: "ends" }, make("span", {}, "at the surface"), make("span", {}, `layer ${spec.layers}`)),
    make("div", { class: "cut" }, ...buttons, range, where));
}
