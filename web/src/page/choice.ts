// Which objects are shown, and in which order: the state of the controls.
import { byRank, orders } from "../shared/orders";
import { branchOf, entryOf, type Page, type Side } from "../shared/page";

export interface Choice {
  /** number of objects, by rank */
  keep: number;
  order: string;
  side: "all" | Side | "high" | "low";
  /** voxels */
  minVoxels: number;
}

/** Branches by rank: those with a picture before those without, each by hypervolume (contrast x size); the main branch first. */
export function ranked(page: Page): number[] {
  const pictured = new Set(page.entries.map((entry) => entry.branch));
  return page.branches
    .map((_, b) => b)
    .sort((p, q) => Number(pictured.has(q)) - Number(pictured.has(p)) || inList(page, p, q) || p - q);
}

/** Entries of a page of both are by importance. */
function inList(page: Page, p: number, q: number): number {
  if (page.polarity !== "both") return byRank(branchOf(page, p), branchOf(page, q));
  const place = (b: number): number => page.entries.findIndex((entry) => entry.branch === b);
  return place(p) - place(q) || byRank(branchOf(page, p), branchOf(page, q));
}

/** Number of branches with a picture: those shown initially. */
export function pictured(page: Page): number {
  return new Set(page.entries.map((entry) => entry.branch)).size;
}

export function firstChoice(page: Page): Choice {
  return { keep: pictured(page), order: "rank", side: "all", minVoxels: 0 };
}

/** Branches to show. */
export function chosenBranches(page: Page, choice: Choice): Set<number> {
  const kept = ranked(page).slice(0, choice.keep);
  return new Set(
    kept.filter((b) => {
      const branch = branchOf(page, b);
      const isOnSide = choice.side === "all" || branch.side === choice.side || branch.polarity === choice.side;
      return isOnSide && (choice.minVoxels === 0 || largest(page, b) >= choice.minVoxels);
    }),
  );
}

function largest(page: Page, b: number): number {
  return page.entries.reduce((max, entry) => (entry.branch === b ? Math.max(max, entry.voxels) : max), branchOf(page, b).voxels);
}

/** Positions of the entries to show, in order. */
export function chosenEntries(page: Page, choice: Choice): number[] {
  const branches = chosenBranches(page, choice);
  const compare = orders.find(([name]) => name === choice.order)?.[1] ?? (() => 0);
  const kept = page.entries.flatMap((entry, i) => (branches.has(entry.branch) && entry.voxels >= choice.minVoxels ? [i] : []));
  return kept.sort((p, q) => compare(page, entryOf(page, p), entryOf(page, q)) || p - q);
}
