// What an entry is called, and what can be said about it in one line.
import { plural, value, volume } from "./format";
import { branchOf, entryOf, type Branch, type Page } from "./page";

export function isDark(page: Page, i: number): boolean {
  return branchOf(page, entryOf(page, i).branch).side === "dark";
}

/** Its place among those of its side; of an object that is not on the page, its place among all. */
export function numberOf(page: Page, i: number): number {
  if (i >= page.entries.length) return branchOf(page, entryOf(page, i).branch).rank + 1;
  const dark = isDark(page, i);
  return page.entries.filter((_, k) => k <= i && isDark(page, k) === dark).length;
}

export function nameOf(page: Page, i: number): string {
  if (i >= page.entries.length) return `Object of rank ${numberOf(page, i)}`;
  return `${isDark(page, i) ? "Dark object" : "Object"} ${numberOf(page, i)}`;
}

/** What its card and its address are called. */
export function anchorOf(page: Page, i: number): string {
  return `${isDark(page, i) ? "dark" : "object"}-${numberOf(page, i)}`;
}

/** Where its isovalues are. */
export function rangeOf(branch: Branch): string {
  const first = value(branch.appears);
  if (branch.merges === null) return `from ${first} on, at every lower isovalue`;
  const ends = [branch.merges, branch.appears].sort((p, q) => p - q).map(value);
  return ends.join(" to ");
}

export function shapeOf(page: Page, i: number): string {
  const entry = entryOf(page, i);
  const tunnels = plural(entry.tunnels, "tunnel");
  return isDark(page, i)
    ? `${tunnels}, ${plural(entry.cavities, "bright object")} inside`
    : `${tunnels}, ${plural(entry.cavities, "cavity", "cavities")}`;
}

export function describe(page: Page, i: number): string {
  const entry = entryOf(page, i);
  return `${nameOf(page, i)} at isovalue ${value(entry.tau)}: ${volume(entry.measure, page.volume.unit)}, ${shapeOf(page, i)}`;
}

const reasons: Record<string, string> = {
  steady: "sharp boundary",
  outline: "all but background",
  outer: "sharp outer boundary",
  inner: "sharp wall of a cavity",
  merge: "as large as it gets on its own",
  middle: "middle of its range",
};

/** Why its isovalue, in a few words. */
export function reasonOf(page: Page, i: number): string {
  const { reason } = entryOf(page, i);
  return isDark(page, i) && reason === "outline" ? reasons.merge! : (reasons[reason] ?? "");
}

/** Where it lies, in a few words; empty: nowhere that is on this page. */
export function placeOf(page: Page, i: number): string {
  const entry = entryOf(page, i);
  if (entry.inside >= 0) return `inside ${nameOf(page, entry.inside).toLowerCase()}`;
  if (entry.around >= 0) return `a cavity of ${nameOf(page, entry.around).toLowerCase()}`;
  return "";
}

/** Entries that lie directly in this one. */
export function contentsOf(page: Page, i: number): number[] {
  return page.entries.flatMap((entry, k) => (k !== i && (entry.inside === i || entry.around === i) ? [k] : []));
}

/** All entries of a branch: the same object at several isovalues. */
export function entriesOf(page: Page, branch: number): number[] {
  return page.entries.flatMap((entry, k) => (entry.branch === branch ? [k] : []));
}

/** What a branch is called where one word must do: the first of its entries. */
export function branchName(page: Page, branch: number): string {
  const [first] = entriesOf(page, branch);
  return first === undefined ? `the object ${branchOf(page, branch).id}` : nameOf(page, first);
}
