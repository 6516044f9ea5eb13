// Where in a file's keys the cursor is: what completion and hover ask. Works on text that is being written.
import { child, columnOf, nodeAt, parseYaml, type Path, type YamlList, type YamlMap, type YamlNode } from "./tree";

export interface CursorPlace {
  /** Of the mapping, list or value that the cursor is in: with role "value" the value's own. */
  path: Path;
  role: "key" | "value";
  /** What is typed of the word so far: from here to the cursor. */
  wordFrom: number;
  /** Keys that stand in that mapping already, but for the one that is being typed. */
  given: string[];
  flow: boolean;
  /** Of a block, the column at which its keys stand. */
  indent: number;
}

export function placeAt(text: string, at: number): CursorPlace | null {
  const lineFrom = text.lastIndexOf("\n", at - 1) + 1;
  const before = text.slice(lineFrom, at);
  if (/(^|\s)#/.test(withoutQuoted(before))) return null;
  const root = parseYaml(text);
  return inFlow(text, root, at) ?? inBlock(text, root, lineFrom, before, at);
}

const withoutQuoted = (line: string) => line.replace(/"[^"]*"|'[^']*'/g, (quoted) => "x".repeat(quoted.length));

function inFlow(text: string, root: YamlNode | null, at: number): CursorPlace | null {
  let found: { node: YamlMap | YamlList; path: Path } | null = null;
  const visit = (node: YamlNode | null, path: Path): void => {
    if (!node || node.kind === "scalar" || node.from >= at) return;
    if (node.flow && (node.closed ? at < node.to : at <= node.to)) found = { node, path };
    if (node.kind === "map") node.entries.forEach((entry) => visit(entry.value, [...path, entry.key]));
    else node.items.forEach((item, index) => visit(item.value, [...path, index]));
  };
  visit(root, []);
  if (!found) return null;
  const { node, path } = found as { node: YamlMap | YamlList; path: Path };
  const { start, colon, index } = lastPart(text, node.from + 1, at);
  const wordFrom = wordStart(text, Math.max(start, colon + 1), at);
  if (node.kind === "list") {
    return { path: [...path, index], role: "value", wordFrom, given: [], flow: true, indent: -1 };
  }
  const given = node.entries.filter((entry) => !(entry.keyFrom <= at && at <= entry.keyTo)).map((entry) => entry.key);
  if (colon < 0) return { path, role: "key", wordFrom, given, flow: true, indent: -1 };
  const key = text.slice(start, colon).trim().replace(/^["']|["']$/g, "");
  return { path: [...path, key], role: "value", wordFrom, given, flow: true, indent: -1 };
}

/** From inside a bracket to the cursor: where the part that is being written begins, and its colon, if any. */
function lastPart(text: string, from: number, at: number): { start: number; colon: number; index: number } {
  let [start, colon, index, depth] = [from, -1, 0, 0];
  let quote = "";
  for (let i = from; i < at; i++) {
    const sign = text[i] ?? "";
    if (quote) {
      if (sign === quote) quote = "";
    } else if ((sign === '"' || sign === "'") && /[\s,:[{]/.test(text[i - 1] ?? " ")) quote = sign;
    else if (sign === "{" || sign === "[") depth += 1;
    else if (sign === "}" || sign === "]") depth -= 1;
    else if (depth === 0 && sign === ",") [start, colon, index] = [i + 1, -1, index + 1];
    else if (depth === 0 && sign === ":" && colon < 0) colon = i;
  }
  return { start, colon, index };
}

function wordStart(text: string, from: number, at: number): number {
  let start = from;
  while (start < at && /\s/.test(text[start] ?? "")) start += 1;
  return start;
}

function inBlock(text: string, root: YamlNode | null, lineFrom: number, before: string, at: number): CursorPlace | null {
  const dashes = /^\s*(?:-\s+)*/.exec(before)?.[0] ?? "";
  const content = before.slice(dashes.length);
  const column = dashes.length;
  const { path, node } = holderOf(text, root, lineFrom, column, dashes);
  const keyed = /^("[^"]*"|'[^']*'|[^:#]+?)\s*:(\s|$)/.exec(content);
  const given = node?.kind === "map" ? node.entries.filter((entry) => !(entry.keyFrom <= at && at <= entry.keyTo + 1)).map((entry) => entry.key) : [];
  if (keyed) {
    const key = (keyed[1] ?? "").replace(/^["']|["']$/g, "");
    const wordFrom = wordStart(text, lineFrom + column + keyed[0].length, at);
    return { path: [...path, key], role: "value", wordFrom, given, flow: false, indent: column };
  }
  return { path, role: "key", wordFrom: lineFrom + column, given, flow: false, indent: column };
}

/** The mapping in which something at this column of this line stands. */
function holderOf(text: string, root: YamlNode | null, lineFrom: number, column: number, dashes: string): { path: Path; node: YamlNode | null } {
  const path: Path = [];
  let node = root;
  const dashColumns = [...dashes.matchAll(/-/g)].map((dash) => dash.index ?? 0);
  while (node) {
    if (node.kind === "scalar" || node.flow) break;
    if (node.kind === "map") {
      const isListHere = dashColumns.some((dash) => dash === (node as YamlMap).indent);
      if (column <= node.indent && !isListHere) break;
      const entry = [...node.entries].reverse().find((each) => each.keyFrom < lineFrom);
      if (!entry) break;
      path.push(entry.key);
      node = entry.value;
    } else {
      if (column <= node.indent) break;
      const onThisLine = node.items.findIndex((item) => item.from >= lineFrom && item.from < lineFrom + column);
      const before = node.items.filter((item) => item.from < lineFrom).length;
      path.push(onThisLine >= 0 ? onThisLine : Math.max(0, before - 1));
      node = child(node, path[path.length - 1] ?? 0);
      if (onThisLine >= 0 && node && columnOf(text, node.from) >= column) break;
    }
  }
  return { path, node: node ?? nodeAt(root, path) };
}

export interface WordAt {
  path: Path;
  role: "key" | "value";
  from: number;
  to: number;
}

/** The key or the value under a place, for hovering. */
export function wordAt(root: YamlNode | null, at: number): WordAt | null {
  const visit = (node: YamlNode | null, path: Path): WordAt | null => {
    if (!node) return null;
    if (node.kind === "scalar") {
      return node.from <= at && at <= node.to ? { path, role: "value", from: node.from, to: node.to } : null;
    }
    if (node.kind === "list") {
      for (const [index, item] of node.items.entries()) {
        const found = visit(item.value, [...path, index]);
        if (found) return found;
      }
      return null;
    }
    for (const entry of node.entries) {
      const here = [...path, entry.key];
      if (entry.keyFrom <= at && at <= entry.keyTo) return { path: here, role: "key", from: entry.keyFrom, to: entry.keyTo };
      const found = visit(entry.value, here);
      if (found) return found;
    }
    return null;
  };
  return visit(root, []);
}
