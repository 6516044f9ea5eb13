// What may be written at the cursor, from the schema alone: keys that are not there yet, words of enumerations.
// Knows nothing of the editor, so that it can be tried without one.
import { placeAt, type CursorPlace } from "../yaml/cursor";
import { describe, inYaml, isCurve, isMapping, typesOf, wordsOf, type KeyInfo, type SchemaBook } from "./schema";

export interface Offer {
  label: string;
  /** Behind the label: a unit, the default, what kind of value it takes. */
  detail: string;
  info: string;
  kind: "key" | "word" | "name";
  /** As a snippet: ${} are places to fill in. */
  insert: string;
}

export interface Offers {
  from: number;
  place: CursorPlace;
  offers: Offer[];
}

/** `names` are those of rule sets, for keys that want one. */
export function offersAt(text: string, at: number, book: SchemaBook, names: { name: string; about: string }[]): Offers | null {
  const place = placeAt(text, at);
  if (!place) return null;
  const offers = place.role === "key" ? keyOffers(place, book) : valueOffers(place, book, names);
  return offers.length ? { from: place.wordFrom, place, offers } : null;
}

function keyOffers(place: CursorPlace, book: SchemaBook): Offer[] {
  return book
    .keys(place.path)
    .filter((key) => !place.given.includes(key.name))
    .map((key) => {
      const { words, unit } = describe(key.schema);
      const fallback = key.schema.default === undefined ? "" : inYaml(key.schema.default);
      return { label: key.name, detail: [fallback, unit].filter(Boolean).join(" "), info: words, kind: "key" as const, insert: keySnippet(key, place) };
    });
}

function keySnippet(key: KeyInfo, place: CursorPlace): string {
  const fallback = key.schema.default;
  const first = key.choices.find((each) => !isCurve(each));
  const inside = " ".repeat(Math.max(0, place.indent) + 2);
  if (fallback !== undefined) return `${key.name}: \${${escaped(inYaml(fallback))}}`;
  const words = wordsOf(key.choices);
  if (words.length) return `${key.name}: \${${words[0]}}`;
  if (first && typesOf(first).includes("array") && !key.choices.some((each) => typesOf(each).includes("number"))) {
    const holdsMappings = typeof first.items === "object" && !!(first.items.properties ?? first.items.anyOf);
    return !place.flow && holdsMappings ? `${key.name}:\n${inside}- \${}` : `${key.name}: [\${}]`;
  }
  if (key.choices.some((each) => isMapping(each) && !isCurve(each)) && !key.choices.some((each) => typesOf(each).includes("number") || typesOf(each).includes("string"))) {
    return place.flow ? `${key.name}: {\${}\\}` : `${key.name}:\n${inside}\${}`;
  }
  return `${key.name}: \${}`;
}

const escaped = (text: string): string => text.replace(/[{}\\]/g, (sign) => `\\${sign}`);

function valueOffers(place: CursorPlace, book: SchemaBook, names: { name: string; about: string }[]): Offer[] {
  const key = book.keyAt(place.path);
  const choices = key ? key.choices : book.at(place.path);
  const offers: Offer[] = wordsOf(choices).map((word) => ({ label: word, detail: "", info: "", kind: "word", insert: escaped(word) }));
  if (key && ["base", "rules", "otherwise", "branches", "twigs"].includes(key.name)) {
    offers.push(...names.map(({ name, about }) => ({ label: name, detail: "", info: about, kind: "name" as const, insert: escaped(name) })));
  }
  const fallback = key?.schema.default;
  if (key && fallback !== undefined && !offers.some((each) => each.label === inYaml(fallback))) {
    offers.push({ label: inYaml(fallback), detail: "where nothing is said", info: "", kind: "word", insert: escaped(inYaml(fallback)) });
  }
  return offers;
}
