// What a file builds on, as far as this page has its text: `base` and its own base, nearest first.
import type { LibraryRules } from "../protocol/types";
import { nodeAt, parseYaml, type YamlNode } from "../yaml/tree";

export function basesOf(root: YamlNode | null, fileNamed: (name: string) => string | null, library: LibraryRules[]): YamlNode[] {
  const found: YamlNode[] = [];
  let at = root;
  for (let depth = 0; depth < 8; depth++) {
    const said = nodeAt(at, ["base"]);
    if (said?.kind !== "scalar") break;
    const text = fileNamed(said.text) ?? library.find((each) => each.name === said.text)?.text ?? null;
    const next = text === null ? null : parseYaml(text);
    if (!next) break;
    found.push(next);
    at = next;
  }
  return found;
}

/** The project's file that a name in another file means: by its last part, since the program names files as it likes. */
export function fileMeant(name: string, files: { name: string }[]): string | null {
  const last = (path: string) => path.slice(path.lastIndexOf("/") + 1);
  const found = files.find((each) => each.name === name) ?? files.find((each) => last(each.name) === last(name));
  return found?.name ?? null;
}
