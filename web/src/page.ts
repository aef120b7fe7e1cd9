// What `isoatlas` writes into the page: docs/schema/page.schema.json.

/** A turntable: frames side by side in one picture, from the front once around. */
export interface Picture {
  /** data: URI */
  image: string;
  frames: number;
  width: number;
  height: number;
}

/** An object at the isovalue that shows it best. Values are in units of the file. */
export interface Entry {
  id: number;
  side: "bright" | "dark";
  appears: number;
  /** null: it never merges into another one */
  merges: number | null;
  best: number;
  /** between these it keeps its tunnels and cavities */
  low: number;
  high: number;
  voxels: number;
  /** physical volume, or voxels where the file has no unit */
  measure: number;
  tunnels: number;
  cavities: number;
  hypervolume: number;
  /** the entry it lies in, -1: none */
  inside: number;
  /** the entry whose object it merges into when the isovalue goes on, -1: none that is shown */
  into: number;
  trunk: boolean;
  note: string;
  colour: string;
  picture: Picture | null;
  commands: { name: string; line: string }[];
}

export interface Histogram {
  low: number;
  high: number;
  counts: number[];
}

/** How many there are at the isovalues tau[i]. */
export interface Spectrum {
  tau: number[];
  objects: number[];
  contours: number[];
  tunnels: number[];
  cavities: number[];
}

export interface Page {
  schema: "isoatlas/page/1";
  version: string;
  volume: {
    name: string;
    size: number[];
    type: string;
    spacing: number[] | null;
    /** of lengths; null: not known, measures are voxels */
    unit: string | null;
    valueUnit: string | null;
    low: number;
    high: number;
    noise: number;
  };
  interpolant: string;
  /** objects in all, and the rule that chose those on the page */
  branches: number;
  rule: string;
  histogram: Histogram;
  objects: Entry[];
  spectrum: Spectrum | null;
}

export function readPage(text: string): Page | null {
  const page = JSON.parse(text) as Page | null;
  if (page !== null && page.schema !== "isoatlas/page/1") throw new Error(`unknown page: ${String(page.schema)}`);
  return page;
}
