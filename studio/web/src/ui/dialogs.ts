// The two dialogs: a name for a camera, and what the keys do.
import { make } from "../base/dom";

export function askName(title: string, first: string, done: (name: string) => void): void {
  const input = make("input", { type: "text", value: first, required: true, pattern: "[A-Za-z_][A-Za-z0-9_\\-]*", title: "Letters, digits, _ and -", "aria-label": title });
  const dialog = make("dialog", { "aria-label": title }, make("h2", {}, title));
  const form = make("form", { method: "dialog" }, input, make("button", { class: "button is-main", type: "submit" }, "Save"));
  form.addEventListener("submit", () => done(input.value));
  show(dialog, form);
  input.select();
}

const keys: [string, string][] = [
  ["F6", "to the next part of the page; with Shift back"],
  ["Ctrl S", "save the open file"],
  ["Ctrl Space", "what may be written here"],
  ["Ctrl Z", "undo; a drag of a slider or of a seed is one step"],
  ["F8", "to the next problem"],
  ["Ctrl F", "search"],
  ["Ctrl M", "let Tab leave the text, and back"],
  ["← → ↑ ↓  + −", "in the view: turn and zoom; with Shift move"],
  ["S, Ctrl ← → ↑ ↓", "in the view: choose a seed, and move it by a voxel"],
  ["Click", "on a limb: why it grew so"],
  ["Alt click", "on a surface: a new seed"],
];

export function showKeys(): void {
  const rows = keys.map(([key, words]) => make("tr", {}, make("td", {}, make("kbd", {}, key)), make("td", {}, words)));
  const dialog = make("dialog", { "aria-label": "Keys" }, make("h2", {}, "Keys"));
  show(dialog, make("table", {}, make("tbody", {}, ...rows)),
    make("p", { class: "row" }, make("a", { href: "licences.txt", target: "_blank", rel: "noopener" }, "Licences"), make("button", { class: "button is-main", type: "button", onclick: () => dialog.close() }, "Close")));
}

function show(dialog: HTMLDialogElement, ...parts: HTMLElement[]): void {
  dialog.append(...parts);
  dialog.addEventListener("close", () => dialog.remove());
  dialog.addEventListener("click", (event) => {
    if (event.target === dialog) dialog.close();
  });
  document.body.append(dialog);
  dialog.showModal();
}
