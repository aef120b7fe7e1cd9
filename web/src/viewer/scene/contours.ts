// Contours of all visible surfaces on slices; the last contour per axis is cached.
import { AXES, type AxisNumber, type Grid } from "../state/grid";
import { SlicedMesh } from "./plane_cut";
import type { Viewport } from "./viewport";
import type { Mesh } from "../../shared/wire";

export interface Contour {
  colour: string;
  /** segments of plane_cut.ts */
  pieces: Float32Array;
}

interface CachedCuts {
  sliced: SlicedMesh;
  /** per axis: the last slice */
  cuts: ({ index: number; pieces: Float32Array } | undefined)[];
}

export class Contours {
  private readonly cache = new WeakMap<Mesh, CachedCuts>();

  constructor(
    private readonly viewport: Viewport,
    private readonly grid: Grid,
  ) {}

  on(axis: AxisNumber, index: number): Contour[] {
    return this.viewport.visibleSurfaces.map(({ mesh, colour }) => ({ colour, pieces: this.cut(mesh, axis, index) }));
  }

  private cut(mesh: Mesh, axis: AxisNumber, index: number): Float32Array {
    const cache = this.cache.get(mesh) ?? { sliced: new SlicedMesh(mesh, this.grid), cuts: AXES.map(() => undefined) };
    this.cache.set(mesh, cache);
    const before = cache.cuts[axis];
    if (before?.index === index) return before.pieces;
    const pieces = cache.sliced.cut(axis, index);
    cache.cuts[axis] = { index, pieces };
    return pieces;
  }
}
