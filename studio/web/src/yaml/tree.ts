// A text's keys, values and where they stand, by the yaml package, whose reader goes on where it is wrong: half-written
// text still has a shape. It never fails; the program says what is wrong. Places are offsets into the text.
import { isAlias, isMap, isScalar, isSeq, parseDocument, type CST, type Node, type Pair, type YAMLMap, type YAMLSeq } from "yaml";

export type Path = (string | number)[];

export interface YamlScalar {
  kind: "scalar";
  from: number;
  to: number;
  /** Without its quotes. */
  text: string;
}

export interface YamlEntry {
  key: string;
  keyFrom: number;
  keyTo: number;
  /** Behind the colon; -1 where none is written yet. */
  colon: number;
  value: YamlNode | null;
}

export interface YamlMap {
  kind: "map";
  from: number;
  to: number;
  flow: boolean;
  closed: boolean;
  /** Of a block: the column, from 0, at which its keys stand. */
  indent: number;
  entries: YamlEntry[];
}

export interface YamlList {
  kind: "list";
  from: number;
  to: number;
  flow: boolean;
  closed: boolean;
  indent: number;
  items: { from: number; value: YamlNode | null }[];
}

export type YamlNode = YamlScalar | YamlMap | YamlList;

export function parseYaml(text: string): YamlNode | null {
  const options = { strict: false, uniqueKeys: false, keepSourceTokens: true, logLevel: "silent" } as const;
  return nodeOf(text, parseDocument(text, options).contents);
}

export function child(node: YamlNode | null, step: string | number): YamlNode | null {
  if (node?.kind === "map") return node.entries.find((entry) => entry.key === String(step))?.value ?? null;
  if (node?.kind === "list" && typeof step === "number") return node.items[step]?.value ?? null;
  return null;
}

export function nodeAt(root: YamlNode | null, path: Path): YamlNode | null {
  return path.reduce<YamlNode | null>((node, step) => child(node, step), root);
}

export function columnOf(text: string, at: number): number {
  return at - (text.lastIndexOf("\n", at - 1) + 1);
}

function nodeOf(text: string, node: unknown): YamlNode | null {
  if (isMap(node)) return mapOf(text, node);
  if (isSeq(node)) return listOf(text, node);
  const range = (node as Node | null)?.range;
  if (!range || range[0] === range[1]) return null;
  const written = text.slice(range[0], range[1]);
  const quoted = isScalar(node) && typeof node.value === "string" && /^["']/.test(written);
  if (!isScalar(node) && !isAlias(node)) return null;
  return { kind: "scalar", from: range[0], to: range[1], text: quoted ? String(node.value) : written };
}

function mapOf(text: string, node: YAMLMap): YamlMap {
  const entries = node.items.flatMap((pair) => entriesOf(text, pair as Pair<Node, Node>));
  const { from, flow, closed, to } = frameOf(node);
  const last = entries[entries.length - 1];
  const end = last ? (last.value?.to ?? Math.max(last.colon, last.keyTo)) : from;
  return { kind: "map", from, to: flow ? to : end, flow, closed, indent: flow ? -1 : columnOf(text, from), entries };
}

/** A word on a line of its own above a key is read as that key's beginning: it is a key that is being written. */
function entriesOf(text: string, pair: Pair<Node, Node>): YamlEntry[] {
  const range = pair.key?.range;
  if (!range) return [];
  const source = pair.srcToken as CST.CollectionItem | undefined;
  const sign = source?.sep?.find((token) => token.type === "map-value-ind");
  const lines: YamlEntry[] = [];
  let from = range[0];
  for (const line of text.slice(range[0], range[1]).split("\n")) {
    const [blank, word] = [line.length - line.trimStart().length, line.trim()];
    if (word) lines.push({ key: word, keyFrom: from + blank, keyTo: from + blank + word.length, colon: -1, value: null });
    from += line.length + 1;
  }
  const last = lines[lines.length - 1];
  if (!last) return [];
  if (isScalar(pair.key) && lines.length === 1) last.key = /^["']/.test(last.key) ? String(pair.key.value) : last.key;
  last.colon = sign ? sign.offset + 1 : -1;
  last.value = nodeOf(text, pair.value);
  return lines;
}

function listOf(text: string, node: YAMLSeq): YamlList {
  const { from, flow, closed, to } = frameOf(node);
  const tokens = (node.srcToken as CST.BlockSequence | CST.FlowCollection | undefined)?.items ?? [];
  const items = node.items.map((item, index) => {
    const value = nodeOf(text, item);
    const dash = tokens[index]?.start.find((token) => token.type === "seq-item-ind");
    return { from: dash?.offset ?? value?.from ?? from, value };
  });
  const last = items[items.length - 1];
  const end = last ? (last.value?.to ?? last.from + 1) : from;
  return { kind: "list", from, to: flow ? to : end, flow, closed, indent: flow ? -1 : columnOf(text, from), items };
}

function frameOf(node: YAMLMap | YAMLSeq): { from: number; to: number; flow: boolean; closed: boolean } {
  const [from = 0, to = 0] = node.range ?? [];
  const token = node.srcToken as CST.Token | undefined;
  if (token?.type !== "flow-collection") return { from, to, flow: false, closed: true };
  return { from, to, flow: true, closed: token.end.some(({ type }) => type === "flow-map-end" || type === "flow-seq-end") };
}
