// What an entry is called, and what can be said about it in one line.
import { plural, value, volume } from "./format";
import type { Entry, Page } from "./page";

export function nameOf(page: Page, i: number): string {
  const entry = page.objects[i];
  if (!entry) return "";
  return `${entry.side === "dark" ? "Dark object" : "Object"} ${i + 1}`;
}

/** Where its isovalues are. */
export function rangeOf(entry: Entry): string {
  const [first, last] = [value(entry.appears), entry.merges === null ? null : value(entry.merges)];
  return last === null ? `from ${first} on, at every lower isovalue` : `${last} to ${first}`;
}

export function shapeOf(entry: Entry): string {
  return `${plural(entry.tunnels, "tunnel")}, ${plural(entry.cavities, "cavity", "cavities")}`;
}

export function describe(page: Page, i: number): string {
  const entry = page.objects[i];
  if (!entry) return "";
  return `${nameOf(page, i)} at isovalue ${value(entry.best)}: ${volume(entry.measure, page.volume.unit)}, ${shapeOf(entry)}`;
}

/** Entries that lie directly in this one. */
export function contentsOf(page: Page, i: number): number[] {
  return page.objects.flatMap((entry, k) => (entry.inside === i && k !== i ? [k] : []));
}
