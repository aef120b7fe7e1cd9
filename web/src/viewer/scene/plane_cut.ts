// Contour of a surface on a slice: the plane intersected with the displayed triangles, so that both views agree.
import { acrossAndDown, type Affine, type AxisNumber, type Grid } from "../state/grid";
import type { Mesh } from "../../shared/wire";

/** triangles per block; neighbours in the order of the mesh are close in space */
const BLOCK = 256;

/** Coordinates of the points of a mesh along an axis, and their range in each block of triangles. */
interface Heights {
  points: Float32Array;
  low: Float32Array;
  high: Float32Array;
}

export class SlicedMesh {
  private readonly rows: Affine;
  private readonly heights: (Heights | undefined)[] = [];

  constructor(
    private readonly mesh: Mesh,
    private readonly grid: Grid,
  ) {
    this.rows = grid.fromSteps(mesh.origin, mesh.step);
  }

  /**
   * Segments of the contour, four numbers each: both ends in lengths along columns and rows. A point on the plane counts as
   * in front of it, so that the contours of a closed surface are closed. Cost: a pass over points and triangles for the
   * first slice of an axis; then over the blocks, and the triangles of the blocks that the plane intersects.
   */
  cut(axis: AxisNumber, index: number): Float32Array {
    const { points, low, high } = (this.heights[axis] ??= heightsOf(this.mesh, this.rows[axis]));
    const level = this.grid.rulers[axis].length(index);
    const pieces: number[] = [];
    for (let block = 0; block < low.length; ++block) {
      if (low[block]! < level && high[block]! >= level) this.cutBlock(block, axis, level, points, pieces);
    }
    return Float32Array.from(pieces);
  }

  private cutBlock(block: number, axis: AxisNumber, level: number, heights: Float32Array, pieces: number[]): void {
    const { corners, positions } = this.mesh;
    const [u, v] = acrossAndDown(axis);
    const put = (a: number, b: number): void => {
      const t = (level - heights[a]!) / (heights[b]! - heights[a]!);
      for (const row of [this.rows[u], this.rows[v]]) pieces.push((1 - t) * along(row, positions, a) + t * along(row, positions, b));
    };
    const end = Math.min(corners.length, 3 * BLOCK * (block + 1));
    for (let i = 3 * BLOCK * block; i < end; i += 3) {
      const [a, b, c] = [corners[i]!, corners[i + 1]!, corners[i + 2]!];
      const isFrontA = heights[a]! >= level;
      const isFrontB = heights[b]! >= level;
      const isFrontC = heights[c]! >= level;
      if (isFrontA === isFrontB && isFrontB === isFrontC) continue;
      const [alone, next, last] = isFrontB === isFrontC ? [a, b, c] : isFrontA === isFrontC ? [b, c, a] : [c, a, b];
      put(alone, next);
      put(alone, last);
    }
  }
}

function along(row: readonly number[], positions: Uint16Array, point: number): number {
  const at = 3 * point;
  return row[0]! * positions[at]! + row[1]! * positions[at + 1]! + row[2]! * positions[at + 2]! + row[3]!;
}

function heightsOf({ positions, corners }: Mesh, row: readonly number[]): Heights {
  const points = new Float32Array(positions.length / 3);
  for (let i = 0; i < points.length; ++i) points[i] = along(row, positions, i);
  const blocks = Math.ceil(corners.length / (3 * BLOCK));
  const [low, high] = [new Float32Array(blocks).fill(Infinity), new Float32Array(blocks).fill(-Infinity)];
  for (let i = 0; i < corners.length; ++i) {
    const block = Math.floor(i / (3 * BLOCK));
    const height = points[corners[i]!]!;
    if (height < low[block]!) low[block] = height;
    if (height > high[block]!) high[block] = height;
  }
  return { points, low, high };
}
