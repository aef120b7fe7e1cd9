// State to and from the fragment of an address. Initial values are omitted.
import { partNamed } from "./part";
import type { Shown, State } from "./state";

export function toHash(state: State): string {
  const view = state.view ? `&view=${state.view.map((n) => Number(n.toPrecision(7))).join(",")}` : "";
  const parts = Object.keys(state.parts)
    .sort()
    .map((key) => `&${key}=${encodeURIComponent(state.parts[key] ?? "").replace(/%(2C|3A|3B|40)/g, decodeURIComponent)}`);
  return `#scene=${state.shown.map(wordsOf).join(";")}&selected=${state.selected}${view}${parts.join("")}`;
}

function wordsOf({ entry, tau, opacity, visible, colour, walls }: Shown): string {
  const words = [entry, tau, opacity, visible ? 1 : 0, colour?.slice(1) ?? "", walls === "all" ? "" : walls];
  while (words.at(-1) === "") words.pop();
  return words.join(",");
}

/** entries: number of valid entries. null: not a scene. */
export function fromHash(hash: string, entries: number): State | null {
  const words = new URLSearchParams(hash.replace(/^#/, ""));
  const scene = words.get("scene");
  if (scene === null) return null;
  const shown: Shown[] = [];
  for (const part of scene.split(";").filter((text) => text !== "")) {
    const one = shownOf(part, entries);
    if (!one || shown.some(({ entry }) => entry === one.entry)) return null;
    shown.push(one);
  }
  const selected = Number(words.get("selected") ?? -1);
  const view = (words.get("view") ?? "").split(",").map(Number);
  return {
    shown,
    selected: Number.isInteger(selected) && selected >= -1 && selected < shown.length ? selected : shown.length - 1,
    view: view.length === 6 && view.every(Number.isFinite) ? view : null,
    parts: Object.fromEntries([...words].flatMap(([key, text]) => (partNamed(key)?.accepts(text) ? [[partNamed(key)?.key, text]] : []))),
  };
}

function shownOf(text: string, entries: number): Shown | null {
  const words = text.split(",");
  const [entry, tau, opacity, visible] = words.slice(0, 4).map((word) => (word.trim() === "" ? NaN : Number(word)));
  const [colour = "", walls = "all"] = words.slice(4);
  if (words.length < 4 || words.length > 6 || entry === undefined || tau === undefined || opacity === undefined) return null;
  if (!Number.isInteger(entry) || entry < -1 || entry >= entries || !Number.isFinite(tau) || !(opacity >= 0 && opacity <= 1)) return null;
  if (!/^([0-9a-f]{6})?$/.test(colour) || (walls !== "all" && walls !== "cavities")) return null;
  return { entry, tau, opacity, visible: visible === 1, colour: colour ? `#${colour}` : null, walls };
}
