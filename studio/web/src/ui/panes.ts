// Going around the page by keys: F6 to the next part, with Shift to the one before.

export function paneKeys(parts: (() => HTMLElement | null)[]): void {
  window.addEventListener("keydown", (event) => {
    if (event.key !== "F6") return;
    event.preventDefault();
    const targets = parts.map((part) => part()).filter((each): each is HTMLElement => !!each);
    const at = targets.findIndex((each) => each.contains(document.activeElement) || each === document.activeElement);
    const next = targets[(at + (event.shiftKey ? -1 : 1) + targets.length) % targets.length];
    next?.focus();
  });
}
