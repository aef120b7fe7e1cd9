// Which values are matter of which colour and density: the transfer function that the tree proposes, with its integrals.
export interface Bump {
  /** isovalue of the object that it shows */
  tau: number;
  /** nothing below low and above high; values in units of the file */
  low: number;
  high: number;
  /** part of high - low over which it rises, and as much over which it falls */
  ramp: number;
  /** extinction per unit of length between the ramps */
  density: number;
  /** #rrggbb */
  colour: string;
}

/** Extinction times linear red, green, blue; extinction. */
export type Matter = [number, number, number, number];

export const PLACES = 1024;
/** places between two values that are not told apart */
const CLOSE = 0.5;

/** Linear light of a colour of the web. */
export function linearOf(colour: string): [number, number, number] {
  const parts = [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16) / 255);
  return parts.map((part) => (part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4)) as [number, number, number];
}

/** Integral from -infinity to value of what rises from 0 at the start to 1 after the ramp, and stays. */
function risen(value: number, start: number, ramp: number): number {
  const x = value - start;
  if (x <= 0) return 0;
  return x < ramp ? (x * x) / (2 * ramp) : x - ramp / 2;
}

/** Integrals over places 0 to PLACES between two values: four numbers each, as Matter. A place is (high - low) / PLACES. */
export function transferTable(bumps: readonly Bump[], low: number, high: number): Float32Array<ArrayBuffer> {
  const table = new Float32Array(4 * (PLACES + 1));
  const perPlace = (high - low) / PLACES;
  if (!(perPlace > 0)) return table;
  for (const bump of bumps) {
    const colour = linearOf(bump.colour);
    const ramp = bump.ramp * (bump.high - bump.low);
    const integral = (value: number): number => bump.density * (risen(value, bump.low, ramp) - risen(value, bump.high - ramp, ramp));
    for (let i = 0; i <= PLACES; ++i) {
      const sum = (integral(low + i * perPlace) - integral(low)) / perPlace;
      for (let part = 0; part < 4; ++part) table[4 * i + part]! += sum * (colour[part] ?? 1);
    }
  }
  return table;
}

function integralTo(table: Float32Array, place: number, part: number): number {
  const i = Math.min(Math.floor(place), PLACES - 1);
  const first = table[4 * i + part]!;
  return first + (place - i) * (table[4 * i + 4 + part]! - first);
}

/** Mean of the matter between two places, as where the value goes evenly from one to the other (Engel, Kraus, Ertl, 2001). */
export function meanBetween(table: Float32Array, a: number, b: number): Matter {
  const middle = (a + b) / 2;
  const half = Math.max(Math.abs(b - a), CLOSE) / 2;
  const low = Math.min(Math.max(middle - half, 0), PLACES - CLOSE);
  const high = Math.max(Math.min(middle + half, PLACES), low + CLOSE);
  return [0, 1, 2, 3].map((part) => (integralTo(table, high, part) - integralTo(table, low, part)) / (high - low)) as Matter;
}
