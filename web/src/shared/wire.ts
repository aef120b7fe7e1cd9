// Decodes meshes of the server and of pages: src/preview/wire_mesh.h documents the format.
import { MeshoptDecoder } from "meshoptimizer";

export interface Mesh {
  /** position of a point: origin + step * its three numbers */
  origin: [number, number, number];
  step: number;
  /** three per point */
  positions: Uint16Array;
  /** three per point, 127 = 1 */
  normals: Int8Array;
  /** three per triangle */
  corners: Uint32Array;
  triangles: number;
  /** simplified: it has fewer triangles than the surface */
  coarse: boolean;
  /** of a level of detail: its topology is exact, and it is at most so many voxels from the surface */
  within?: number | undefined;
  /** of a level that is fine where it is near to the eye: no part is seen farther than so many pixels from the surface */
  pixels?: number | undefined;
  /** squares of points: not closed where it is cut */
  isOpen: boolean;
  /** of points of a surface without its triangles: about how far they are apart */
  spacing?: number | undefined;
  /** encoded size, before compression by HTTP */
  bytes: number;
}

const HEADER_BYTES = 56;
const POINT_BYTES = 8;

/** Decodes an octahedral unit vector of two bytes, times 127. */
export function decodeOctahedral(a: number, b: number): [number, number, number] {
  let x = a / 127;
  let y = b / 127;
  const z = 1 - Math.abs(x) - Math.abs(y);
  if (z < 0) {
    const before = x;
    x = (1 - Math.abs(y)) * (x < 0 ? -1 : 1);
    y = (1 - Math.abs(before)) * (y < 0 ? -1 : 1);
  }
  const scale = 127 / Math.hypot(x, y, z);
  return [Math.round(x * scale), Math.round(y * scale), Math.round(z * scale)];
}

export async function decodeMesh(bytes: ArrayBuffer, coarse = false): Promise<Mesh> {
  await MeshoptDecoder.ready;
  const header = new DataView(bytes);
  if (bytes.byteLength < HEADER_BYTES || header.getUint32(0, false) !== 0x69616d31)
    throw new Error("These are not the data of a mesh. Reload the page.");
  const [points, triangles, pointBytes, triangleBytes] = [4, 8, 12, 16].map((at) => header.getUint32(at, true)) as [
    number,
    number,
    number,
    number,
  ];
  const packed = new Uint8Array(bytes);
  const records = new Uint8Array(points * POINT_BYTES);
  const corners = new Uint32Array(triangles * 3);
  if (points > 0) MeshoptDecoder.decodeVertexBuffer(records, points, POINT_BYTES, packed.subarray(HEADER_BYTES, HEADER_BYTES + pointBytes));
  if (triangles > 0)
    MeshoptDecoder.decodeIndexBuffer(
      new Uint8Array(corners.buffer),
      triangles * 3,
      4,
      packed.subarray(HEADER_BYTES + pointBytes, HEADER_BYTES + pointBytes + triangleBytes),
    );
  const positions = new Uint16Array(points * 3);
  const normals = new Int8Array(points * 3);
  const words = new Uint16Array(records.buffer);
  const signed = new Int8Array(records.buffer);
  for (let i = 0; i < points; ++i) {
    for (let axis = 0; axis < 3; ++axis) positions[3 * i + axis] = words[4 * i + axis] ?? 0;
    normals.set(decodeOctahedral(signed[8 * i + 6] ?? 0, signed[8 * i + 7] ?? 0), 3 * i);
  }
  return {
    origin: [24, 32, 40].map((at) => header.getFloat64(at, true)) as [number, number, number],
    step: header.getFloat64(48, true),
    positions,
    normals,
    corners,
    triangles,
    coarse,
    isOpen: false,
    bytes: bytes.byteLength,
  };
}
