// Making elements in a line each, so that the page's modules read as what they show.

type Attributes = Record<string, string | number | boolean | EventListener | undefined>;
export type Child = Node | string | null | undefined | false;

/** Attributes that begin with "on" listen; true sets an attribute without a value, false and undefined leave it out. */
export function make<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== undefined && value !== false) element.setAttribute(name, String(value));
  }
  fill(element, ...children);
  return element;
}

export function fill(element: Element, ...children: Child[]): void {
  element.append(...children.filter((child): child is Node | string => !!child || child === ""));
}

export function refill(element: Element, ...children: Child[]): void {
  element.replaceChildren();
  fill(element, ...children);
}

const svgSpace = "http://www.w3.org/2000/svg";

/** Our own drawings alone: the text is written in this page's source. */
export function drawing(width: number, height: number, inside: string, label = ""): SVGSVGElement {
  const svg = document.createElementNS(svgSpace, "svg");
  svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
  svg.setAttribute("width", String(width));
  svg.setAttribute("height", String(height));
  if (label) {
    svg.setAttribute("role", "img");
    svg.setAttribute("aria-label", label);
  } else svg.setAttribute("aria-hidden", "true");
  svg.innerHTML = inside;
  return svg;
}

export const clamp = (value: number, low: number, high: number): number => Math.min(high, Math.max(low, value));

/** 1234567 as people read it. */
export const grouped = (value: number): string => Math.round(value).toLocaleString("en-GB").replaceAll(",", "\u202f");

export function seconds(value_s: number): string {
  if (value_s < 0.0995) return `${Math.round(value_s * 1000)} ms`;
  if (value_s < 9.95) return `${value_s.toFixed(2)} s`;
  return `${value_s.toFixed(value_s < 99.5 ? 1 : 0)} s`;
}
