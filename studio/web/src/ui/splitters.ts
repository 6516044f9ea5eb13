// The edges between panes: dragged, or moved by arrow keys; a double click puts them back.
import { clamp } from "../base/dom";
import { isNumber, remembered } from "../base/settings";

export function splitter(handle: HTMLElement, panes: HTMLElement, property: string, first_px: number, least_px: number, most: () => number): void {
  const width = remembered(`width.${property}`, first_px, isNumber);
  const write = (): void => {
    const value = clamp(width.value, least_px, Math.max(least_px, most()));
    panes.style.setProperty(`--${property}`, `${value}px`);
    handle.setAttribute("aria-valuenow", String(Math.round(value)));
    handle.setAttribute("aria-valuemin", String(least_px));
    handle.setAttribute("aria-valuemax", String(Math.round(Math.max(least_px, most()))));
  };
  width.watch(write);
  window.addEventListener("resize", write);
  let from: { x: number; width: number } | null = null;
  handle.addEventListener("pointerdown", (event) => {
    from = { x: event.clientX, width: width.value };
    handle.setPointerCapture(event.pointerId);
    event.preventDefault();
  });
  handle.addEventListener("pointermove", (event) => {
    if (from) width.value = clamp(from.width + event.clientX - from.x, least_px, most());
  });
  const drop = () => (from = null);
  handle.addEventListener("pointerup", drop);
  handle.addEventListener("pointercancel", drop);
  handle.addEventListener("dblclick", () => (width.value = first_px));
  handle.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: -16, ArrowRight: 16 }[event.key];
    if (step === undefined) return;
    event.preventDefault();
    width.value = clamp(width.value + step, least_px, most());
  });
}
