// A button with a menu, for the hand and the keys: arrows, Home, End, first letters, Escape.
import { make, type Child } from "../base/dom";

export interface MenuItem {
  kind: "item";
  label: string;
  about?: string;
  /** The address of a picture; a menu of items with pictures is a board of cards. */
  picture?: string;
  ticked?: boolean;
  /** With it the item is one of several, of which one is ticked. */
  radio?: boolean;
  act: () => void;
}

export type MenuPart = MenuItem | { kind: "title"; words: string } | { kind: "line" };

let openMenu: { close: (focus: boolean) => void } | null = null;

export function menuButton(label: Child, name: string, parts: () => MenuPart[]): HTMLButtonElement {
  const button = make("button", { class: "button", type: "button", "aria-haspopup": "menu", "aria-expanded": "false", "aria-label": name },
    label, make("span", { class: "turn", "aria-hidden": "true" }, "▾"));
  button.addEventListener("click", () => {
    const wasOpen = button.getAttribute("aria-expanded") === "true";
    openMenu?.close(false);
    if (!wasOpen) open(button, name, parts());
  });
  button.addEventListener("keydown", (event) => {
    if (event.key !== "ArrowDown") return;
    event.preventDefault();
    openMenu?.close(false);
    open(button, name, parts());
  });
  return button;
}

function open(button: HTMLButtonElement, name: string, parts: MenuPart[]): void {
  const menu = make("div", { class: "menu", role: "menu", "aria-label": name });
  const close = (focus: boolean) => {
    menu.remove();
    button.setAttribute("aria-expanded", "false");
    document.removeEventListener("pointerdown", outside, true);
    openMenu = null;
    if (focus) button.focus();
  };
  const outside = (event: PointerEvent) => {
    if (!menu.contains(event.target as Node) && !button.contains(event.target as Node)) close(false);
  };
  for (const part of parts) menu.append(element(part, close));
  menu.classList.toggle("has-pictures", parts.some((part) => part.kind === "item" && part.picture));
  document.body.append(menu);
  place(menu, button.getBoundingClientRect());
  button.setAttribute("aria-expanded", "true");
  document.addEventListener("pointerdown", outside, true);
  openMenu = { close };
  const items = [...menu.querySelectorAll<HTMLElement>(".menu-item")];
  menu.addEventListener("keydown", (event) => keys(event, items, close));
  (items.find((item) => item.getAttribute("aria-checked") === "true") ?? items[0])?.focus();
}

function element(part: MenuPart, close: (focus: boolean) => void): HTMLElement {
  if (part.kind === "title") return make("h4", { role: "presentation" }, part.words);
  if (part.kind === "line") return make("hr", { role: "separator" });
  const role = part.radio ? "menuitemradio" : part.ticked === undefined ? "menuitem" : "menuitemcheckbox";
  return make("button", {
    class: "menu-item", type: "button", role, tabindex: -1, "aria-checked": part.ticked === undefined ? undefined : String(part.ticked),
    onclick: () => {
      close(true);
      part.act();
    },
  },
  part.picture ? make("img", { src: part.picture, alt: "", width: 208, height: 132, loading: "lazy" }) : make("span", { class: "tick", "aria-hidden": "true" }, part.ticked ? "✓" : ""),
  make("span", { class: "label" }, part.label),
  part.about ? make("span", { class: "about" }, part.about) : null);
}

function place(menu: HTMLElement, anchor: DOMRect): void {
  const { width, height } = menu.getBoundingClientRect();
  menu.style.left = `${Math.max(8, Math.min(anchor.left, window.innerWidth - width - 8))}px`;
  const below = anchor.bottom + 4;
  menu.style.top = `${below + height > window.innerHeight - 8 ? Math.max(8, window.innerHeight - height - 8) : below}px`;
}

function keys(event: KeyboardEvent, items: HTMLElement[], close: (focus: boolean) => void): void {
  const at = items.indexOf(document.activeElement as HTMLElement);
  const to: Record<string, number> = { ArrowDown: (at + 1) % items.length, ArrowUp: (at - 1 + items.length) % items.length, Home: 0, End: items.length - 1 };
  if (event.key === "Escape" || event.key === "Tab") {
    event.preventDefault();
    close(true);
  } else if (to[event.key] !== undefined) {
    event.preventDefault();
    items[to[event.key] ?? 0]?.focus();
  } else if (event.key.length === 1 && /\S/.test(event.key)) {
    const letter = event.key.toLowerCase();
    const order = [...items.slice(at + 1), ...items.slice(0, at + 1)];
    order.find((item) => item.querySelector(".label")?.textContent?.toLowerCase().startsWith(letter))?.focus();
  }
}
