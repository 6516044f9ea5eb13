// Changes of a text that a slider or a fix makes: as small as they can be, so that comments and the hand's own layout
// stay. A change is a replacement of what lies between two offsets.
import { nodeAt, parseYaml, type Path, type YamlMap, type YamlNode } from "./tree";

export interface Change {
  from: number;
  to: number;
  insert: string;
}

/** Sets what stands at a path: replaces it where it stands, else adds the keys that lack. */
export function setValue(text: string, path: Path, value: string): Change | null {
  const root = parseYaml(text);
  const node = nodeAt(root, path);
  if (node) return { from: node.from, to: node.to, insert: value };
  for (let depth = path.length - 1; depth >= 0; depth--) {
    const holder = depth === 0 ? root : nodeAt(root, path.slice(0, depth));
    const missing = path.slice(depth);
    if (holder?.kind === "map") return addTo(text, holder, missing, value);
    if (holder) return null; // a list or a word stands where keys would have to: that is the hand's to change
    const parent = depth === 0 ? null : nodeAt(root, path.slice(0, depth - 1));
    const entry = parent?.kind === "map" ? parent.entries.find((each) => each.key === path[depth - 1]) : undefined;
    if (entry && entry.colon >= 0) return { from: entry.colon, to: entry.colon, insert: ` ${nested(missing, value)}` };
  }
  if (root) return null;
  const line = entryText(path, value);
  return { from: text.length, to: text.length, insert: (text === "" || text.endsWith("\n") ? "" : "\n") + line + "\n" };
}

/** Takes a key away, its line with it where it has one of its own. */
export function removeKey(text: string, path: Path): Change | null {
  const root = parseYaml(text);
  const holder = path.length === 1 ? root : nodeAt(root, path.slice(0, -1));
  if (holder?.kind !== "map") return null;
  const index = holder.entries.findIndex((each) => each.key === path[path.length - 1]);
  const entry = holder.entries[index];
  if (!entry) return null;
  const end = entry.value?.to ?? Math.max(entry.colon, entry.keyTo);
  if (!holder.flow) {
    const from = text.lastIndexOf("\n", entry.keyFrom - 1) + 1;
    if (text.slice(from, entry.keyFrom).trim() !== "") return null;
    const line = text.indexOf("\n", end);
    return { from, to: line < 0 ? text.length : line + 1, insert: "" };
  }
  const next = holder.entries[index + 1];
  if (next) return { from: entry.keyFrom, to: next.keyFrom, insert: "" };
  const last = holder.entries[index - 1];
  return { from: last ? (last.value?.to ?? last.keyTo) : entry.keyFrom, to: end, insert: "" };
}

function addTo(text: string, map: YamlMap, missing: Path, value: string): Change {
  const entry = entryText(missing, value);
  if (map.flow) {
    if (map.entries.length === 0) return { from: map.from + 1, to: map.from + 1, insert: entry };
    const end = lastEnd(map);
    return { from: end, to: end, insert: `, ${entry}` };
  }
  const line = text.indexOf("\n", lastEnd(map));
  const end = line < 0 ? text.length : line;
  return { from: end, to: end, insert: `\n${" ".repeat(map.indent)}${entry}` };
}

function lastEnd(map: YamlMap): number {
  const last = map.entries[map.entries.length - 1];
  return last ? endOf(last.value) ?? Math.max(last.colon, last.keyTo) : map.from;
}

function endOf(node: YamlNode | null): number | null {
  return node ? node.to : null;
}

const entryText = (path: Path, value: string): string => `${path[0]}: ${nested(path.slice(1), value)}`;

const nested = (path: Path, value: string): string =>
  path.length === 0 ? value : `{${path[0]}: ${nested(path.slice(1), value)}}`;

/** Offsets of a place that the program names: lines and columns from 1, in characters (a sign beyond the basic plane
 * is one character there and two in this page's strings). */
export function offsetOf(text: string, line: number, column: number): number {
  let at = 0;
  for (let i = 1; i < line; i++) {
    const end = text.indexOf("\n", at);
    if (end < 0) return text.length;
    at = end + 1;
  }
  const end = text.indexOf("\n", at);
  const limit = end < 0 ? text.length : end;
  for (let i = 1; i < column && at < limit; i++) at += (text.codePointAt(at) ?? 0) > 0xffff ? 2 : 1;
  return at;
}
