// The contours of all surfaces of the stage on slices; each is cut once for every place of a slice.
import { cutMesh } from "./plane_cut";
import { AXES, type AxisNumber, type Grid } from "./grid";
import type { Stage } from "./stage";
import type { Mesh } from "./wire";

export interface Contour {
  colour: string;
  /** plane_cut.ts */
  pieces: Float32Array;
}

interface Cut {
  index: number;
  pieces: Float32Array;
}

export class Contours {
  private readonly cuts = new WeakMap<Mesh, (Cut | undefined)[]>();

  constructor(
    private readonly stage: Stage,
    private readonly grid: Grid,
  ) {}

  on(axis: AxisNumber, index: number): Contour[] {
    return this.stage.standing.map(({ mesh, colour }) => ({ colour, pieces: this.cut(mesh, axis, index) }));
  }

  private cut(mesh: Mesh, axis: AxisNumber, index: number): Float32Array {
    const cuts = this.cuts.get(mesh) ?? AXES.map(() => undefined);
    this.cuts.set(mesh, cuts);
    const before = cuts[axis];
    if (before?.index === index) return before.pieces;
    const pieces = cutMesh(mesh, this.grid, axis, index);
    cuts[axis] = { index, pieces };
    return pieces;
  }
}
