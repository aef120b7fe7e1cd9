// The clipping plane: its normal and the fraction of the volume that stays.
import { cross, dot, type Triple } from "./grid";
import { numbers } from "./part";

/** A unit vector from the removed side to the side that stays, and the fraction of the volume's extent along it that stays. */
export const CUT = numbers(
  "cut",
  "clipping plane",
  4,
  ([x, y, z, share]) => Math.abs(Math.hypot(x!, y!, z!) - 1) < 1e-3 && share! >= 0 && share! <= 1,
);

export interface Plane {
  normal: Triple;
  /** kept half-space: normal . place + constant >= 0 */
  constant: number;
}

function extentAlong(normal: Triple, corners: readonly Triple[]): [number, number] {
  const along = corners.map((corner) => dot(normal, corner));
  return [Math.min(...along), Math.max(...along)];
}

/** corners: of the volume, physical. */
export function planeOf([x, y, z, share]: readonly number[], corners: readonly Triple[]): Plane {
  const normal: Triple = [x!, y!, z!];
  const [low, high] = extentAlong(normal, corners);
  return { normal, constant: share! * (high - low) - high };
}

/** The cut after moving its plane by a physical distance along the normal. */
export function moved([x, y, z, share]: readonly number[], by: number, corners: readonly Triple[]): number[] {
  const [low, high] = extentAlong([x!, y!, z!], corners);
  return [x!, y!, z!, Math.min(Math.max(share! - by / (high - low || 1), 0), 1)];
}

/** The opposite half-space of the same plane. */
export function turned([x, y, z, share]: readonly number[]): number[] {
  return [-x! + 0, -y! + 0, -z! + 0, 1 - share!];
}

/** Polygon of the plane in the box of the volume, in order; empty: no intersection. corners: bit a: the far end of axis a. */
export function outlineOf({ normal, constant }: Plane, corners: readonly Triple[]): Triple[] {
  const height = (i: number): number => dot(normal, corners[i]!) + constant;
  const points: Triple[] = [];
  for (let i = 0; i < 8; ++i) {
    for (const bit of [1, 2, 4]) {
      if (i & bit || height(i) > 0 === height(i | bit) > 0) continue;
      const t = height(i) / (height(i) - height(i | bit));
      points.push(corners[i]!.map((n, axis) => n + t * (corners[i | bit]![axis]! - n)) as Triple);
    }
  }
  return around(points, normal);
}

export function middleOfAll(points: readonly Triple[]): Triple {
  return [0, 1, 2].map((axis) => points.reduce((sum, point) => sum + point[axis]!, 0) / points.length) as Triple;
}

function around(points: Triple[], normal: Triple): Triple[] {
  if (points.length < 3) return [];
  const middle = middleOfAll(points);
  const from = (point: Triple): Triple => point.map((n, axis) => n - middle[axis]!) as Triple;
  const first = from(points[0]!);
  const second = cross(normal, first);
  const angle = (point: Triple): number => Math.atan2(dot(second, from(point)), dot(first, from(point)));
  return [...points].sort((p, q) => angle(p) - angle(q));
}
