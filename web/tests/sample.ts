// A small page as written by isoatlas.
import type { Branch, Counts, Entry, Page } from "../src/shared/page";

export function branch(changes: Partial<Branch>): Branch {
  return {
    side: "object",
    id: 1,
    rank: 0,
    appears: 90,
    merges: null,
    parent: -1,
    hypervolume: 5000,
    voxels: 1000,
    measure: 1000,
    joined: 0,
    significant: true,
    ...changes,
  };
}

export function entry(changes: Partial<Entry>): Entry {
  return {
    branch: 0,
    id: 1,
    tau: 50,
    low: 40,
    high: 60,
    voxels: 1000,
    measure: 1000,
    tunnels: 0,
    cavities: 0,
    inside: -1,
    around: -1,
    reason: "",
    why: "",
    colour: "#56b4e9",
    picture: null,
    commands: [{ name: "surface", line: "isoatlas extract scan.atlas --object 1 --tau 50 -o object-1.ply" }],
    ...changes,
  };
}

function counts(n: number): Counts {
  return {
    objects: { max: [1, n, 3, 1] },
    contours: { max: [1, 3, 4, 2] },
    tunnels: { max: [0, 5, 1, 0], min: [0, 2, 1, 0] },
    cavities: { max: [0, 1, 1, 0] },
  };
}

export function page(branches: Branch[], entries: Entry[]): Page {
  return {
    schema: "isoatlas/page/3",
    version: "0.2.0",
    volume: {
      name: "scan",
      size: [10, 20, 30],
      type: "uint8",
      spacing: [1, 1, 2],
      space: "LPS",
      origin: [0, 0, 0],
      direction: [
        [1, 0, 0],
        [0, 1, 0],
        [0, 0, 1],
      ],
      unit: "mm",
      valueUnit: null,
      low: 0,
      high: 100,
      noise: 1,
    },
    interpolant: "trilinear",
    found: { objects: { all: 1234, significant: 3 }, cavities: { all: 77, significant: 1 } },
    axis: { low: 0, high: 100, bend: null },
    histogram: { edges: [0, 25, 50, 75, 100], counts: [5000, 700, 200, 100] },
    spectrum: { edges: [0, 25, 50, 75, 100], all: counts(20), significant: counts(2) },
    curve: { threshold: [9000, 5000, 800, 1], kept: [1, 2, 3, 1234], automaticThreshold: 800, automaticKept: 3 },
    branches,
    entries,
  };
}

/** A main branch at two isovalues, two other branches, the second without a picture, and a cavity of the main branch. */
export const scene = page(
  [
    branch({
      id: 7,
      hypervolume: 9000,
      joined: 41,
      isovalues: [{ tau: 45, why: "the wall of one of its cavities is sharpest here", cavity: 3 }],
      tunnels: {
        exact: true,
        significant: 3,
        longest: [
          { opens: 80, closes: 20 },
          { opens: 40, closes: 30 },
        ],
      },
      shape: { edges: [0, 50, 90], tunnels: { max: [2, 0] }, cavities: { max: [0, 1] } },
    }),
    branch({ id: 8, appears: 95, merges: 30, parent: 0, hypervolume: 5000, voxels: 400, measure: 800 }),
    branch({ id: 9, appears: 85, merges: 60, parent: 1, hypervolume: 4000, voxels: 200, measure: 400, significant: false }),
    branch({ side: "cavity", id: 5, appears: 10, merges: 70, hypervolume: 800, voxels: 120, measure: 240 }),
  ],
  [
    entry({ id: 7, tunnels: 2, voxels: 5000, measure: 10000 }),
    entry({ id: 7, tau: 80, low: 70, high: 85, voxels: 300, inside: 0, reason: "stable", why: "its boundary is sharp" }),
    entry({ branch: 1, id: 8, tau: 70, voxels: 40, inside: 0 }),
    entry({ branch: 3, id: 5, tau: 45, low: 20, high: 70, voxels: 90, measure: 180, cavities: 1, around: 0 }),
  ],
);
