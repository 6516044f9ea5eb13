// Where another hand has changed the open file: mine or theirs, as its writer says and never silently.
import { make, refill } from "../base/dom";
import type { Editor } from "../editor/editor";
import type { Workspace } from "../editor/workspace";

export function conflictBar(place: HTMLElement, workspace: Workspace, editor: Editor): void {
  const draw = (): void => {
    const file = workspace.file(editor.active.value);
    place.hidden = !file?.theirs;
    if (!file?.theirs) return;
    place.setAttribute("role", "alert");
    refill(place,
      make("p", {}, `Another program has changed ${file.name}.`),
      make("button", { class: "button is-plain", type: "button", onclick: () => workspace.keepMine(file.name) }, "Keep mine"),
      make("button", { class: "button is-main", type: "button", onclick: () => take(file.name) }, "Take theirs"));
  };
  const take = (name: string): void => {
    const text = workspace.takeTheirs(name);
    if (text === null) return;
    editor.replaceAll(name, text);
    workspace.write(name, text);
    workspace.files.tell();
  };
  workspace.files.onChange(draw);
  editor.active.onChange(draw);
}
