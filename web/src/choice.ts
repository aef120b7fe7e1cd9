// Which objects are looked at, and in which order: what the controls say.
import { branchOf, entryOf, type Entry, type Page, type Side } from "./page";

export interface Choice {
  /** of objects, by rank */
  keep: number;
  order: string;
  side: "all" | Side;
  /** voxels */
  least: number;
}

export const orders: [string, (page: Page, p: Entry, q: Entry) => number][] = [
  ["rank", () => 0],
  ["size", (_, p, q) => q.voxels - p.voxels],
  ["isovalue", (_, p, q) => q.tau - p.tau],
  ["range of isovalues", (page, p, q) => length(page, q) - length(page, p)],
  ["tunnels", (_, p, q) => q.tunnels - p.tunnels],
  ["cavities", (_, p, q) => q.cavities - p.cavities],
];

function length(page: Page, entry: Entry): number {
  const branch = branchOf(page, entry.branch);
  return Math.abs(branch.appears - (branch.merges ?? page.axis.low));
}

/** Branches, the most important one first: those with a picture before those without, each by contrast x size; the trunk leads. */
export function ranked(page: Page): number[] {
  const pictured = new Set(page.entries.map((entry) => entry.branch));
  const size = (b: number): number => (branchOf(page, b).merges === null ? Infinity : branchOf(page, b).hypervolume);
  return page.branches
    .map((_, b) => b)
    .sort((p, q) => Number(pictured.has(q)) - Number(pictured.has(p)) || (size(q) > size(p) ? 1 : size(q) < size(p) ? -1 : p - q));
}

/** How many of them have a picture: what is shown at first. */
export function pictured(page: Page): number {
  return new Set(page.entries.map((entry) => entry.branch)).size;
}

export function firstChoice(page: Page): Choice {
  return { keep: pictured(page), order: "rank", side: "all", least: 0 };
}

/** Branches to show. */
export function chosenBranches(page: Page, choice: Choice): Set<number> {
  const kept = ranked(page).slice(0, choice.keep);
  return new Set(
    kept.filter((b) => {
      const branch = branchOf(page, b);
      return (choice.side === "all" || branch.side === choice.side) && (choice.least === 0 || largest(page, b) >= choice.least);
    }),
  );
}

function largest(page: Page, b: number): number {
  return page.entries.reduce((most, entry) => (entry.branch === b ? Math.max(most, entry.voxels) : most), branchOf(page, b).voxels);
}

/** Positions of the entries to show, in order. */
export function chosenEntries(page: Page, choice: Choice): number[] {
  const branches = chosenBranches(page, choice);
  const compare = orders.find(([name]) => name === choice.order)?.[1] ?? (() => 0);
  const kept = page.entries.flatMap((entry, i) => (branches.has(entry.branch) && entry.voxels >= choice.least ? [i] : []));
  return kept.sort((p, q) => compare(page, entryOf(page, p), entryOf(page, q)) || p - q);
}
