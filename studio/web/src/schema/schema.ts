// Our JSON Schema as the page asks it: what may stand at a path, in words. The schema is data that the program sends, so
// that a key which is new there is known here without a word.
import type { Path } from "../yaml/tree";

export interface Schema {
  $ref?: string;
  description?: string;
  default?: unknown;
  type?: string | string[];
  enum?: unknown[];
  const?: unknown;
  examples?: unknown[];
  properties?: Record<string, Schema>;
  additionalProperties?: boolean | Schema;
  patternProperties?: Record<string, Schema>;
  required?: string[];
  items?: Schema | boolean;
  prefixItems?: Schema[];
  anyOf?: Schema[];
  oneOf?: Schema[];
  allOf?: Schema[];
  minimum?: number;
  maximum?: number;
  exclusiveMinimum?: number;
  exclusiveMaximum?: number;
  pattern?: string;
  minItems?: number;
  maxItems?: number;
  $defs?: Record<string, Schema>;
}

export interface KeyInfo {
  name: string;
  schema: Schema;
  /** All that may stand there, references followed. */
  choices: Schema[];
}

export class SchemaBook {
  constructor(readonly root: Schema) {}

  /** A schema's alternatives, each without references or unions. */
  choices(schema: Schema | undefined, depth = 0): Schema[] {
    if (!schema || depth > 12) return [];
    if (schema.$ref) return this.choices(this.follow(schema.$ref), depth + 1);
    const unions = schema.anyOf ?? schema.oneOf;
    const own = schema.properties || schema.type || schema.enum || !unions ? [schema] : [];
    return [...own, ...(unions ?? []).flatMap((each) => this.choices(each, depth + 1))];
  }

  /** What may stand at a path; empty where nothing may. */
  at(path: Path): Schema[] {
    return path.reduce<Schema[]>((found, step) => found.flatMap((each) => this.step(each, step)), this.choices(this.root));
  }

  /** The schema that says what the key at the end of a path means, before its unions. */
  keyAt(path: Path): KeyInfo | null {
    const last = path[path.length - 1];
    if (typeof last !== "string") return null;
    for (const holder of this.at(path.slice(0, -1))) {
      const schema = this.property(holder, last);
      if (schema) return { name: last, schema, choices: this.choices(schema) };
    }
    return null;
  }

  /** Keys that may stand in the mapping at a path, in the schema's order. */
  keys(path: Path): KeyInfo[] {
    const found = new Map<string, KeyInfo>();
    for (const holder of this.at(path)) {
      for (const [name, schema] of Object.entries(holder.properties ?? {})) {
        if (!found.has(name)) found.set(name, { name, schema, choices: this.choices(schema) });
      }
    }
    return [...found.values()];
  }

  private follow(ref: string): Schema | undefined {
    return ref
      .replace(/^#\/?/, "")
      .split("/")
      .filter((part) => part !== "")
      .reduce<unknown>((node, part) => (node as Record<string, unknown> | undefined)?.[part], this.root) as Schema | undefined;
  }

  private property(holder: Schema, name: string): Schema | undefined {
    const own = holder.properties?.[name];
    if (own) return own;
    for (const [pattern, schema] of Object.entries(holder.patternProperties ?? {})) {
      if (new RegExp(pattern).test(name)) return schema;
    }
    return typeof holder.additionalProperties === "object" ? holder.additionalProperties : undefined;
  }

  private step(holder: Schema, step: string | number): Schema[] {
    if (typeof step === "string") return this.choices(this.property(holder, step));
    const item = holder.prefixItems?.[step] ?? (typeof holder.items === "object" ? holder.items : undefined);
    return this.choices(item);
  }
}

export const typesOf = (schema: Schema): string[] => (schema.type === undefined ? [] : [schema.type].flat());

export const isMapping = (schema: Schema): boolean => typesOf(schema).includes("object") || !!schema.properties;

/** `{over, points}`: a number as a curve, which is no mapping that one would complete first. */
export const isCurve = (schema: Schema): boolean => !!schema.properties?.["over"] && !!schema.properties["points"];

/** The words of an enumeration, and true and false. */
export function wordsOf(choices: Schema[]): string[] {
  const words = choices.flatMap((each) => [
    ...(each.enum ?? []).map(String),
    ...(each.const === undefined ? [] : [String(each.const)]),
    ...(typesOf(each).includes("boolean") ? ["true", "false"] : []),
  ]);
  return [...new Set(words)];
}

/** A description ends in "Unit: degrees." where its value has one; the two are told apart. */
export function describe(schema: Schema): { words: string; unit: string } {
  const text = schema.description ?? "";
  const found = /\s*Unit: ([^.]+)\.\s*$/.exec(text);
  return found ? { words: text.slice(0, found.index), unit: found[1] ?? "" } : { words: text, unit: "" };
}

/** A value as YAML would have it on one line. */
export function inYaml(value: unknown): string {
  if (Array.isArray(value)) return `[${value.map(inYaml).join(", ")}]`;
  if (value !== null && typeof value === "object") {
    return `{${Object.entries(value).map(([key, each]) => `${key}: ${inYaml(each)}`).join(", ")}}`;
  }
  return typeof value === "string" && /^[#&*!|>%@`"'{[]|: |^$/.test(value) ? JSON.stringify(value) : String(value);
}
