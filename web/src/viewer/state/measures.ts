// Distances and angles between positions, as parts of a state.
import { distance, dot, type Triple } from "./grid";
import { numbersIn, Part, textOf } from "./part";

/** two positions: their distance; three: the angle at the second one */
export type Measure = Triple[];

const MAX = 100;

function read(text: string): Measure[] | null {
  if (text === "") return [];
  const measures: Measure[] = [];
  for (const item of text.split(";")) {
    const list = numbersIn(item);
    if (list?.length !== 6 && list?.length !== 9) return null;
    measures.push(Array.from({ length: list.length / 3 }, (_, i) => list.slice(3 * i, 3 * i + 3) as Triple));
  }
  return measures.length <= MAX ? measures : null;
}

export const MEASURES = new Part<Measure[]>(
  "measure",
  "measurements",
  [],
  (measures) => measures.map((places) => textOf(places.flat())).join(";"),
  read,
);

export function lengthOf(measure: Measure): number {
  return distance(measure[0] as Triple, measure[1] as Triple);
}

/** Degrees, 0 to 180; 0 where two positions coincide. */
export function angleOf([a, b, c]: Measure): number {
  const arm = (place: Triple): Triple => place.map((n, axis) => n - b![axis]!) as Triple;
  const [p, q] = [arm(a!), arm(c!)];
  const lengths = Math.hypot(...p) * Math.hypot(...q);
  return lengths === 0 ? 0 : (Math.acos(Math.min(Math.max(dot(p, q) / lengths, -1), 1)) * 180) / Math.PI;
}

/** Points of an arc between the arms of an angle; part: its radius as a fraction of the shorter arm. */
export function arcOf([a, b, c]: Measure, part = 0.3, pieces = 16): Triple[] {
  const arm = (place: Triple): Triple => place.map((n, axis) => n - b![axis]!) as Triple;
  const [p, q] = [arm(a!), arm(c!)];
  const [long, other] = [Math.hypot(...p), Math.hypot(...q)];
  const angle = (angleOf([a!, b!, c!]) * Math.PI) / 180;
  const radius = part * Math.min(long, other);
  if (Math.sin(angle) < 1e-6) return [];
  return Array.from({ length: pieces + 1 }, (_, i) => {
    const [first, second] = [Math.sin((1 - i / pieces) * angle) / long, Math.sin((i / pieces) * angle) / other];
    return b!.map((n, axis) => n + (radius * (first * p[axis]! + second * q[axis]!)) / Math.sin(angle)) as Triple;
  });
}
