// The contours of all surfaces of the stage on slices; each is cut once for every place of a slice.
import { AXES, type AxisNumber, type Grid } from "../state/grid";
import { SlicedMesh } from "./plane_cut";
import type { Stage } from "./stage";
import type { Mesh } from "../ask/wire";

export interface Contour {
  colour: string;
  /** plane_cut.ts */
  pieces: Float32Array;
}

interface Known {
  sliced: SlicedMesh;
  /** per axis: the slice that was cut last */
  cuts: ({ index: number; pieces: Float32Array } | undefined)[];
}

export class Contours {
  private readonly known = new WeakMap<Mesh, Known>();

  constructor(
    private readonly stage: Stage,
    private readonly grid: Grid,
  ) {}

  on(axis: AxisNumber, index: number): Contour[] {
    return this.stage.standing.map(({ mesh, colour }) => ({ colour, pieces: this.cut(mesh, axis, index) }));
  }

  private cut(mesh: Mesh, axis: AxisNumber, index: number): Float32Array {
    const known = this.known.get(mesh) ?? { sliced: new SlicedMesh(mesh, this.grid), cuts: AXES.map(() => undefined) };
    this.known.set(mesh, known);
    const before = known.cuts[axis];
    if (before?.index === index) return before.pieces;
    const pieces = known.sliced.cut(axis, index);
    known.cuts[axis] = { index, pieces };
    return pieces;
  }
}
