// Which numbers a file has, in the order in which the simulation asks for them: how it grows, where it would like to go,
// what it may not do, what it likes best, the light, what it looks like.
import { isCurve, isMapping, type KeyInfo, type SchemaBook } from "../schema/schema";
import { numberKind } from "../schema/numbers";
import { nodeAt, type Path, type YamlNode } from "../yaml/tree";
import { dialAt, type Dial } from "./dial";

export interface Section {
  name: string;
  words: string;
  /** The mapping that it stands for. */
  path: Path;
  /** Those that the text, a base or this page's own choice puts in front. */
  front: Dial[];
  rest: Dial[];
}

const rulesOrder = ["random_tree", "colonization", "diffusion", "bias", "require", "prefer", "light", "elements", "stem"];
const processes = ["random_tree", "colonization", "diffusion"];
const sceneOrder = ["world", "sky", "sun", "plants", "interreflection", "image", "film"];

/** What most people turn first: shown though the text says nothing of it. */
const wanted = new Set([
  "random_tree.length", "random_tree.branch_angle", "random_tree.branch_age_range", "random_tree.wander.angle",
  "bias.up", "bias.light.amount", "bias.toward", "bias.twist.amount", "require.proximity.max", "require.exposure.min",
  "prefer.proximity", "light.boost", "light.blend.sun", "stem.radius", "stem.exponent",
  "elements.#.per_segment", "elements.#.size", "elements.#.face",
  "colonization.step", "colonization.kill", "colonization.influence", "diffusion.distance", "diffusion.gap.min", "diffusion.turn", "diffusion.fill",
  "world.voxel", "sun.tilt", "sun.toward", "sun.shadow_hour", "sky.brightness", "iterations", "seed",
]);

export const planKey = (path: Path): string => path.map((step) => (typeof step === "number" ? "#" : step)).join(".");

/** The whole file's own numbers come first; a rule file has none. */
export function planOf(book: SchemaBook, kind: "rules" | "scene", root: YamlNode | null, bases: (YamlNode | null)[]): Section[] {
  const top = book.keys([]);
  const process = processOf(root, bases);
  const order = kind === "rules" ? rulesOrder.filter((name) => !processes.includes(name) || name === process) : sceneOrder;
  const sections: Section[] = [];
  const own = top.map((info) => dialAt([info.name], info, root, bases)).filter((dial): dial is Dial => !!dial);
  if (own.length) sections.push(section("growth", "How long it grows, and by which random numbers.", [], own));
  for (const name of order) {
    const info = top.find((each) => each.name === name);
    if (!info) continue;
    const count = listLength(root, bases, name);
    const prefixes: { title: string; path: Path }[] = count === null ? [{ title: name.replace("_", " "), path: [name] }]
      : Array.from({ length: count }, (_, i) => ({ title: titleOf(root, bases, name, i), path: [name, i] }));
    for (const { title, path } of prefixes) {
      const dials = dialsUnder(book, path, root, bases, 0);
      if (dials.length) sections.push(section(title, info.schema.description ?? "", path, dials));
    }
  }
  return sections;
}

function section(name: string, words: string, path: Path, dials: Dial[]): Section {
  const inFront = (dial: Dial) => dial.source === "text" || dial.source === "base" || wanted.has(planKey(dial.path));
  return { name, words, path, front: dials.filter(inFront), rest: dials.filter((dial) => !inFront(dial)) };
}

function dialsUnder(book: SchemaBook, path: Path, root: YamlNode | null, bases: (YamlNode | null)[], depth: number): Dial[] {
  const found: Dial[] = [];
  for (const info of book.keys(path)) {
    const here = [...path, info.name];
    const mapping = info.choices.some((each) => isMapping(each) && !isCurve(each));
    if (mapping && depth < 2 && !isRuleSet(info)) {
      const said = [root, ...bases].some((each) => nodeAt(each, here)?.kind === "scalar");
      // A number that is short for a mapping is turned where it stands.
      if (said && numberKind(info)) pushDial(found, dialAt(here, info, root, bases));
      else found.push(...dialsUnder(book, here, root, bases, depth + 1));
      continue;
    }
    pushDial(found, dialAt(here, info, root, bases));
  }
  return found;
}

function pushDial(found: Dial[], dial: Dial | null): void {
  if (dial) found.push(dial);
}

const isRuleSet = (info: KeyInfo): boolean => info.choices.some((each) => !!each.properties?.["random_tree"]);

function processOf(root: YamlNode | null, bases: (YamlNode | null)[]): string {
  for (const each of [root, ...bases]) {
    const said = nodeAt(each, ["propagate"]);
    if (said?.kind === "scalar" && processes.includes(said.text)) return said.text;
  }
  return "random_tree";
}

function listLength(root: YamlNode | null, bases: (YamlNode | null)[], name: string): number | null {
  if (name !== "elements") return null;
  for (const each of [root, ...bases]) {
    const list = nodeAt(each, [name]);
    if (list?.kind === "list") return list.items.length;
  }
  return 0;
}

function titleOf(root: YamlNode | null, bases: (YamlNode | null)[], name: string, index: number): string {
  for (const each of [root, ...bases]) {
    const said = nodeAt(each, [name, index, "name"]);
    if (said?.kind === "scalar") return said.text;
    if (nodeAt(each, [name])) break;
  }
  return `element ${index + 1}`;
}
