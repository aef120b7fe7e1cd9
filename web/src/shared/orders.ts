// Orders in which entries are listed.
import { branchOf, endOfBranch, type Branch, type Entry, type Page } from "./page";

export const orders: [string, (page: Page, p: Entry, q: Entry) => number][] = [
  ["rank", (page, p, q) => (page.polarity === "both" ? 0 : byRank(branchOf(page, p.branch), branchOf(page, q.branch)))],
  ["size", (_, p, q) => q.voxels - p.voxels],
  ["isovalue", (_, p, q) => q.tau - p.tau],
  ["range of isovalues", (page, p, q) => length(page, q) - length(page, p)],
  ["tunnels", (_, p, q) => q.tunnels - p.tunnels],
  ["cavities", (_, p, q) => q.cavities - p.cavities],
];

/**
 * Objects and cavities by contrast x size, which both sides share; the object that never merges comes first. Entries of a page of both
 * are in order already.
 */
export function byRank(p: Branch, q: Branch): number {
  const size = (branch: Branch): number => (branch.merges === null ? Infinity : branch.hypervolume);
  return size(p) === size(q) ? 0 : size(q) > size(p) ? 1 : -1;
}

function length(page: Page, entry: Entry): number {
  const branch = branchOf(page, entry.branch);
  return Math.abs(branch.appears - endOfBranch(page, branch));
}
