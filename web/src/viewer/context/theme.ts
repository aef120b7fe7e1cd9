// Light or dark theme: of the system, or chosen by the user. A preference of the browser, not a part of a scene.
import type { ViewerContext } from "./viewer_context";
import { recall, remember } from "../state/local_storage";

const THEMES = ["system", "light", "dark"] as const;
type Theme = (typeof THEMES)[number];

/** Is the page dark now? */
export function isDarkPage(): boolean {
  const { colorScheme } = getComputedStyle(document.documentElement);
  return colorScheme === "dark" || (colorScheme !== "light" && matchMedia("(prefers-color-scheme: dark)").matches);
}

/** Current value of a colour of viewer.css, for canvases. */
export function themeColor(name: "ink" | "soft" | "line" | "mark" | "chosen"): string {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`);
}

/** Calls when the theme may have changed. */
export function onTheme(listener: () => void): void {
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", listener);
  new MutationObserver(listener).observe(document.documentElement, { attributes: true, attributeFilter: ["style"] });
}

export function addThemeAction(context: ViewerContext): void {
  const { actions } = context;
  let now: Theme = THEMES.find((name) => name === recall("theme")) ?? "system";
  const applyTheme = (): void => void (document.documentElement.style.colorScheme = now === "system" ? "light dark" : now);
  const next = (): void => {
    now = THEMES[(THEMES.indexOf(now) + 1) % THEMES.length] ?? "system";
    remember("theme", now);
    applyTheme();
    context.notify(now === "system" ? "theme of the system" : `${now} theme`);
  };
  applyTheme();
  actions.add({
    group: "View",
    keys: ["d"],
    run: next,
    get name() {
      return `Theme: ${now}`;
    },
  });
}
