// Names and short descriptions of entries.
import { plural, value, volume } from "./format";
import { branchOf, entryOf, hasCard, isLowOfBoth, isOfLowValues, type Advice, type Branch, type Page } from "./page";

export function isCavity(page: Page, i: number): boolean {
  return branchOf(page, entryOf(page, i).branch).side === "cavity";
}

/** Number in the table of its side, as on the command line; of an object that the table does not list: rank + 1. */
export function numberOf(page: Page, i: number): number {
  const { number, branch } = entryOf(page, i);
  if (number) return number;
  if (i >= page.entries.length) return branchOf(page, branch).number ?? branchOf(page, branch).rank + 1;
  const cavity = isCavity(page, i);
  return page.entries.filter((_, k) => k <= i && isCavity(page, k) === cavity).length;
}

/** "low" before what names an object of low values on a page of both. */
export function lowMark(page: Page, i: number): string {
  return isLowOfBoth(page, branchOf(page, entryOf(page, i).branch)) ? "low" : "";
}

/** "2", "c1", of a page of both "low2"; of an object that the table does not list "v218663": its voxel. */
export function referenceOf(page: Page, i: number): string {
  const { branch, id } = entryOf(page, i);
  const low = lowMark(page, i);
  if (i >= page.entries.length && !branchOf(page, branch).number) return `${low}${voxelWord(id)}`;
  return `${low}${isCavity(page, i) ? "c" : ""}${numberOf(page, i)}`;
}

/** Which values an entry of a page of both consists of: "at least 300", "at most -400"; of other pages only the isovalue. */
export function valuesOf(page: Page, i: number): string {
  const { branch, tau } = entryOf(page, i);
  if (page.polarity !== "both") return value(tau);
  return `${branchOf(page, branch).polarity === "low" ? "at most" : "at least"} ${value(tau)}`;
}

/** A voxel as the command line writes it. */
export function voxelWord(id: number): string {
  return `v${id}`;
}

/** The name that a user gave it, or its number. */
export function nameOf(page: Page, i: number): string {
  const { name, branch } = entryOf(page, i);
  if (name) return name;
  if (i >= page.entries.length && !branchOf(page, branch).number) return `Object of rank ${numberOf(page, i)}`;
  return `${isCavity(page, i) ? "Cavity" : "Object"} ${lowMark(page, i)}${numberOf(page, i)}`;
}

/** Id of its card and fragment of its address. */
export function anchorOf(page: Page, i: number): string {
  return `${isCavity(page, i) ? "cavity" : "object"}-${lowMark(page, i)}${numberOf(page, i)}`;
}

/** The isovalues between its appearance and its merge. */
export function rangeOf(branch: Branch, page?: Page): string {
  const first = value(branch.appears);
  if (branch.merges === null) return `from ${first} ${page && isOfLowValues(page, branch) ? "upwards" : "downwards"}, never merges`;
  const ends = [branch.merges, branch.appears].sort((p, q) => p - q).map(value);
  return ends.join(" to ");
}

export function shapeOf(page: Page, i: number): string {
  const entry = entryOf(page, i);
  const tunnels = plural(entry.tunnels, "tunnel");
  return isCavity(page, i)
    ? `${tunnels}, ${plural(entry.cavities, "object")} inside`
    : `${tunnels}, ${plural(entry.cavities, "cavity", "cavities")}`;
}

export function describe(page: Page, i: number): string {
  const entry = entryOf(page, i);
  const values = page.polarity === "both" ? `, values ${valuesOf(page, i)}` : ` at isovalue ${value(entry.tau)}`;
  return `${nameOf(page, i)}${values}: ${volume(entry.measure, page.volume.unit)}, ${shapeOf(page, i)}`;
}

const reasons: Record<string, string> = {
  stable: "sharp edge",
  outline: "outline",
  outer: "sharp outer edge",
  inner: "sharp wall of a cavity",
  merge: "just before merging",
  middle: "mid-range",
};

/** Reason for its isovalue, in a few words. */
export function reasonOf(page: Page, i: number): string {
  const { reason } = entryOf(page, i);
  return isCavity(page, i) && reason === "outline" ? reasons.merge! : (reasons[reason] ?? "");
}

/** nameOf() within a sentence. */
function mentionOf(page: Page, i: number): string {
  return entryOf(page, i).name ? nameOf(page, i) : nameOf(page, i).toLowerCase();
}

/** What contains it, in a few words; empty: no entry of this page. */
export function placeOf(page: Page, i: number): string {
  const entry = entryOf(page, i);
  if (entry.inside >= 0 && !entry.enclosed) return `inside ${mentionOf(page, entry.inside)}`;
  if (entry.around >= 0) return `a cavity of ${mentionOf(page, entry.around)}`;
  return entry.enclosed ? "a cavity" : "";
}

/** The branches of a list as they merge while the object that they merge into grows. */
export function inOrderOfMerges(page: Page, branches: number[]): number[] {
  const merge = (b: number): number => (branchOf(page, b).merges ?? 0) * (isOfLowValues(page, branchOf(page, b)) ? 1 : -1);
  return branches.sort((p, q) => merge(p) - merge(q));
}

/** Entries directly contained in this one. */
export function contentsOf(page: Page, i: number): number[] {
  return page.entries.flatMap((entry, k) => (k !== i && (entry.inside === i || entry.around === i) ? [k] : []));
}

/** All entries of a branch: the same object at several isovalues. */
export function entriesOf(page: Page, branch: number): number[] {
  return page.entries.flatMap((entry, k) => (entry.branch === branch ? [k] : []));
}

/** Further isovalues of its branch for which the card of this entry is the closest one, ascending. */
export function furtherIsovalues(page: Page, i: number): Advice[] {
  const { branch } = entryOf(page, i);
  const rows = entriesOf(page, branch).filter((k) => hasCard(entryOf(page, k)));
  const distance = (k: number, tau: number): number => Math.abs(entryOf(page, k).tau - tau);
  const closest = (tau: number): number => rows.reduce((best, k) => (distance(k, tau) < distance(best, tau) ? k : best), rows[0] ?? i);
  return (branchOf(page, branch).isovalues ?? []).filter(({ tau }) => closest(tau) === i).sort((p, q) => p.tau - q.tau);
}

/** Name of a branch: that of its first entry. */
export function branchName(page: Page, branch: number): string {
  const [first] = entriesOf(page, branch);
  const low = isLowOfBoth(page, branchOf(page, branch)) ? "low" : "";
  return first === undefined ? `object ${low}${voxelWord(branchOf(page, branch).id)}` : nameOf(page, first);
}
