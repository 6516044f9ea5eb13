// One number of a file: what stands in the text, what holds where nothing does, and how a turn of the slider is written.
import { inYaml } from "../schema/schema";
import { numberKind, reach, type NumberKind } from "../schema/numbers";
import type { KeyInfo } from "../schema/schema";
import { readAmount, writeAmount } from "../yaml/amount";
import { setValue, type Change } from "../yaml/edit";
import { nodeAt, type Path, type YamlNode } from "../yaml/tree";

export type Source = "text" | "base" | "default" | "nothing";

export interface Dial {
  path: Path;
  kind: NumberKind;
  info: KeyInfo;
  /** Where its value comes from. */
  source: Source;
  /** One number, or a range's two. */
  values: number[];
  unit: string;
  low: number;
  high: number;
  /** The text says something else there than a number or a range, such as a curve. */
  other: boolean;
}

export function dialAt(path: Path, info: KeyInfo, root: YamlNode | null, bases: (YamlNode | null)[]): Dial | null {
  const kind = numberKind(info);
  if (!kind) return null;
  const own = nodeAt(root, path);
  const inherited = own ? null : (bases.map((base) => nodeAt(base, path)).find((node) => node) ?? null);
  const found = own ?? inherited;
  const source: Source = own ? "text" : inherited ? "base" : info.schema.default === undefined ? "nothing" : "default";
  const read = found ? readValues(found) : readDefault(info.schema.default);
  const values = read?.values ?? [Number.isFinite(kind.low) ? Math.max(0, kind.low) : 0];
  const unit = read?.unit ?? "";
  const ends = reach(kind, read ? values : [], unit);
  return { path, kind, info, source, values, unit, ...ends, low: Math.min(ends.low, ...values), high: Math.max(ends.high, ...values), other: !!found && !read };
}

function readValues(node: YamlNode): { values: number[]; unit: string } | null {
  if (node.kind === "scalar") {
    const amount = readAmount(node.text);
    return amount ? { values: [amount.value], unit: amount.unit } : null;
  }
  if (node.kind !== "list" || node.items.length !== 2) return null;
  const ends = node.items.map((item) => (item.value?.kind === "scalar" ? readAmount(item.value.text) : null));
  const [first, second] = ends;
  if (!first || !second || first.unit !== second.unit) return null;
  return { values: [first.value, second.value], unit: first.unit };
}

function readDefault(value: unknown): { values: number[]; unit: string } | null {
  if (typeof value === "number") return { values: [value], unit: "" };
  if (typeof value === "string") {
    const amount = readAmount(value);
    return amount ? { values: [amount.value], unit: amount.unit } : null;
  }
  if (Array.isArray(value) && value.length === 2 && value.every((each) => typeof each === "number")) return { values: value as number[], unit: "" };
  return null;
}

/** The change of the text that sets it, with the unit that it had. */
export function turned(text: string, dial: Dial, values: number[], step: number): Change | null {
  const parts = values.map((value) => writeAmount({ value, unit: dial.unit }, step));
  return setValue(text, dial.path, parts.length === 2 ? `[${parts.join(", ")}]` : (parts[0] ?? ""));
}

export function dialWords(dial: Dial): string {
  if (dial.other) return "as written";
  if (dial.source === "nothing") return "free";
  const parts = dial.values.map((value) => inYaml(Number(value.toPrecision(6))));
  return parts.join(" – ") + (dial.unit ? ` ${dial.unit}` : shortUnit(dial.kind.unit));
}

/** What stands behind a number without a unit of its own. */
export function shortUnit(unit: string): string {
  const short: Record<string, string> = { degrees: "°", "voxel widths": " vx", metres: " m", pixels: " px" };
  return short[unit] ?? "";
}
