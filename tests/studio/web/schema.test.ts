import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { parse } from "yaml";
import { dialAt, turned } from "../../../studio/web/src/dials/dial";
import { planOf } from "../../../studio/web/src/dials/plan";
import { offersAt } from "../../../studio/web/src/schema/complete";
import { parseYaml } from "../../../studio/web/src/yaml/tree";
import { libraryTexts, scalarsOf, schemaBook, source } from "./support";

const books = { rules: schemaBook("rules"), scene: schemaBook("scene") };

/** What is offered where "|" stands. */
function offered(kind: "rules" | "scene", text: string): string[] {
  const at = text.indexOf("|");
  const offers = offersAt(text.replace("|", ""), at, books[kind], [{ name: "ivy", about: "" }]);
  return offers?.offers.map((offer) => offer.label) ?? [];
}

test("what may be written is offered, wherever one writes", () => {
  for (const [kind, text, label] of [
    ["rules", "espalier: rules\nbi|\n", "bias"],
    ["rules", "espalier: rules\nbias:\n  |\n", "up"],
    ["rules", "espalier: rules\nbias:\n  up: 0.1   # here\n  tw|\nlight: {}\n", "twist"],
    ["rules", "espalier: rules\nbias: {up: 0.1, |}\n", "twist"],
    ["rules", "espalier: rules\npropagate: |\n", "random_tree"],
    ["rules", "espalier: rules\nrequire:\n  proximity: {m|\n", "max"],
    ["rules", "espalier: rules\nelements:\n  - name: leaf\n    |\n", "size"],
    ["rules", "espalier: rules\nrequire:\n  clear: |\n", "true"],
    ["scene", "espalier: scene\nwor|", "world"],
    ["scene", "espalier: scene\nplants:\n  - name: vine\n    |\n", "seeds"],
    ["scene", "espalier: scene\nimages:\n  - {kind: |}\n", "sun_exposure"],
    ["scene", "espalier: scene\nplants:\n  - rules: |\n", "ivy"],
  ] as const) {
    assert.ok(offered(kind, text).includes(label), `${text} offers ${offered(kind, text).join(" ")}`);
  }
  assert.ok(!offered("rules", "bias:\n  up: 0.1\n  |\n").includes("up"), "what stands there already is not offered");
  assert.deepEqual(offered("rules", "bias: # to |\n"), [], "nothing in a comment");
});

test("every key of the library is one of the schema", () => {
  for (const kind of ["rules", "scenes"] as const) {
    const book = books[kind === "rules" ? "rules" : "scene"];
    for (const { name, text } of libraryTexts(kind)) {
      for (const { path } of scalarsOf(parseYaml(text))) {
        assert.ok(book.at(path).length > 0, `${name}: ${path.join(".")}`);
      }
    }
  }
});

test("every rule set of the library has a picture", () => {
  for (const { name } of libraryTexts("rules")) {
    const picture = join(source, "studio/web/presets", name.replace(".yaml", ".jpg"));
    assert.deepEqual([...readFileSync(picture).subarray(0, 3)], [0xff, 0xd8, 0xff], picture);
  }
});

test("every slider of every rule set writes a number between its ends", () => {
  let dials = 0;
  for (const { name, text } of libraryTexts("rules")) {
    const root = parseYaml(text);
    for (const section of planOf(books.rules, "rules", root, [])) {
      for (const dial of [...section.front, ...section.rest]) {
        if (dial.other) continue;
        const where = `${name}: ${dial.path.join(".")}`;
        assert.ok(dial.low < dial.high && dial.values.every((value) => dial.low <= value && value <= dial.high), where);
        const change = turned(text, dial, dial.values.map(() => (dial.low + dial.high) / 2), (dial.high - dial.low) / 64);
        if (!change) continue;
        const next = text.slice(0, change.from) + change.insert + text.slice(change.to);
        assert.doesNotThrow(() => parse(next), where);
        const turnedDial = dialAt(dial.path, dial.info, parseYaml(next), []);
        assert.equal(turnedDial?.source, "text", where);
        dials += 1;
      }
    }
  }
  assert.ok(dials > 500, `${dials} sliders`);
});
