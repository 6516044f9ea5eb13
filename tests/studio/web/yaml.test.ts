import assert from "node:assert/strict";
import { test } from "node:test";
import { parse } from "yaml";
import { columnAfter } from "../../../studio/web/src/editor/indent";
import { readAmount, stepOf, writeAmount, writeNumber } from "../../../studio/web/src/yaml/amount";
import { offsetOf, removeKey, setValue, type Change } from "../../../studio/web/src/yaml/edit";
import { nodeAt, parseYaml, type Path } from "../../../studio/web/src/yaml/tree";
import { libraryTexts, scalarsOf } from "./support";

const library = [...libraryTexts("rules"), ...libraryTexts("scenes")];
const changed = (text: string, change: Change | null): string => {
  assert.ok(change, "there is a change");
  return text.slice(0, change.from) + change.insert + text.slice(change.to);
};
const valueIn = (whole: unknown, path: Path): unknown =>
  path.reduce((value, step) => (value as Record<string | number, unknown> | undefined)?.[step], whole);

test("every value of the library stands where the tree says", () => {
  let seen = 0;
  for (const { name, text } of library) {
    const whole: unknown = parse(text);
    for (const { path, text: words, from, to } of scalarsOf(parseYaml(text))) {
      const value = valueIn(whole, path);
      const written = text.slice(from, to);
      assert.equal(String(parse(written)), String(value), `${name}: ${path.join(".")}`);
      if (typeof value === "string" && !written.includes("\n")) assert.equal(words, value, `${name}: ${path.join(".")}`);
      seen += 1;
    }
  }
  assert.ok(seen > 1000, `${seen} values`);
});

test("a text that is being written has a shape at every letter", () => {
  const { text } = libraryTexts("rules").find(({ name }) => name === "courtyard_vine.yaml") ?? { text: "" };
  for (let end = 0; end <= text.length; end++) assert.doesNotThrow(() => parseYaml(text.slice(0, end)), `${end} letters`);
});

test("half-written keys are keys, and what stands around them stays", () => {
  for (const [text, key] of [
    ["a: 1\nbi\nc: 2\n", "bi"], ["a: 1\nb:\n  up: 1\n  tw\nc: 2\n", "b.tw"], ["a: 1\nb: {x: 1, y\nc: 2\n", "b.y"],
    ["list:\n  - name: a\n    k\n  - b: 1\nc: 2\n", "list.0.k"],
  ] as const) {
    const path = key.split(".").map((step) => (/^\d$/.test(step) ? Number(step) : step));
    const holder = nodeAt(parseYaml(text), path.slice(0, -1));
    assert.ok(holder?.kind === "map", text);
    assert.ok(holder.entries.some((entry) => entry.key === path[path.length - 1] && entry.colon < 0), text);
    assert.equal(nodeAt(parseYaml(text), ["c"])?.kind, "scalar", text);
  }
});

test("setting a number changes that number alone", () => {
  for (const { name, text } of library) {
    const numbers = scalarsOf(parseYaml(text)).filter(({ text: words }) => /^-?\d+(\.\d+)?$/.test(words));
    for (const { path, text: words } of numbers.filter((_, index) => index % 11 === 0)) {
      const next = changed(text, setValue(text, path, "7.25"));
      assert.equal(next.length - text.length, 4 - words.length, `${name}: ${path.join(".")}`);
      assert.equal(valueIn(parse(next), path), 7.25);
    }
  }
});

test("a key that lacks is added where it belongs, and taken away again", () => {
  for (const { name, text } of libraryTexts("rules")) {
    for (const path of [["bias", "nowhere"], ["light", "nowhere", "deep"], ["nowhere"]]) {
      const change = setValue(text, path, "0.5");
      if (!change) continue; // a word stands where keys would have to
      const next = changed(text, change);
      const wanted = structuredClone(parse(text));
      path.slice(0, -1).reduce((node, step) => (node[step] ??= {}), wanted)[path[path.length - 1] as string] = 0.5;
      assert.deepEqual(parse(next), wanted, `${name}: ${path.join(".")}\n${next}`);
      assert.equal(valueIn(parse(changed(next, removeKey(next, path))), path), undefined, name);
    }
  }
});

test("places beyond the basic plane are counted in characters", () => {
  assert.equal(offsetOf("a: \u{1F33F}b\nc: 1", 1, 5), 5);
  assert.equal(offsetOf("a: 1\nc: 1", 2, 4), 8);
  assert.equal(offsetOf("a", 9, 9), 1);
});

test("numbers are written as a hand would", () => {
  assert.deepEqual(readAmount(" 2.5 cm"), { value: 2.5, unit: "cm" });
  assert.equal(readAmount("2.5 miles"), null);
  assert.equal(writeAmount({ value: 0.30000000000000004, unit: "m" }, 0.01), "0.3 m");
  assert.equal(writeNumber(-0.0001, 0.01), "0");
  assert.equal(writeNumber(100, 1), "100");
  assert.equal(stepOf(180, false), 1);
  assert.equal(stepOf(2, true), 1);
});

test("a new line begins where its mapping stands", () => {
  for (const [line, column] of [
    ["bias:", 2], ["  up: 0.1          # 0 none", 2], ["plants:  # all", 2], ["  - name: vine", 4], ["    seeds: [", 6],
    ["      [1, 2, 3],", 6], ["# words: as one likes", 0], ["  - {a: 1}", 2], ["", 0],
  ] as const) {
    assert.equal(columnAfter(line, 2), column, line);
  }
});
