// Data of the page as `isoatlas` writes them: docs/schema/page.schema.json. Values are in units of the file.

/** A turntable: square frames side by side in one image, a full turn starting at the front. */
export interface Picture {
  /** data: URI */
  image: string;
  frames: number;
  /** pixels of a frame */
  side: number;
}

/** A coarse surface inside the page: shared/wire.ts in base64. */
export interface PageMesh {
  data: string;
  triangles: number;
  /** triangles of the exact surface */
  of: number;
  keepsTopology: boolean;
}

export type Side = "object" | "cavity";

/** A count over columns of isovalues: between min and max; without `min` it is `max` everywhere in the column. */
export interface Count {
  max: number[];
  min?: number[];
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

/** Of all objects, and of those that contain a significant one. */
export interface Spectrum {
  edges: number[];
  all: Counts;
  significant: Counts;
}

/** Tunnels that open in an object and are above the noise level. */
export interface Tunnels {
  /** false: pairs by the elder rule; the tunnel that opened last closes first */
  exact: boolean;
  /** their number */
  significant: number;
  /** the longest of them */
  longest: { opens: number; closes: number }[];
}

/** A recommended isovalue of an object, and its reason. */
export interface Advice {
  tau: number;
  why: string;
  /** the entry of the cavity whose wall it shows, where there is one */
  cavity?: number;
}

/** A branch of the branch decomposition, between appears and merges. Objects by rank, then cavities by rank. */
export interface Branch {
  side: Side;
  /** pages of both: which values it consists of */
  polarity?: "high" | "low";
  id: number;
  /** of its first entry in the table of its side, from 1; null: the table has none */
  number?: number | null;
  /** within its side, from 0 */
  rank: number;
  appears: number;
  /** null: it never merges */
  merges: number | null;
  /** the branch it merges into; -1: none on this page */
  parent: number;
  /** contrast x size (hypervolume): defines the rank */
  hypervolume: number;
  /** just before it merges */
  voxels: number;
  measure: number;
  /** objects that merge into it, including those that are not on this page */
  joined: number;
  significant: boolean;
  shape?: Shape | null;
  /** further recommended isovalues, without an entry */
  isovalues?: Advice[];
  tunnels?: Tunnels;
}

/** A branch at a recommended isovalue. */
export interface Entry {
  branch: number;
  /** in the table of its side, from 1 */
  number?: number | null;
  /** that a user gave it */
  name?: string | null;
  /** as commands take it: 2, c1, low2 */
  reference?: string;
  /** the outline of the scanned field, or of low values what is around everything */
  background?: boolean;
  /** pages of both: of low values, and does not reach the border: a cavity of `around`, where that is on the page */
  enclosed?: boolean;
  /** pages of both: where it reaches the border, in words; empty: it does not, or is of high values */
  border?: string;
  id: number;
  tau: number;
  /** isovalues between which its tunnels and cavities stay the same */
  low: number;
  high: number;
  voxels: number;
  /** physical volume, or voxels where the file has no unit */
  measure: number;
  tunnels: number;
  /** of a cavity: objects inside it */
  cavities: number;
  /** the entry that contains it, -1: none */
  inside: number;
  /** of a cavity, or of low values and enclosed: the entry of the object around it, -1: none */
  around: number;
  /** number of the entry of its branch whose card shows it; absent, or its own: it has a card */
  card?: number;
  /** with that entry: voxels of both by voxels of either */
  overlap?: number;
  /** reason for this isovalue, as a key and as a sentence; empty: unknown */
  reason: string;
  why: string;
  colour: string;
  picture: Picture | null;
  /** absent, null: of a 2D volume, or there was no room for it */
  mesh?: PageMesh | null;
  commands: { name: string; line: string }[];
}

/** counts[i] samples from edges[i] to edges[i + 1]. */
export interface Histogram {
  edges: number[];
  counts: number[];
}

/** kept[i] objects have a hypervolume (contrast x size) of at least threshold[i], which descends. */
export interface Curve {
  threshold: number[];
  kept: number[];
  automaticThreshold: number;
  automaticKept: number;
}

/** Number of all of them, and of those above the noise level that are not very small. */
export interface Found {
  all: number;
  significant: number;
}

/** Everything at an isovalue. */
export interface Smoothed {
  objects: number;
  tunnels: number;
  picture: Picture | null;
}

/** As it is and smoothed, at one isovalue. */
export interface Comparison {
  tau: number;
  asItIs: Smoothed;
  smooth: Smoothed;
}

export interface Page {
  schema: "isoatlas/page/3";
  version: string;
  volume: {
    name: string;
    size: number[];
    type: string;
    /** null: uneven steps between samples */
    spacing: number[] | null;
    /** of uneven steps: per axis the positions of its samples, relative to the first one */
    coordinates?: number[][];
    /** meaning of the axes of space: "LPS", "RAS", ..., "unknown" */
    space: string;
    /** of the first sample, physical */
    origin: [number, number, number];
    /** rows; column a: unit vector of axis a */
    direction: [number, number, number][];
    /** of lengths; null: unknown, measures are in voxels */
    unit: string | null;
    valueUnit: string | null;
    low: number;
    high: number;
    noise: number;
  };
  /** what was assumed about the samples, and how to undo it */
  notes?: string[];
  /** offered where the noise is strong: its part of the range of values, and the command that makes the page of the filtered volume */
  smoothing?: { noisePart: number; sigma: number; command: string; comparison?: Comparison | null } | null;
  interpolant: string;
  /** objects of high values, or of low ones: those appear at their lowest value and merge at a higher one; absent: high; both: the
   * entries of both in one list, and all that is not about a branch or in `low` is of high values */
  polarity?: "high" | "low" | "both";
  low?: { found: Found; noise: number; spectrum: Spectrum | null; curve: Curve };
  found: { objects: Found; cavities: Found };
  /** bend: null for a linear axis; else equal steps of asinh((value - low) / bend) */
  axis: { low: number; high: number; bend: number | null };
  histogram: Histogram;
  spectrum: Spectrum | null;
  curve: Curve;
  branches: Branch[];
  entries: Entry[];
  /** false: without some of the pictures and all meshes, while isoatlas draws them; absent: true */
  complete?: boolean;
  /** entries that are not on the page, by number from entries.length on: viewer/api/catalogue.ts */
  further?: (i: number) => Entry | undefined;
}

export function readPage(text: string): Page | null {
  const page = JSON.parse(text) as Page | null;
  if (page !== null && page.schema !== "isoatlas/page/3") throw new Error(`unsupported page: ${String(page.schema)}`);
  return page;
}

export function entryOf(page: Page, i: number): Entry {
  const entry = page.entries[i] ?? page.further?.(i);
  if (!entry) throw new Error(`no entry ${i}`);
  return entry;
}

/** shared/cards.ts */
export function hasCard(entry: Entry): boolean {
  return !entry.card || entry.card === entry.number;
}

export function branchOf(page: Page, b: number): Branch {
  const branch = page.branches[b];
  if (!branch) throw new Error(`no branch ${b}`);
  return branch;
}

/** Does a branch consist of samples of at most its isovalues? */
export function isOfLowValues(page: Page, branch: Branch): boolean {
  return (branch.polarity ?? page.polarity) === "low";
}

/** Is it of low values among others of high ones? */
export function isLowOfBoth(page: Page, branch: Branch): boolean {
  return page.polarity === "both" && branch.polarity === "low";
}

/** Where the isovalues of a branch end that never merges: the end of the axis on the side of its merges. */
export function endOfBranch(page: Page, branch: Branch): number {
  const grows = isOfLowValues(page, branch) !== (branch.side === "cavity");
  return branch.merges ?? (grows ? page.axis.high : page.axis.low);
}
