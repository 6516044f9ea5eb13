// A tab for each file: rules first, then the scene, then what they build on.
import { make, refill } from "../base/dom";
import type { OpenFile, Workspace } from "../editor/workspace";

export class Tabs {
  constructor(private readonly list: HTMLElement, private readonly workspace: Workspace, private readonly show: (name: string) => void) {
    list.addEventListener("keydown", (event) => this.key(event));
    workspace.files.onChange(() => this.draw());
    workspace.problems.onChange(() => this.draw());
  }

  private active = "";

  set current(name: string) {
    this.active = name;
    this.draw();
  }

  static order(files: OpenFile[]): OpenFile[] {
    const rank = (file: OpenFile) => (file.library ? 2 : file.kind === "rules" ? 0 : 1);
    return [...files].sort((a, b) => rank(a) - rank(b));
  }

  private draw(): void {
    const focused = this.list.contains(document.activeElement);
    refill(this.list, ...Tabs.order(this.workspace.files.value).map((file) => this.tab(file)));
    if (focused) this.list.querySelector<HTMLElement>("[aria-selected=true]")?.focus();
  }

  private tab(file: OpenFile): HTMLElement {
    const selected = file.name === this.active;
    const faults = this.workspace.problems.value.filter((each) => each.file === file.name && each.severity === "error").length;
    const short = file.name.slice(file.name.lastIndexOf("/") + 1).replace(/^library:/, "");
    const words = [file.library ? "of the library, to be read" : file.kind, file.unsaved ? "not saved" : "", faults ? `${faults} errors` : ""].filter(Boolean).join(", ");
    return make("button", {
      class: "tab", type: "button", role: "tab", "aria-selected": String(selected), tabindex: selected ? 0 : -1, "aria-controls": "editor",
      title: `${file.name}: ${words}`, "aria-label": `${short}, ${words}`, "data-file": file.name, onclick: () => this.show(file.name),
    },
    make("span", {}, short),
    file.library ? make("span", { class: "what" }, "library") : null,
    faults ? make("span", { class: "count" }, String(faults)) : null,
    file.unsaved ? make("span", { class: "dot" }) : null);
  }

  private key(event: KeyboardEvent): void {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (step === undefined) return;
    const names = Tabs.order(this.workspace.files.value).map((file) => file.name);
    const next = names[(names.indexOf(this.active) + step + names.length) % names.length];
    event.preventDefault();
    if (next) this.show(next);
  }
}
