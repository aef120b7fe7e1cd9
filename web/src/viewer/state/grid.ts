// Maps samples to space: position = origin + direction x lengths along the axes (ruler.ts).
import type { Page } from "../../shared/page";
import { Ruler } from "./ruler";

export type Triple = [number, number, number];
export type AxisNumber = 0 | 1 | 2;
/** y = matrix x + offset, by rows: three factors and an offset each */
export type Affine = [number[], number[], number[]];

export const AXES: readonly AxisNumber[] = [0, 1, 2];
export const AXIS_NAMES = ["x", "y", "z"] as const;

/** The two other axes, ascending: columns and rows of a slice. */
export function acrossAndDown(axis: AxisNumber): [AxisNumber, AxisNumber] {
  return axis === 0 ? [1, 2] : axis === 1 ? [0, 2] : [0, 1];
}

export function dot(a: readonly number[], b: readonly number[]): number {
  return a[0]! * b[0]! + a[1]! * b[1]! + a[2]! * b[2]!;
}

export function cross(a: readonly number[], b: readonly number[]): Triple {
  return [a[1]! * b[2]! - a[2]! * b[1]!, a[2]! * b[0]! - a[0]! * b[2]!, a[0]! * b[1]! - a[1]! * b[0]!];
}

export function distance(a: readonly number[], b: readonly number[]): number {
  return Math.hypot(a[0]! - b[0]!, a[1]! - b[1]!, a[2]! - b[2]!);
}

export class Grid {
  readonly size: Triple;
  readonly origin: Triple;
  /** per axis: a unit vector along it */
  readonly directions: [Triple, Triple, Triple];
  readonly rulers: [Ruler, Ruler, Ruler];
  /** per axis: maps a position relative to the origin to its length along the axis */
  private readonly inverse: [Triple, Triple, Triple];

  constructor({ volume }: Page) {
    this.size = AXES.map((axis) => volume.size[axis] ?? 1) as Triple;
    this.origin = volume.origin;
    const ruler = (axis: AxisNumber): Ruler => new Ruler(this.size[axis], volume.spacing?.[axis] ?? 1, volume.coordinates?.[axis] ?? null);
    this.rulers = [ruler(0), ruler(1), ruler(2)];
    const direction = (axis: AxisNumber): Triple => volume.direction.map((row) => row[axis] ?? 0) as Triple;
    const [a, b, c] = (this.directions = [direction(0), direction(1), direction(2)]);
    const volumeOfCell = dot(a, cross(b, c));
    const over = (normal: Triple): Triple => normal.map((n) => n / volumeOfCell) as Triple;
    this.inverse = [over(cross(b, c)), over(cross(c, a)), over(cross(a, b))];
  }

  /** Physical position of a sample; fractional indices are interpolated. */
  place(sample: readonly number[]): Triple {
    const lengths = this.rulers.map((ruler, axis) => ruler.length(sample[axis] ?? 0));
    return AXES.map((row) => this.origin[row] + this.directions.reduce((sum, unit, axis) => sum + unit[row] * lengths[axis]!, 0)) as Triple;
  }

  sample(place: readonly number[]): Triple {
    const from = AXES.map((row) => (place[row] ?? 0) - this.origin[row]);
    return this.rulers.map((ruler, axis) => ruler.sample(dot(this.inverse[axis]!, from))) as Triple;
  }

  /** The nearest sample of the volume. */
  nearest(place: readonly number[]): Triple {
    return this.inside(this.sample(place));
  }

  inside(sample: readonly number[]): Triple {
    return AXES.map((axis) => Math.min(Math.max(Math.round(sample[axis] ?? 0), 0), this.size[axis] - 1)) as Triple;
  }

  /** Maps steps of a mesh (origin + step x numbers) to lengths along the axes. */
  fromSteps(origin: readonly number[], step: number): Affine {
    const from = AXES.map((row) => (origin[row] ?? 0) - this.origin[row]);
    return this.inverse.map((row) => [...row.map((n) => n * step), dot(row, from)]) as Affine;
  }

  /** Corners of the box of samples, physical; bit a of the index: the far end of axis a. */
  corners(): Triple[] {
    return [0, 1, 2, 3, 4, 5, 6, 7].map((corner) => this.place(AXES.map((axis) => (corner & (1 << axis) ? this.size[axis] - 1 : 0))));
  }
}
