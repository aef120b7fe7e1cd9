// A page as isoatlas writes it, small.
import type { Entry, Page } from "../src/page";

export function entry(changes: Partial<Entry>): Entry {
  return {
    id: 1, side: "bright", appears: 90, merges: null, best: 50, low: 40, high: 60, voxels: 1000, measure: 1000, tunnels: 0, cavities: 0,
    hypervolume: 5000, inside: -1, into: -1, trunk: false, note: "", colour: "#56b4e9", picture: null,
    commands: [{ name: "surface", line: "isoatlas extract scan.atlas --object 1 --tau 50 -o object-1.ply" }],
    ...changes,
  };
}

export function page(objects: Entry[]): Page {
  return {
    schema: "isoatlas/page/1",
    version: "0.1.0",
    volume: { name: "scan", size: [10, 20, 30], type: "uint8", spacing: [1, 1, 2], unit: "mm", valueUnit: null, low: 0, high: 100, noise: 1 },
    interpolant: "trilinear",
    branches: 1234,
    rule: "those that noise alone explains are not shown",
    histogram: { low: 0, high: 100, counts: [5000, 700, 200, 100] },
    objects,
    spectrum: { tau: [0, 25, 50, 75, 100], objects: [1, 2, 3, 2, 1], contours: [1, 3, 4, 2, 1], tunnels: [0, 5, 1, 0, 0], cavities: [0, 1, 1, 0, 0] },
  };
}

/** A trunk seen at two isovalues, and two branches; the second merges into the first. */
export const scene = page([
  entry({ id: 7, trunk: true, tunnels: 2, voxels: 5000, measure: 10000, note: "largest" }),
  entry({ id: 6, trunk: true, best: 80, low: 70, high: 85, voxels: 300, inside: 0 }),
  entry({ id: 8, appears: 95, merges: 30, into: 0, best: 70, voxels: 40, inside: 0 }),
  entry({ id: 9, appears: 85, merges: 60, into: 2, best: 75, voxels: 90, side: "dark", cavities: 1 }),
]);
