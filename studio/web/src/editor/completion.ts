// The schema's offers as the editor's own completions.
import { snippet, type Completion, type CompletionContext, type CompletionResult } from "@codemirror/autocomplete";
import { offersAt, type Offer } from "../schema/complete";
import type { SchemaBook } from "../schema/schema";

export function completer(book: () => SchemaBook | null, names: () => { name: string; about: string }[]) {
  return (context: CompletionContext): CompletionResult | null => {
    const schema = book();
    if (!schema) return null;
    const text = context.state.doc.toString();
    const found = offersAt(text, context.pos, schema, names());
    if (!found) return null;
    const typed = text.slice(found.from, context.pos);
    const isBlankLine = context.state.doc.lineAt(context.pos).text.trim() === "";
    if (!context.explicit && typed === "" && (found.place.role === "key" ? !found.place.flow || isBlankLine : false)) return null;
    return { from: found.from, options: found.offers.map(asCompletion), validFor: /^[\w.:"# -]*$/ };
  };
}

function asCompletion(offer: Offer, index: number): Completion {
  return {
    label: offer.label,
    detail: offer.detail,
    ...(offer.info ? { info: offer.info } : {}),
    type: offer.kind === "key" ? "property" : offer.kind === "word" ? "enum" : "namespace",
    apply: snippet(offer.insert),
    // In the schema's order, which is the order in which one would say things.
    sortText: String(index).padStart(4, "0"),
  };
}
