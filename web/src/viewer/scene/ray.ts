// Intersection of a ray with a mesh, by testing all triangles: 10 ns per triangle.
import type { Triple } from "../state/grid";
import type { Mesh } from "../../shared/wire";

/** A place is origin + t x direction, for t from begin to end. */
export interface Ray {
  origin: Triple;
  direction: Triple;
  begin: number;
  end: number;
}

const NEARLY_PARALLEL = 1e-12;
/** tolerance, so that no ray passes between two triangles */
const ROUND = 1e-7;

/** t of the first hit, from either side; null: none. Cost: a pass over the triangles (Möller and Trumbore, 1997). */
export function firstHit(mesh: Mesh, ray: Ray): number | null {
  const { positions, corners, step } = mesh;
  const [ox, oy, oz] = ray.origin.map((n, axis) => (n - mesh.origin[axis]!) / step) as Triple;
  const [dx, dy, dz] = ray.direction.map((n) => n / step) as Triple;
  let first = ray.end;
  let found = false;
  for (let i = 0; i < corners.length; i += 3) {
    const a = 3 * corners[i]!;
    const b = 3 * corners[i + 1]!;
    const c = 3 * corners[i + 2]!;
    const ax = positions[a]!;
    const ay = positions[a + 1]!;
    const az = positions[a + 2]!;
    const px = positions[b]! - ax;
    const py = positions[b + 1]! - ay;
    const pz = positions[b + 2]! - az;
    const qx = positions[c]! - ax;
    const qy = positions[c + 1]! - ay;
    const qz = positions[c + 2]! - az;
    const hx = dy * qz - dz * qy;
    const hy = dz * qx - dx * qz;
    const hz = dx * qy - dy * qx;
    const determinant = px * hx + py * hy + pz * hz;
    if (Math.abs(determinant) < NEARLY_PARALLEL) continue;
    const sx = ox - ax;
    const sy = oy - ay;
    const sz = oz - az;
    const u = (sx * hx + sy * hy + sz * hz) / determinant;
    if (u < -ROUND || u > 1 + ROUND) continue;
    const kx = sy * pz - sz * py;
    const ky = sz * px - sx * pz;
    const kz = sx * py - sy * px;
    const v = (dx * kx + dy * ky + dz * kz) / determinant;
    if (v < -ROUND || u + v > 1 + ROUND) continue;
    const t = (qx * kx + qy * ky + qz * kz) / determinant;
    if (t >= ray.begin && t < first) {
      first = t;
      found = true;
    }
  }
  return found ? first : null;
}

/** The part of a ray in the half-space normal . place + constant >= 0. */
export function clipped(ray: Ray, normal: readonly number[], constant: number): Ray {
  const at = (n: readonly number[]): number => n[0]! * normal[0]! + n[1]! * normal[1]! + n[2]! * normal[2]!;
  const start = at(ray.origin) + constant;
  const rise = at(ray.direction);
  if (rise === 0) return start >= 0 ? ray : { ...ray, end: ray.begin };
  const meets = -start / rise;
  return rise > 0 ? { ...ray, begin: Math.max(ray.begin, meets) } : { ...ray, end: Math.min(ray.end, meets) };
}
