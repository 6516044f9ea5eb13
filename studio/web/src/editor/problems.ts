// What the program finds wrong, under the words that it means, with the word that it takes them for as a fix.
import type { Diagnostic } from "@codemirror/lint";
import type { Problem } from "../protocol/types";
import { offsetOf } from "../yaml/edit";

export function diagnosticsOf(text: string, file: string, problems: Problem[]): Diagnostic[] {
  return problems
    .filter((problem) => problem.file === file)
    .map((problem) => {
      const { from, to } = spanOf(text, problem);
      const fix = problem.fix;
      return {
        from, to, severity: problem.severity, message: problem.message,
        ...(fix ? { actions: [{ name: `Write ${fix}`, apply: (view, start, end) => view.dispatch({ changes: { from: start, to: end, insert: fix }, userEvent: "input.fix" }) }] } : {}),
      } satisfies Diagnostic;
    })
    .sort((a, b) => a.from - b.from);
}

/** A problem without a place is the file's; one without an end is the word's that begins there, or the line's. */
export function spanOf(text: string, problem: Problem): { from: number; to: number } {
  if (!problem.line) {
    const end = text.indexOf("\n");
    return { from: 0, to: end < 0 ? text.length : end };
  }
  const from = offsetOf(text, problem.line, problem.column ?? 1);
  if (problem.end_line && problem.end_column) {
    return { from, to: Math.max(from, offsetOf(text, problem.end_line, problem.end_column)) };
  }
  const word = /^[^\s,:{}[\]]+/.exec(text.slice(from, from + 80));
  const line = text.indexOf("\n", from);
  return { from, to: word ? from + word[0].length : line < 0 ? text.length : line };
}
