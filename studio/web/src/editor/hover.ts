// What a key means, where the pointer rests on it or on its value: the schema's words, and a slider for a number.
import { hoverTooltip } from "@codemirror/view";
import type { Extension } from "@codemirror/state";
import { drawing, make } from "../base/dom";
import { dialAt, turned } from "../dials/dial";
import { specOf, type DialHost } from "../dials/panel";
import { pictureOf } from "../dials/pictures";
import { Slider } from "../dials/slider";
import { describe, inYaml, wordsOf, type SchemaBook } from "../schema/schema";
import { wordAt } from "../yaml/cursor";
import { parseYaml, type Path } from "../yaml/tree";

export function keyHover(file: string, book: () => SchemaBook | null, host: DialHost): Extension {
  return hoverTooltip(
    (view, at) => {
      const schema = book();
      if (!schema) return null;
      const text = view.state.doc.toString();
      const word = wordAt(parseYaml(text), at);
      const path = word && keyPath(word.path);
      if (!word || !path || !schema.keyAt(path)) return null;
      return { pos: word.from, end: word.to, above: true, create: () => ({ dom: card(file, path, schema, host) }) };
    },
    { hoverTime: 350 },
  );
}

/** Of a number in a list, [a, b], the key is the list's. */
function keyPath(path: Path): Path | null {
  const shorter = [...path];
  while (shorter.length && typeof shorter[shorter.length - 1] === "number") shorter.pop();
  return shorter.length ? shorter : null;
}

function card(file: string, path: Path, schema: SchemaBook, host: DialHost): HTMLElement {
  const info = schema.keyAt(path);
  if (!info) return make("div");
  const { words, unit } = describe(info.schema);
  const facts = [
    info.schema.default === undefined ? "" : `default ${inYaml(info.schema.default)}`,
    unit,
    boundsOf(info.choices),
    wordsOf(info.choices).slice(0, 12).join(" · "),
  ].filter(Boolean);
  const name = path.filter((step) => typeof step === "string").join(".");
  const element = make("div", { class: "key-card" }, make("code", {}, name), make("p", {}, words || "A name of your own."),
    facts.length ? make("p", { class: "key-facts" }, facts.join("  ·  ")) : null);
  const dialNow = () => {
    const root = parseYaml(host.textOf(file));
    return dialAt(path, info, root, host.bases(root));
  };
  const dial = dialNow();
  if (!dial || dial.other) return element;
  const value = make("output", { class: "dial-value" });
  const picture = make("span", { class: "dial-picture" });
  const slider = new Slider(specOf(dial), {
    turn: (values, step) => {
      const now = dialNow();
      const change = now && turned(host.textOf(file), now, values, step);
      if (!change) return;
      host.drag(file, change);
      write();
    },
    rest: () => host.dropped(),
  });
  const write = () => {
    const now = dialNow();
    if (!now) return;
    value.textContent = now.values.map((each) => specOf(now).words(each)).join(" – ");
    const inside = pictureOf(now);
    picture.hidden = !inside;
    if (inside) picture.replaceChildren(drawing(40, 32, inside));
  };
  write();
  element.append(make("div", { class: "key-dial" }, picture, slider.element, value));
  return element;
}

function boundsOf(choices: { minimum?: number; maximum?: number; exclusiveMinimum?: number; exclusiveMaximum?: number }[]): string {
  for (const each of choices) {
    const low = each.minimum ?? each.exclusiveMinimum;
    const high = each.maximum ?? each.exclusiveMaximum;
    if (low !== undefined && high !== undefined) return `${low} to ${high}`;
    if (low !== undefined) return `from ${low}`;
  }
  return "";
}
