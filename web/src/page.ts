// What `isoatlas` writes into the page: docs/schema/page.schema.json. Values are in units of the file.

/** A turntable: square frames side by side in one picture, from the front once around. */
export interface Picture {
  /** data: URI */
  image: string;
  frames: number;
  /** pixels of a frame */
  side: number;
}

export type Side = "bright" | "dark";

/** A count over columns of isovalues: between least and most; without `least` it is `most` everywhere in the column. */
export interface Count {
  most: number[];
  least?: number[];
}

/** Counts in the isovalues (edges[i], edges[i + 1]]. */
export interface Shape {
  edges: number[];
  tunnels: Count;
  cavities: Count;
}

export interface Counts {
  objects: Count;
  contours: Count;
  tunnels: Count;
  cavities: Count;
}

/** Of all objects, and of those that hold one that stands out. */
export interface Spectrum {
  edges: number[];
  all: Counts;
  essential: Counts;
}

/** Tunnels that open in an object and that noise does not explain. */
export interface Tunnels {
  /** else: the tunnel that opened last is taken to close first */
  exact: boolean;
  /** how many */
  standingOut: number;
  /** the first of them, by length */
  longest: { opens: number; closes: number }[];
}

/** An isovalue that shows an object well, and why. */
export interface Advice {
  tau: number;
  why: string;
  /** the entry of the cavity whose wall that is, where it has one */
  cavity?: number;
}

/** An object of the volume, on its own between appears and merges. Bright ones by rank, then dark ones by rank. */
export interface Branch {
  side: Side;
  id: number;
  /** among all of its side, from 0 */
  rank: number;
  appears: number;
  /** null: it never merges into another one */
  merges: number | null;
  /** the branch that goes on where this one merges, -1: none of this page */
  parent: number;
  /** contrast x size: the rank */
  hypervolume: number;
  /** just before it merges */
  voxels: number;
  measure: number;
  /** objects that merge into it, those that are not on this page included */
  joined: number;
  standsOut: boolean;
  shape?: Shape | null;
  /** others that show it well, without an entry */
  isovalues?: Advice[];
  tunnels?: Tunnels;
}

/** A branch at an isovalue that shows it. */
export interface Entry {
  branch: number;
  id: number;
  tau: number;
  /** between these it keeps its tunnels and cavities */
  low: number;
  high: number;
  voxels: number;
  /** physical volume, or voxels where the file has no unit */
  measure: number;
  tunnels: number;
  /** of a dark object: bright objects inside it */
  cavities: number;
  /** the entry it lies in, -1: none */
  inside: number;
  /** of a dark object: the entry of the object that it is a cavity of, -1: none */
  around: number;
  /** why this isovalue: in a word, and in a sentence; empty: not known */
  reason: string;
  why: string;
  colour: string;
  picture: Picture | null;
  commands: { name: string; line: string }[];
}

/** counts[i] samples from edges[i] to edges[i + 1]. */
export interface Histogram {
  edges: number[];
  counts: number[];
}

/** kept[i] objects have at least a contrast x size of threshold[i], which descends. */
export interface Curve {
  threshold: number[];
  kept: number[];
  automaticThreshold: number;
  automaticKept: number;
}

export interface Page {
  schema: "isoatlas/page/2";
  version: string;
  volume: {
    name: string;
    size: number[];
    type: string;
    /** null: the steps between samples are uneven */
    spacing: number[] | null;
    /** where they are uneven: per axis, where its samples lie along it, from the first one on */
    coordinates?: number[][];
    /** what the axes of space mean: "LPS", "RAS", ..., "unknown" */
    space: string;
    /** of the first sample, physical */
    origin: [number, number, number];
    /** rows; column a: unit vector of axis a */
    direction: [number, number, number][];
    /** of lengths; null: not known, measures are voxels */
    unit: string | null;
    valueUnit: string | null;
    low: number;
    high: number;
    noise: number;
  };
  interpolant: string;
  /** how many there are in all, and how many of them noise does not explain and are not tiny */
  objects: Record<Side, { all: number; standingOut: number }>;
  /** bend: null for a linear axis; else equal steps of asinh((value - low) / bend) */
  axis: { low: number; high: number; bend: number | null };
  histogram: Histogram;
  spectrum: Spectrum | null;
  curve: Curve;
  branches: Branch[];
  entries: Entry[];
  /** entries that are not on the page, by number from entries.length on: viewer/catalogue.ts */
  further?: (i: number) => Entry | undefined;
}

export function readPage(text: string): Page | null {
  const page = JSON.parse(text) as Page | null;
  if (page !== null && page.schema !== "isoatlas/page/2") throw new Error(`unknown page: ${String(page.schema)}`);
  return page;
}

export function entryOf(page: Page, i: number): Entry {
  const entry = page.entries[i] ?? page.further?.(i);
  if (!entry) throw new Error(`no entry ${i}`);
  return entry;
}

export function branchOf(page: Page, b: number): Branch {
  const branch = page.branches[b];
  if (!branch) throw new Error(`no branch ${b}`);
  return branch;
}
