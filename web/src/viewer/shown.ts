// What a scene shows, in the words of the page: entry i of the page, or all there is (-1).
import { isDark, nameOf } from "../names";
import { branchOf, entryOf, type Branch, type Page } from "../page";
import type { Which } from "./api";

export const EVERYTHING = -1;

export function whichOf(page: Page, i: number): Which {
  if (i === EVERYTHING) return null;
  return isDark(page, i) ? { contour: entryOf(page, i).id } : { object: entryOf(page, i).id };
}

export function titleOf(page: Page, i: number): string {
  return i === EVERYTHING ? "All there is" : nameOf(page, i);
}

export function colourOf(page: Page, i: number): string {
  return i === EVERYTHING ? "#999999" : entryOf(page, i).colour;
}

/** The isovalue that shows it best. */
export function bestOf(page: Page, i: number): number {
  return i === EVERYTHING ? (page.axis.low + page.axis.high) / 2 : entryOf(page, i).tau;
}

export function branchOfShown(page: Page, i: number): Branch | null {
  return i === EVERYTHING ? null : branchOf(page, entryOf(page, i).branch);
}

/** Between these it is on its own, the lower one first. */
export function ownRange(page: Page, i: number): [number, number] {
  const branch = branchOfShown(page, i);
  if (!branch) return [page.axis.low, page.axis.high];
  return [branch.merges ?? page.axis.low, branch.appears].sort((p, q) => p - q) as [number, number];
}

/** The values at which an object with an entry begins, or ends in another one. */
export function eventsOf(page: Page): number[] {
  const values = page.entries.flatMap((entry) => {
    const branch = branchOf(page, entry.branch);
    return [branch.appears, branch.merges];
  });
  return [...new Set(values.filter((value): value is number => value !== null))].sort((p, q) => p - q);
}
