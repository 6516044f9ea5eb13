// YAML as this project's files use it, read so that half-written text still has a shape: keys, values and where they
// stand. It never fails; the program says what is wrong. Places are offsets into the text.
// Where a bracket is not closed, the next line that stands no deeper than what holds it ends it all the same.

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
  return new Parser(text).document();
}

export function child(node: YamlNode | null, step: string | number): YamlNode | null {
  if (node?.kind === "map") return node.entries.find((entry) => entry.key === String(step))?.value ?? null;
  if (node?.kind === "list" && typeof step === "number") return node.items[step]?.value ?? null;
  return null;
}

export function nodeAt(root: YamlNode | null, path: Path): YamlNode | null {
  return path.reduce<YamlNode | null>((node, step) => child(node, step), root);
}

const keyLine = /^(?:"(?:[^"\\]|\\.)*"|'(?:[^']|'')*'|[^\s#:,[\]{}"'&*!|>%@`-][^#:]*?|-[^\s:#][^#:]*?)\s*:(?=\s|$)/;

export function columnOf(text: string, at: number): number {
  return at - (text.lastIndexOf("\n", at - 1) + 1);
}

class Parser {
  private at = 0;

  constructor(private readonly text: string) {}

  document(): YamlNode | null {
    this.skipToContent();
    if (this.text.startsWith("---", this.at)) {
      this.at = this.lineEnd(this.at);
      this.skipToContent();
    }
    return this.at < this.text.length ? this.block(-1) : null;
  }

  private lineEnd(at: number): number {
    const end = this.text.indexOf("\n", at);
    return end < 0 ? this.text.length : end;
  }

  private rest(at = this.at): string {
    return this.text.slice(at, this.lineEnd(at));
  }

  /** Over blanks, comments and empty lines, to the next sign that says something. */
  private skipToContent(): void {
    while (this.at < this.text.length) {
      const sign = this.text[this.at];
      if (sign === "#" && (this.at === 0 || /\s/.test(this.text[this.at - 1] ?? ""))) this.at = this.lineEnd(this.at);
      else if (sign === " " || sign === "\n" || sign === "\t" || sign === "\r") this.at += 1;
      else return;
    }
  }

  /** What stands deeper than `outer` from here on; a list may stand at its key's own column. */
  private block(outer: number): YamlNode | null {
    const column = columnOf(this.text, this.at);
    if (column <= outer || this.at >= this.text.length) return null;
    return this.node(outer);
  }

  private node(outer: number): YamlNode {
    const line = this.rest();
    if (/^-(\s|$)/.test(line)) return this.list();
    if (keyLine.test(line)) return this.map();
    const sign = line[0];
    if (sign === "{" || sign === "[") return this.flow(outer);
    if (this.isHalfMap()) return this.map();
    return this.scalar(outer);
  }

  /** A word on a line of its own, above or below which keys stand at the same column: a key that is being written. */
  private isHalfMap(): boolean {
    const before = this.at;
    const column = columnOf(this.text, before);
    if (this.text.slice(before - column, before).trim() !== "") return false;
    this.at = this.lineEnd(before);
    this.skipToContent();
    const next = this.at < this.text.length && columnOf(this.text, this.at) === column && keyLine.test(this.rest());
    this.at = before;
    return next;
  }

  private map(): YamlMap {
    const from = this.at;
    const indent = columnOf(this.text, from);
    const map: YamlMap = { kind: "map", from, to: from, flow: false, closed: true, indent, entries: [] };
    while (this.at < this.text.length && columnOf(this.text, this.at) === indent) {
      const line = this.rest();
      if (/^-(\s|$)/.test(line)) break;
      const found = keyLine.exec(line);
      const keyFrom = this.at;
      if (!found) {
        const word = plainEnd(line);
        map.entries.push({ key: line.slice(0, word), keyFrom, keyTo: keyFrom + word, colon: -1, value: null });
        map.to = keyFrom + word;
        this.at = this.lineEnd(keyFrom);
        this.skipToContent();
        continue;
      }
      const key = found[0].slice(0, -1).trimEnd();
      this.at = keyFrom + found[0].length;
      const entry: YamlEntry = { key: unquoted(key), keyFrom, keyTo: keyFrom + key.length, colon: this.at, value: null };
      map.to = this.at;
      entry.value = this.valueOf(indent);
      if (entry.value) map.to = entry.value.to;
      map.entries.push(entry);
      this.skipToContent();
    }
    return map;
  }

  private valueOf(indent: number): YamlNode | null {
    const line = this.lineEnd(this.at);
    this.skipToContent();
    if (this.at >= this.text.length) return null;
    if (this.at < line) return this.inline(indent);
    const column = columnOf(this.text, this.at);
    if (column > indent) return this.node(indent);
    return column === indent && /^-(\s|$)/.test(this.rest()) ? this.list() : null;
  }

  /** Behind a key on its line: no further key may begin there. */
  private inline(outer: number): YamlNode {
    const sign = this.text[this.at];
    if (sign === "{" || sign === "[") return this.flow(outer);
    return this.scalar(outer);
  }

  private list(): YamlList {
    const from = this.at;
    const indent = columnOf(this.text, from);
    const list: YamlList = { kind: "list", from, to: from, flow: false, closed: true, indent, items: [] };
    while (this.at < this.text.length && columnOf(this.text, this.at) === indent && /^-(\s|$)/.test(this.rest())) {
      const item = { from: this.at, value: null as YamlNode | null };
      list.to = this.at + 1;
      const line = this.lineEnd(this.at);
      this.at += 1;
      this.skipToContent();
      if (this.at < line || columnOf(this.text, this.at) > indent) item.value = this.at < this.text.length ? this.node(indent) : null;
      if (item.value) list.to = item.value.to;
      list.items.push(item);
      this.skipToContent();
    }
    return list;
  }

  private scalar(outer: number): YamlScalar {
    const from = this.at;
    const line = this.rest();
    const sign = line[0] ?? "";
    if (sign === "|" || sign === ">") {
      this.at = this.lineEnd(from);
      let to = this.at;
      while (this.at < this.text.length) {
        const start = this.at + 1;
        const next = this.text.slice(start, this.lineEnd(start));
        if (next.trim() !== "" && next.length - next.trimStart().length <= outer) break;
        this.at = this.lineEnd(start);
        to = this.at;
      }
      return { kind: "scalar", from, to, text: this.text.slice(from, to) };
    }
    const length = sign === '"' || sign === "'" ? quotedEnd(line) : plainEnd(line);
    this.at = this.lineEnd(from);
    return { kind: "scalar", from, to: from + length, text: unquoted(line.slice(0, length)) };
  }

  private flow(outer: number): YamlMap | YamlList {
    const from = this.at;
    const isMap = this.text[from] === "{";
    const close = isMap ? "}" : "]";
    const map: YamlMap = { kind: "map", from, to: from, flow: true, closed: false, indent: -1, entries: [] };
    const list: YamlList = { kind: "list", from, to: from, flow: true, closed: false, indent: -1, items: [] };
    const node = isMap ? map : list;
    this.at += 1;
    for (;;) {
      const line = this.lineEnd(this.at);
      const before = this.at;
      this.skipToContent();
      if (this.at >= this.text.length || this.leavesFlow(line, outer)) {
        node.to = Math.min(line, this.text.length);
        if (this.at > line) this.at = Math.max(this.at, before);
        return node;
      }
      const sign = this.text[this.at] ?? "";
      if (sign === "," || sign === ":") {
        this.at += 1;
      } else if (sign === "}" || sign === "]") {
        this.at += 1;
        node.to = this.at;
        node.closed = sign === close;
        return node;
      } else if (isMap) map.entries.push(this.flowEntry(outer));
      else list.items.push({ from: this.at, value: this.flowValue(outer, false) });
      node.to = this.at;
    }
  }

  /** A line that stands no deeper than what holds the bracket and begins with a key is not inside any more. */
  private leavesFlow(line: number, outer: number): boolean {
    if (this.at <= line) return false;
    const text = this.rest();
    return columnOf(this.text, this.at) <= Math.max(outer, 0) && (keyLine.test(text) || /^-\s/.test(text));
  }

  private flowEntry(outer: number): YamlEntry {
    const keyFrom = this.at;
    const key = this.flowValue(outer, true);
    const keyTo = key.to;
    const line = this.lineEnd(this.at);
    while (this.at < line && this.text[this.at] === " ") this.at += 1;
    const entry: YamlEntry = { key: key.kind === "scalar" ? key.text : "", keyFrom, keyTo, colon: -1, value: null };
    if (this.text[this.at] !== ":") return entry;
    this.at += 1;
    entry.colon = this.at;
    const end = this.lineEnd(this.at);
    const behind = this.at;
    this.skipToContent();
    if (this.at >= this.text.length || this.leavesFlow(end, outer)) this.at = behind;
    else if (!/[,}\]]/.test(this.text[this.at] ?? "")) entry.value = this.flowValue(outer, false);
    return entry;
  }

  private flowValue(outer: number, isKey: boolean): YamlNode {
    const sign = this.text[this.at] ?? "";
    if (sign === "{" || sign === "[") return this.flow(outer);
    const from = this.at;
    const line = this.rest();
    let length = 0;
    if (sign === '"' || sign === "'") length = quotedEnd(line);
    else {
      const stop = isKey ? /[,{}[\]]|:|\s#/ : /[,{}[\]]|:(?=\s|$)|\s#/;
      const found = stop.exec(line);
      length = (found ? line.slice(0, found.index) : line).trimEnd().length;
    }
    this.at = from + Math.max(1, length);
    return { kind: "scalar", from, to: this.at, text: unquoted(line.slice(0, Math.max(1, length))) };
  }
}

function plainEnd(line: string): number {
  const comment = /\s#/.exec(line);
  return (comment ? line.slice(0, comment.index) : line).trimEnd().length;
}

function quotedEnd(line: string): number {
  const found = (line[0] === '"' ? /^"(?:[^"\\]|\\.)*"/ : /^'(?:[^']|'')*'/).exec(line);
  return found ? found[0].length : plainEnd(line);
}

function unquoted(text: string): string {
  if (text.length >= 2 && text[0] === '"' && text.endsWith('"')) {
    return text.slice(1, -1).replace(/\\(["\\/])/g, "$1");
  }
  if (text.length >= 2 && text[0] === "'" && text.endsWith("'")) return text.slice(1, -1).replaceAll("''", "'");
  return text;
}
