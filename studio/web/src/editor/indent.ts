// Where a new line begins: the language's own rule takes a line that ends in a comment for the end of its mapping.
import { indentService, type IndentContext } from "@codemirror/language";

/** The column for the line after this one, in a text that is indented by `unit`. */
export function columnAfter(line: string, unit: number): number {
  const blank = /^\s*/.exec(line)?.[0].length ?? 0;
  const dashes = /^\s*(?:-\s+)*/.exec(line)?.[0].length ?? 0;
  const words = line.slice(dashes).replace(/(^|\s)#.*$/, "").trimEnd();
  if (/[:[{]$/.test(words)) return dashes + unit;
  const isKey = /^(?:"[^"]*"|'[^']*'|[^\s"'[{#][^:#]*):(\s|$)/.test(words);
  return isKey ? dashes : blank;
}

export const indentation = indentService.of((context: IndentContext, at: number) =>
  context.simulatedBreak === at ? columnAfter(context.lineAt(at, -1).text, context.unit) : undefined,
);
