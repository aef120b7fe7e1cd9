// Orders in which entries are listed.
import { branchOf, type Entry, type Page } from "./page";

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
