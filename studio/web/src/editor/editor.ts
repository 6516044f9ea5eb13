// The editor: one view, and a state with its own undo for each file, so that going to another tab and back loses nothing.
import { autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap, type CompletionSource } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap, indentWithTab, isolateHistory } from "@codemirror/commands";
import { bracketMatching, indentOnInput, indentUnit } from "@codemirror/language";
import { yaml } from "@codemirror/lang-yaml";
import { lintKeymap, setDiagnostics } from "@codemirror/lint";
import { highlightSelectionMatches, searchKeymap } from "@codemirror/search";
import { EditorState, Transaction, type Extension, type TransactionSpec } from "@codemirror/state";
import { drawSelection, EditorView, highlightActiveLine, highlightActiveLineGutter, keymap, lineNumbers, tooltips } from "@codemirror/view";
import { Signal } from "../base/signal";
import type { Change } from "../yaml/edit";
import { indentation } from "./indent";
import { look } from "./look";
import { diagnosticsOf } from "./problems";
import type { Workspace } from "./workspace";

export interface EditorParts {
  completion: (file: string) => CompletionSource;
  hover: (file: string) => Extension;
  save: () => void;
}

export class Editor {
  readonly active = new Signal("");
  /** Tells the active file's text, at each change of it and of the tab. */
  readonly text = new Signal("");
  readonly view: EditorView;
  private readonly states = new Map<string, EditorState>();
  private readonly places = new Map<string, number>();
  private dragged: { file: string; from: string } | null = null;

  constructor(parent: HTMLElement, private readonly workspace: Workspace, private readonly parts: EditorParts) {
    this.view = new EditorView({
      parent,
      state: EditorState.create({ doc: "" }),
      dispatchTransactions: (transactions, view) => {
        view.update(transactions);
        if (transactions.some((each) => each.docChanged)) this.wrote(this.active.value, view.state);
      },
    });
    workspace.problems.onChange(() => this.mark());
  }

  /** Opens files that are new and puts another text into those that have one; undo goes over that too. */
  take(names: string[]): void {
    for (const name of names) {
      const file = this.workspace.file(name);
      if (!file) continue;
      const state = this.stateOf(name);
      if (!state) this.keep(name, this.fresh(name, file.text, file.library));
      else if (state.doc.toString() !== file.text) this.replaceAll(name, file.text);
    }
  }

  show(name: string): void {
    const file = this.workspace.file(name);
    if (!file || name === this.active.value) return;
    if (this.active.value) {
      this.states.set(this.active.value, this.view.state);
      this.places.set(this.active.value, this.view.scrollDOM.scrollTop);
    }
    const next = this.states.get(name) ?? this.fresh(name, file.text, file.library);
    this.active.value = name;
    this.view.setState(next);
    this.view.scrollDOM.scrollTop = this.places.get(name) ?? 0;
    this.text.value = next.doc.toString();
    this.mark();
  }

  textOf(name: string): string {
    return this.stateOf(name)?.doc.toString() ?? this.workspace.file(name)?.text ?? "";
  }

  /** One step of undo, in whatever file. */
  change(name: string, changes: Change | Change[], words = "input.dial"): void {
    this.apply(name, { changes, userEvent: words, annotations: isolateHistory.of("full") });
  }

  /** While something is dragged the text follows without a step of undo; `dropped` makes one of the whole way. */
  drag(name: string, change: Change): void {
    if (!this.dragged || this.dragged.file !== name) this.dragged = { file: name, from: this.textOf(name) };
    this.apply(name, { changes: change, annotations: Transaction.addToHistory.of(false) });
  }

  dropped(): void {
    const dragged = this.dragged;
    this.dragged = null;
    if (!dragged) return;
    const now = this.textOf(dragged.file);
    if (now === dragged.from) return;
    const back = difference(now, dragged.from);
    const forth = difference(dragged.from, now);
    this.apply(dragged.file, { changes: back, annotations: Transaction.addToHistory.of(false) });
    this.change(dragged.file, forth);
  }

  replaceAll(name: string, text: string): void {
    this.change(name, difference(this.textOf(name), text), "input.replace");
  }

  /** Puts the cursor there and shows it. */
  goTo(name: string, offset: number, focus = true): void {
    this.show(name);
    const at = Math.min(offset, this.view.state.doc.length);
    this.view.dispatch({ selection: { anchor: at }, effects: EditorView.scrollIntoView(at, { y: "center" }) });
    if (focus) this.view.focus();
  }

  private stateOf(name: string): EditorState | undefined {
    return name === this.active.value ? this.view.state : this.states.get(name);
  }

  private keep(name: string, state: EditorState): void {
    if (name === this.active.value) this.view.setState(state);
    else this.states.set(name, state);
  }

  private apply(name: string, spec: TransactionSpec): void {
    if (this.workspace.file(name)?.library) return;
    if (name === this.active.value) {
      this.view.dispatch(spec);
      return;
    }
    const state = this.stateOf(name);
    if (!state) return;
    const next = state.update(spec).state;
    this.states.set(name, next);
    this.wrote(name, next);
  }

  private wrote(name: string, state: EditorState): void {
    const text = state.doc.toString();
    this.workspace.write(name, text);
    if (name === this.active.value) this.text.value = text;
  }

  private mark(): void {
    const name = this.active.value;
    if (!name) return;
    const diagnostics = diagnosticsOf(this.view.state.doc.toString(), name, this.workspace.problems.value);
    this.view.dispatch(setDiagnostics(this.view.state, diagnostics));
  }

  private fresh(name: string, text: string, readOnly: boolean): EditorState {
    return EditorState.create({
      doc: text,
      extensions: [
        lineNumbers(), highlightActiveLine(), highlightActiveLineGutter(), drawSelection(), history(), indentOnInput(),
        bracketMatching(), closeBrackets(), highlightSelectionMatches(), indentUnit.of("  "), indentation, yaml(), look,
        autocompletion({ override: [this.parts.completion(name)], icons: false }), this.parts.hover(name),
        tooltips({ parent: document.body }),
        EditorState.readOnly.of(readOnly),
        EditorView.contentAttributes.of({ tabindex: "0", "aria-label": readOnly ? `${name}, of the library, to be read` : `The text of ${name}` }),
        keymap.of([
          { key: "Mod-s", run: () => (this.parts.save(), true), preventDefault: true },
          ...closeBracketsKeymap, ...defaultKeymap, ...searchKeymap, ...historyKeymap, ...completionKeymap, ...lintKeymap, indentWithTab,
        ]),
      ],
    });
  }
}

/** The one replacement that makes b of a: what they begin and end with alike stays. */
export function difference(a: string, b: string): Change {
  let from = 0;
  while (from < a.length && from < b.length && a[from] === b[from]) from += 1;
  let [endA, endB] = [a.length, b.length];
  while (endA > from && endB > from && a[endA - 1] === b[endB - 1]) [endA, endB] = [endA - 1, endB - 1];
  return { from, to: endA, insert: b.slice(from, endB) };
}
