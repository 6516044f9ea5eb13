// The numbers below: how much has grown, what took how long, and what became of buds.
import { grouped, make, refill, seconds } from "../base/dom";
import type { GrowthEvent, StagesEvent } from "../protocol/types";
import { outcomeColours } from "../view/trial_lines";

const stageColours: Record<string, string> = {
  reading: "#8a8f88", tiling: "#b98a4a", preparing: "#9c7fb0", growing: "#6f9a3c", dressing: "#4f9a8a", lighting: "#e0a21f",
};

/** What is no fault of the rules has quiet colours. */
const known: Record<string, string> = { grown: "#6f9a3c", resting: "#a9b39a" };

export class Numbers {
  private readonly figures: Record<string, HTMLElement> = {};
  private readonly stages = make("div", { class: "strip", "aria-label": "Time by stage", role: "group" });
  private readonly buds = make("div", { class: "strip", "aria-label": "What became of buds", role: "group" });

  constructor(place: HTMLElement) {
    const list = make("dl", { class: "figures" });
    for (const name of ["segments", "leaves", "iterations", "from key to plant"]) {
      const figure = (this.figures[name] = make("dd", { "data-figure": name }, "–"));
      list.append(make("div", {}, make("dt", {}, name), figure));
    }
    refill(place, list, this.stages, this.buds);
  }

  growth(growth: GrowthEvent): void {
    this.put("segments", grouped(growth.segments));
    this.put("leaves", grouped(growth.elements));
    refill(this.figure("iterations"), String(growth.iteration), make("small", {}, ` of ${growth.iterations}`));
    if (growth.done) this.outcomes(growth);
  }

  /** From the last keystroke to the first of the plant on the screen. */
  answered(value_s: number): void {
    this.put("from key to plant", seconds(value_s));
  }

  times(stages: StagesEvent): void {
    const entries = Object.entries(stages.seconds).filter(([, value]) => value >= 0);
    const sum = entries.reduce((total, [name, value]) => total + (stages.ran[name] ? value : 0), 0);
    const ran = ([name]: [string, number]) => (stages.ran[name] ?? 0) > 0;
    refill(this.stages,
      make("div", { class: "bar", "aria-hidden": "true" }, ...entries.filter(ran).map(([name, value]) => piece(stageColours[name] ?? "#888", value / (sum || 1)))),
      make("ul", {}, ...entries.map((entry) => make("li", { class: ran(entry) ? "" : "is-idle", title: ran(entry) ? "" : "Not done again: nothing that it hangs on has changed" },
        swatch(ran(entry) ? (stageColours[entry[0]] ?? "#888") : "var(--edge-strong)"), `${entry[0]} ${ran(entry) ? seconds(entry[1]) : "kept"}`))));
  }

  private outcomes(growth: GrowthEvent): void {
    const buds = Object.entries(growth.outcomes?.buds ?? {}).filter(([, count]) => count > 0).sort((a, b) => b[1] - a[1]);
    const sum = buds.reduce((total, [, count]) => total + count, 0);
    const failed = [...(growth.ending ? [growth.ending] : []), ...growth.plants.flatMap((plant) => (plant.failure ? [`${plant.name ?? "a plant"}: ${plant.failure}`] : [])), ...lines(growth.poor)];
    const others = buds.map(([name]) => name).filter((name) => !(name in known));
    const colour = (name: string) => known[name] ?? outcomeColours[others.indexOf(name) % outcomeColours.length] ?? "#888";
    refill(this.buds,
      make("div", { class: "bar", "aria-hidden": "true" }, ...buds.map(([name, count]) => piece(colour(name), count / (sum || 1)))),
      make("ul", {}, make("li", {}, "Buds"), ...buds.map(([name, count]) => make("li", {}, swatch(colour(name)), `${grouped(count)} ${name.replaceAll("_", " ")}`))),
      failed.length ? make("p", { class: "failure", title: failed.join("\n") }, failed.join(" · ")) : null);
  }

  private figure(name: string): HTMLElement {
    return this.figures[name] ?? make("span");
  }

  private put(name: string, words: string): void {
    this.figure(name).textContent = words;
  }
}

function lines(text: string | string[] | undefined): string[] {
  return [text ?? []].flat().flatMap((each) => each.split("\n")).map((each) => each.replace(/^note: /, "").trim()).filter(Boolean);
}

function piece(colour: string, share: number): HTMLElement {
  const span = make("span");
  span.style.background = colour;
  span.style.flexGrow = String(Math.max(0.004, share));
  return span;
}

function swatch(colour: string): HTMLElement {
  const mark = make("i");
  mark.style.background = colour;
  return mark;
}
