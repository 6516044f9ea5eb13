// What the colours on surfaces and on the plant mean, and where enough light begins.
import { make, refill } from "../base/dom";
import { cssGradient } from "../view/palette";

export interface LegendSpec {
  title: string;
  low: string;
  high: string;
  /** Where there is a threshold to be set: its share of the span, or null. */
  cut: number | null | undefined;
  /** Where the threshold begins: from which the plant grows. */
  first?: number;
  cutWords: (share: number) => string;
  setCut: (share: number | null) => void;
}

export function showLegend(place: HTMLElement, spec: LegendSpec | null): void {
  place.hidden = !spec;
  if (!spec) return;
  const ramp = make("div", { class: "ramp" });
  ramp.style.background = cssGradient();
  const parts: HTMLElement[] = [make("h2", {}, spec.title), ramp, make("div", { class: "ends" }, make("span", {}, spec.low), make("span", {}, spec.high))];
  if (spec.cut !== undefined) {
    const words = make("span", {}, "");
    const box = make("input", { type: "checkbox", checked: spec.cut !== null });
    const range = make("input", { type: "range", min: 0, max: 100, value: Math.round(100 * (spec.cut ?? spec.first ?? 0.3)), "aria-label": "Threshold" });
    const write = () => {
      const share = Number(range.value) / 100;
      words.textContent = `Only whether it is at least ${spec.cutWords(share)}`;
      range.hidden = !box.checked;
      spec.setCut(box.checked ? share : null);
    };
    box.addEventListener("change", write);
    range.addEventListener("input", write);
    parts.push(make("label", {}, box, words), range);
    write();
  }
  refill(place, ...parts);
}
