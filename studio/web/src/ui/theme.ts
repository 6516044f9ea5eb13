// Dark or light: as the system has it, unless somebody says otherwise here.
import { oneOf, remembered } from "../base/settings";
import { Signal } from "../base/signal";

export type ThemeWish = "system" | "light" | "dark";

export const themeWish = remembered<ThemeWish>("theme", "system", oneOf("system", "light", "dark"));
export const dark = new Signal(false);

const system = window.matchMedia("(prefers-color-scheme: dark)");

function follow(): void {
  dark.value = themeWish.value === "dark" || (themeWish.value === "system" && system.matches);
  document.documentElement.dataset["theme"] = dark.value ? "dark" : "light";
}

system.addEventListener("change", follow);
themeWish.onChange(follow);
follow();
