// Rule sets of the library, each with its line. One that is chosen is put into the open rule file, as one step of undo;
// where there is no rule file of one's own, the scene's first plant is told to grow by it.
import type { Editor } from "../editor/editor";
import type { Workspace } from "../editor/workspace";
import type { LibraryRules } from "../protocol/types";
import { setValue } from "../yaml/edit";
import { menuButton, type MenuPart } from "./menu";
import type { Notices } from "./notices";

export function presetMenu(library: () => LibraryRules[], workspace: Workspace, editor: Editor, notices: Notices): HTMLButtonElement {
  return menuButton("Presets", "Rule sets of the library", () =>
    library().map((rules): MenuPart => ({ kind: "item", label: rules.name.replaceAll("_", " "), about: rules.about, picture: `/presets/${rules.name}.jpg`, act: () => put(rules, workspace, editor, notices) })));
}

function put(rules: LibraryRules, workspace: Workspace, editor: Editor, notices: Notices): void {
  const files = workspace.files.value;
  const open = workspace.file(editor.active.value);
  const target = open?.kind === "rules" && !open.library ? open : files.find((file) => file.kind === "rules" && !file.library);
  if (target) {
    editor.show(target.name);
    editor.replaceAll(target.name, rules.text);
    notices.say(`${target.name} now says what the library's ${rules.name} says. Undo brings yours back.`);
    return;
  }
  const scene = files.find((file) => file.kind === "scene");
  const change = scene && setValue(editor.textOf(scene.name), ["plants", 0, "rules"], rules.name);
  if (!scene || !change) return;
  editor.show(scene.name);
  editor.change(scene.name, change);
}
