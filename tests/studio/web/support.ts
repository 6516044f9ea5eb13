// What the page's tests share: the project's own files, which are the truth that they are tried on.
import { execFileSync } from "node:child_process";
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { SchemaBook } from "../../../studio/web/src/schema/schema";
import type { Path, YamlNode } from "../../../studio/web/src/yaml/tree";

const need = (name: string): string => {
  const value = process.env[name];
  if (!value) throw new Error(`${name} is not set`);
  return value;
};

export const source = need("ESPALIER_SOURCE");

export function libraryTexts(kind: "rules" | "scenes"): { name: string; text: string }[] {
  const folder = join(source, kind, "library");
  const names = readdirSync(folder).filter((name) => name.endsWith(".yaml")).sort();
  return names.map((name) => ({ name, text: readFileSync(join(folder, name), "utf8") }));
}

export const schemaBook = (kind: "rules" | "scene"): SchemaBook =>
  new SchemaBook(JSON.parse(execFileSync(need("ESPALIER_PROGRAM"), ["schema", kind], { encoding: "utf8" })));

/** Every scalar with its path. */
export function scalarsOf(node: YamlNode | null, path: Path = []): { path: Path; text: string; from: number; to: number }[] {
  if (!node) return [];
  if (node.kind === "scalar") return [{ path, text: node.text, from: node.from, to: node.to }];
  if (node.kind === "list") return node.items.flatMap((item, index) => scalarsOf(item.value, [...path, index]));
  return node.entries.flatMap((entry) => scalarsOf(entry.value, [...path, entry.key]));
}
