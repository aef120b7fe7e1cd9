// Decodes slices and coarse volumes of the server: src/server/wire_samples.h documents the format.
import { AXES, acrossAndDown, type AxisNumber, type Triple } from "../state/grid";

const HEADER_BYTES = 40;
const TYPES = [Uint8Array, Int8Array, Uint16Array, Int16Array, Uint32Array, Int32Array, Float32Array, Float64Array] as const;

/** Samples of a slice; columns run along the lower one of its two axes. */
export interface Slice {
  axis: AxisNumber;
  index: number;
  columns: number;
  rows: number;
  /** step between the samples that are present */
  step: number;
  /** column + columns x row; a value in units of the file is slope x sample + intercept */
  samples: ArrayLike<number>;
  slope: number;
  intercept: number;
}

/** A volume with one byte per value: the mean of a cube of samples. Byte b is low + b / 255 (high - low). */
export interface CoarseVolume {
  size: Triple;
  /** samples along the edge of a cube */
  step: number;
  low: number;
  high: number;
  bytes: Uint8Array<ArrayBuffer>;
}

function headerOf(bytes: ArrayBuffer, magic: number, what: string): DataView {
  const header = new DataView(bytes);
  if (bytes.byteLength < HEADER_BYTES || header.getUint32(0, false) !== magic)
    throw new Error(`The response of the server is not a ${what}. Reload the page.`);
  return header;
}

export function decodeSlice(bytes: ArrayBuffer, axis: AxisNumber, index: number): Slice {
  const header = headerOf(bytes, 0x69617331, "slice");
  const [columns, rows, step, type] = [4, 8, 12, 16].map((at) => header.getUint32(at, true)) as [number, number, number, number];
  const Samples = TYPES[type];
  if (!Samples || bytes.byteLength !== HEADER_BYTES + columns * rows * Samples.BYTES_PER_ELEMENT)
    throw new Error("The slice is incomplete. Reload the page.");
  return {
    axis,
    index,
    columns,
    rows,
    step,
    samples: new Samples(bytes, HEADER_BYTES),
    slope: header.getFloat64(24, true),
    intercept: header.getFloat64(32, true),
  };
}

export function decodeVolume(bytes: ArrayBuffer): CoarseVolume {
  const header = headerOf(bytes, 0x69617631, "volume");
  const size = AXES.map((axis) => header.getUint32(4 + 4 * axis, true)) as Triple;
  if (bytes.byteLength !== HEADER_BYTES + size[0] * size[1] * size[2]) throw new Error("The volume is incomplete. Reload the page.");
  return {
    size,
    step: header.getUint32(16, true),
    low: header.getFloat64(24, true),
    high: header.getFloat64(32, true),
    bytes: new Uint8Array(bytes, HEADER_BYTES),
  };
}

/** Value in units of the file at a sample of the volume; null: not on this slice, or between the samples that are present. */
export function valueAt(slice: Slice, voxel: readonly number[]): number | null {
  const [across, down] = acrossAndDown(slice.axis);
  const column = (voxel[across] ?? 0) / slice.step;
  const row = (voxel[down] ?? 0) / slice.step;
  if (
    voxel[slice.axis] !== slice.index ||
    !Number.isInteger(column) ||
    !Number.isInteger(row) ||
    column >= slice.columns ||
    row >= slice.rows
  )
    return null;
  return slice.slope * (slice.samples[column + slice.columns * row] ?? 0) + slice.intercept;
}

/** RGBA rows of an image with these columns and rows. black, white: values in units of the file. */
export function greyOf(
  slice: Slice,
  columns: Uint32Array,
  rows: Uint32Array,
  black: number,
  white: number,
): Uint8ClampedArray<ArrayBuffer> {
  const pixels = new Uint8ClampedArray(4 * columns.length * rows.length).fill(255);
  const factor = (255 / (white - black || 1)) * slice.slope;
  const first = (255 / (white - black || 1)) * (slice.intercept - black);
  let at = 0;
  for (const row of rows) {
    for (const column of columns) {
      pixels[at] = pixels[at + 1] = pixels[at + 2] = factor * slice.samples[column + slice.columns * row]! + first;
      at += 4;
    }
  }
  return pixels;
}
