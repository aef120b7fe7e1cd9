// What a scene shows, in the words of the page: entry i of the page, or all there is (-1).
import { isDark, nameOf } from "../../names";
import { branchOf, entryOf, type Branch, type Page } from "../../page";
import type { Which } from "./api";
import type { Shown } from "../state/state";

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

export function colourOfShown(page: Page, { entry, colour }: Shown): string {
  return colour ?? colourOf(page, entry);
}

/** The isovalue that shows it best. */
export function bestOf(page: Page, i: number): number {
  return i === EVERYTHING ? (page.axis.low + page.axis.high) / 2 : entryOf(page, i).tau;
}

/** The nearest isovalue on the axis. */
export function within(page: Page, tau: number): number {
  return Math.min(Math.max(tau, page.axis.low), page.axis.high);
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
