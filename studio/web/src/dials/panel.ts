// The panel of sliders beside the text. It shows the file that is open and changes its text, nothing else.
import { drawing, make, refill } from "../base/dom";
import type { SchemaBook } from "../schema/schema";
import { describe } from "../schema/schema";
import { removeKey, type Change } from "../yaml/edit";
import { parseYaml, type YamlNode } from "../yaml/tree";
import { dialWords, shortUnit, turned, type Dial } from "./dial";
import { pictureOf } from "./pictures";
import { planKey, planOf, type Section } from "./plan";
import { Slider, type SliderSpec } from "./slider";

export interface DialHost {
  textOf(file: string): string;
  drag(file: string, change: Change): void;
  dropped(): void;
  change(file: string, change: Change): void;
  bases(root: YamlNode | null): YamlNode[];
  show(file: string, offset: number): void;
}

interface Row {
  dial: Dial;
  element: HTMLElement;
  slider: Slider;
  picture: HTMLElement;
  value: HTMLElement;
  reset: HTMLButtonElement;
}

export class DialPanel {
  private file = "";
  private kind: "rules" | "scene" = "rules";
  private book: SchemaBook | null = null;
  private shape = "";
  private rows = new Map<string, Row>();
  private readonly opened = new Set<string>();

  constructor(private readonly body: HTMLElement, private readonly host: DialHost) {}

  show(file: string, kind: "rules" | "scene", book: SchemaBook | null, library: boolean): void {
    this.file = file;
    this.kind = kind;
    this.book = book;
    this.body.inert = library;
    this.shape = "";
    this.refresh();
  }

  /** After each change of the text. Rows stay as they are, and with them focus and what is held, unless others are due. */
  refresh(): void {
    if (!this.book || !this.file) return;
    const root = parseYaml(this.host.textOf(this.file));
    const sections = planOf(this.book, this.kind, root, this.host.bases(root));
    const shape = JSON.stringify(sections.map((each) => [each.name, each.front.map((dial) => planKey(dial.path)), each.rest.length]));
    const turning = [...this.rows.values()].some((row) => row.slider.turning);
    if (shape !== this.shape && !turning) {
      this.shape = shape;
      this.rebuild(sections);
      return;
    }
    for (const dial of sections.flatMap((each) => [...each.front, ...each.rest])) this.update(dial);
  }

  private rebuild(sections: Section[]): void {
    const focused = document.activeElement?.closest<HTMLElement>("[data-dial]")?.dataset["dial"];
    const scroll = this.body.scrollTop;
    this.rows.clear();
    refill(this.body, ...sections.map((each) => this.section(each)));
    this.body.scrollTop = scroll;
    if (focused) this.body.querySelector<HTMLElement>(`[data-dial="${CSS.escape(focused)}"] [role=slider]`)?.focus({ preventScroll: true });
  }

  private section(section: Section): HTMLElement {
    const key = JSON.stringify(section.path);
    const rows = section.front.map((dial) => this.row(dial).element);
    const element = make("section", { class: "dials-section" }, make("h3", { title: section.words }, section.name), ...rows);
    if (section.rest.length) {
      const more = make("details", { class: "dials-more" }, make("summary", {}, `${section.rest.length} more`));
      const fill = () => {
        if (more.open) this.opened.add(key);
        else this.opened.delete(key);
        if (more.open && more.childElementCount === 1) more.append(...section.rest.map((dial) => this.row(dial).element));
      };
      more.addEventListener("toggle", fill);
      if (this.opened.has(key)) more.open = true;
      if (more.open) fill();
      element.append(more);
    }
    return element;
  }

  private row(dial: Dial): Row {
    const id = JSON.stringify(dial.path);
    const picture = make("span", { class: "dial-picture" });
    const value = make("button", { class: "dial-value", type: "button", title: "Show it in the text", onclick: () => this.reveal(id) });
    const reset = make("button", { class: "dial-reset", type: "button", title: "Take it out of the text", "aria-label": `Take ${dialName(dial)} out of the text`, onclick: () => this.forget(id) }, "×");
    const slider = new Slider(specOf(dial), {
      turn: (values, step) => this.turn(id, values, step),
      rest: () => this.host.dropped(),
    });
    const { words, unit } = describe(dial.info.schema);
    const element = make("div", { class: "dial", "data-dial": id, title: words + (unit ? ` (${unit})` : "") },
      picture, make("span", { class: "dial-name" }, dialName(dial)), value, reset, slider.element);
    const row: Row = { dial, element, slider, picture, value, reset };
    this.rows.set(id, row);
    this.write(row);
    return row;
  }

  private update(dial: Dial): void {
    const row = this.rows.get(JSON.stringify(dial.path));
    if (!row) return;
    row.dial = row.slider.turning ? { ...dial, low: row.dial.low, high: row.dial.high } : dial;
    row.slider.set(specOf(row.dial));
    this.write(row);
  }

  private write(row: Row): void {
    const { dial } = row;
    row.element.dataset["source"] = dial.source;
    row.element.classList.toggle("is-other", dial.other);
    row.value.textContent = dialWords(dial);
    row.reset.disabled = dial.source !== "text";
    const inside = pictureOf(dial);
    row.element.classList.toggle("has-picture", inside !== "");
    if (inside) refill(row.picture, drawing(40, 32, inside));
  }

  private turn(id: string, values: number[], step: number): void {
    const row = this.rows.get(id);
    if (!row) return;
    const change = turned(this.host.textOf(this.file), row.dial, values, step);
    if (change) this.host.drag(this.file, change);
  }

  private forget(id: string): void {
    const row = this.rows.get(id);
    const change = row && removeKey(this.host.textOf(this.file), row.dial.path);
    if (change) this.host.change(this.file, change);
  }

  private reveal(id: string): void {
    const row = this.rows.get(id);
    if (!row) return;
    const change = turned(this.host.textOf(this.file), row.dial, row.dial.values, 1e-6);
    if (change) this.host.show(this.file, change.from);
  }
}

export function dialName(dial: Dial): string {
  const path = dial.path.filter((step): step is string => typeof step === "string");
  const own = path.slice(dial.path.some((step) => typeof step === "number") || path.length > 1 ? 1 : 0);
  return own.filter((step) => step !== "amount").join(" ").replaceAll("_", " ");
}

export function specOf(dial: Dial): SliderSpec {
  const unit = dial.unit ? ` ${dial.unit}` : shortUnit(dial.kind.unit);
  return { label: dialName(dial), low: dial.low, high: dial.high, whole: dial.kind.whole, values: dial.values, words: (value) => `${Number(value.toPrecision(6))}${unit}` };
}
