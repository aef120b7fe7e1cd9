// A mesh as binary STL: 80 bytes of text, the number of triangles, then 50 bytes a triangle. Physical coordinates.
import type { Mesh } from "./wire";

export function stlOf(mesh: Mesh): ArrayBuffer {
  const { positions, corners, origin, step } = mesh;
  const bytes = new ArrayBuffer(84 + 50 * mesh.triangles);
  new Uint8Array(bytes).set(new TextEncoder().encode("isoatlas: coarse surface of a page").subarray(0, 80));
  const view = new DataView(bytes);
  view.setUint32(80, mesh.triangles, true);
  const place = (corner: number, axis: number): number => (origin[axis] ?? 0) + step * (positions[3 * (corners[corner] ?? 0) + axis] ?? 0);
  for (let t = 0; t < mesh.triangles; ++t) {
    const [p, q, r] = [0, 1, 2].map((k) => [0, 1, 2].map((axis) => place(3 * t + k, axis))) as [number[], number[], number[]];
    const side = (to: number[]): number[] => to.map((x, axis) => x - (p[axis] ?? 0));
    const [[a = 0, b = 0, c = 0], [d = 0, e = 0, f = 0]] = [side(q), side(r)];
    const normal = [b * f - c * e, c * d - a * f, a * e - b * d];
    const length = Math.hypot(...normal) || 1;
    [...normal.map((x) => x / length), ...p, ...q, ...r].forEach((x, i) => view.setFloat32(84 + 50 * t + 4 * i, x, true));
  }
  return bytes;
}
