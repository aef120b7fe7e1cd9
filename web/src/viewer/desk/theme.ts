// Light or dark: as the system has it, or as the reader wants it. Remembered, and no part of a scene.
import type { Desk } from "./desk";
import { recall, remember } from "../state/remembered";

const THEMES = ["system", "light", "dark"] as const;
type Theme = (typeof THEMES)[number];

/** What the page looks like now. */
export function isDarkPage(): boolean {
  const { colorScheme } = getComputedStyle(document.documentElement);
  return colorScheme === "dark" || (colorScheme !== "light" && matchMedia("(prefers-color-scheme: dark)").matches);
}

/** A colour of viewer.css as it is now, for what knows no variables. */
export function ink(name: "ink" | "soft" | "line" | "mark" | "chosen"): string {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`);
}

/** Calls when the page may look different. */
export function onTheme(listener: () => void): void {
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", listener);
  new MutationObserver(listener).observe(document.documentElement, { attributes: true, attributeFilter: ["style"] });
}

export function theme(desk: Desk): void {
  const { actions } = desk;
  let now: Theme = THEMES.find((name) => name === recall("theme")) ?? "system";
  const wear = (): void => void (document.documentElement.style.colorScheme = now === "system" ? "light dark" : now);
  const next = (): void => {
    now = THEMES[(THEMES.indexOf(now) + 1) % THEMES.length] ?? "system";
    remember("theme", now);
    wear();
    desk.say(now === "system" ? "light or dark, as the system has it" : `${now}, whatever the system has`);
  };
  wear();
  actions.add({
    group: "Look",
    keys: ["d"],
    run: next,
    get name() {
      return `light or dark: ${now === "system" ? "as the system has it" : now}`;
    },
  });
}
