// What stays as it was over a reload: in this browser's own store, which may be shut or full; then it is only kept
// until the page goes.
import { Signal } from "./signal";

const prefix = "espalier.studio.";

export function remembered<T>(name: string, first: T, fits: (value: unknown) => value is T): Signal<T> {
  const signal = new Signal<T>(first);
  try {
    const text = window.localStorage.getItem(prefix + name);
    if (text !== null) {
      const value: unknown = JSON.parse(text);
      if (fits(value)) signal.value = value;
    }
  } catch {
    // No store, or what lies there is none of ours: the first value stands.
  }
  signal.onChange((value) => {
    try {
      window.localStorage.setItem(prefix + name, JSON.stringify(value));
    } catch {
      // Kept until the page goes.
    }
  });
  return signal;
}

export const isNumber = (value: unknown): value is number => typeof value === "number" && Number.isFinite(value);
export const isBoolean = (value: unknown): value is boolean => typeof value === "boolean";
export const isText = (value: unknown): value is string => typeof value === "string";
export const oneOf =
  <T extends string>(...words: T[]) =>
  (value: unknown): value is T =>
    (words as unknown[]).includes(value);
