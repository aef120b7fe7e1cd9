// The contour of a surface on a slice: where the slice's plane cuts the triangles that are drawn, so that both say the same.
import { acrossAndDown, type AxisNumber, type Grid } from "./grid";
import type { Mesh } from "./wire";

/**
 * Pieces of the contour, four numbers each: column and row of both ends, in samples. A point on the plane counts as in front of it, so
 * that the curves of a closed surface are closed. Cost: a pass over points and triangles.
 */
export function cutMesh(mesh: Mesh, grid: Grid, axis: AxisNumber, index: number): Float32Array {
  const rows = grid.fromSteps(mesh.origin, mesh.step);
  const [u, v] = acrossAndDown(axis);
  const { positions, corners } = mesh;
  const heights = heightsOver(positions, rows[axis], index);
  const pieces: number[] = [];
  const put = (a: number, b: number): void => {
    const t = (heights[a] as number) / ((heights[a] as number) - (heights[b] as number));
    for (const row of [rows[u], rows[v]]) pieces.push((1 - t) * along(row, positions, a) + t * along(row, positions, b));
  };
  for (let i = 0; i < corners.length; i += 3) {
    const a = corners[i] as number;
    const b = corners[i + 1] as number;
    const c = corners[i + 2] as number;
    const isFrontA = (heights[a] as number) >= 0;
    const isFrontB = (heights[b] as number) >= 0;
    const isFrontC = (heights[c] as number) >= 0;
    if (isFrontA === isFrontB && isFrontB === isFrontC) continue;
    const [alone, next, last] = isFrontB === isFrontC ? [a, b, c] : isFrontA === isFrontC ? [b, c, a] : [c, a, b];
    put(alone, next);
    put(alone, last);
  }
  return Float32Array.from(pieces);
}

function along(row: readonly number[], positions: Uint16Array, point: number): number {
  const at = 3 * point;
  return row[0]! * positions[at]! + row[1]! * positions[at + 1]! + row[2]! * positions[at + 2]! + row[3]!;
}

function heightsOver(positions: Uint16Array, row: readonly number[], index: number): Float32Array {
  const [x, y, z, first] = row as [number, number, number, number];
  const heights = new Float32Array(positions.length / 3);
  for (let i = 0, at = 0; i < heights.length; ++i, at += 3) heights[i] = x * positions[at]! + y * positions[at + 1]! + z * positions[at + 2]! + first - index;
  return heights;
}
