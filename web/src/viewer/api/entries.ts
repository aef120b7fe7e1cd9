// Entries of a scene: entry i of the page, or the whole isosurface (-1).
import { isCavity, nameOf } from "../../shared/names";
import { branchOf, endOfBranch, entryOf, isLowOfBoth, type Branch, type Page } from "../../shared/page";
import type { Polarity, SurfaceTarget } from "./api";
import type { Shown } from "../state/state";

export const EVERYTHING = -1;

export function targetOf(page: Page, i: number): SurfaceTarget {
  if (i === EVERYTHING) return null;
  const polarity = polarityOfEntry(page, i);
  const of = polarity === undefined ? {} : { polarity };
  return isCavity(page, i) ? { contour: entryOf(page, i).id, ...of } : { object: entryOf(page, i).id, ...of };
}

/** For requests. */
export function polarityOfEntry(page: Page, i: number): Polarity {
  return i !== EVERYTHING && isLowOfBoth(page, branchOf(page, entryOf(page, i).branch)) ? "low" : undefined;
}

export function titleOf(page: Page, i: number): string {
  return i === EVERYTHING ? "Whole isosurface" : nameOf(page, i);
}

export function colourOf(page: Page, i: number): string {
  return i === EVERYTHING ? "#999999" : entryOf(page, i).colour;
}

export function colourOfShown(page: Page, { entry, colour }: Shown): string {
  return colour ?? colourOf(page, entry);
}

/** The best recommended isovalue. */
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

/** The isovalues between its appearance and its merge, ascending. */
export function ownRange(page: Page, i: number): [number, number] {
  const branch = branchOfShown(page, i);
  if (!branch) return [page.axis.low, page.axis.high];
  return [endOfBranch(page, branch), branch.appears].sort((p, q) => p - q) as [number, number];
}
