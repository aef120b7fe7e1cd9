// Transfer function: a sum of tents proposed from the tree, as a table of integrals (pre-integrated classification).
export interface OpacityTent {
  /** isovalue of the object that it shows */
  tau: number;
  /** support of the tent, in units of the file */
  low: number;
  high: number;
  /** fraction of high - low over which it rises, and the same over which it falls */
  ramp: number;
  /** extinction per unit of length between the ramps */
  density: number;
  /** #rrggbb */
  colour: string;
}

/** Extinction times linear red, green, blue; extinction. */
export type Medium = [number, number, number, number];

export const PLACES = 1024;
/** smallest distance of two places for a mean */
const CLOSE = 0.5;

/** Linear RGB of an sRGB colour. */
export function linearOf(colour: string): [number, number, number] {
  const parts = [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16) / 255);
  return parts.map((part) => (part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4)) as [number, number, number];
}

/** Integral from -infinity to value of a ramp that rises from 0 at start to 1 at start + ramp and stays 1. */
function rampIntegral(value: number, start: number, ramp: number): number {
  const x = value - start;
  if (x <= 0) return 0;
  return x < ramp ? (x * x) / (2 * ramp) : x - ramp / 2;
}

/** Integrals from place 0 up to places 0 to PLACES: four numbers each, as Medium. A place is (high - low) / PLACES. */
export function transferTable(tents: readonly OpacityTent[], low: number, high: number): Float32Array<ArrayBuffer> {
  const table = new Float32Array(4 * (PLACES + 1));
  const perPlace = (high - low) / PLACES;
  if (!(perPlace > 0)) return table;
  for (const tent of tents) {
    const colour = linearOf(tent.colour);
    const ramp = tent.ramp * (tent.high - tent.low);
    const integral = (value: number): number =>
      tent.density * (rampIntegral(value, tent.low, ramp) - rampIntegral(value, tent.high - ramp, ramp));
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

/** Mean of the medium between two places, for values that vary linearly between them (Engel, Kraus, Ertl, 2001). */
export function meanBetween(table: Float32Array, a: number, b: number): Medium {
  const middle = (a + b) / 2;
  const half = Math.max(Math.abs(b - a), CLOSE) / 2;
  const low = Math.min(Math.max(middle - half, 0), PLACES - CLOSE);
  const high = Math.max(Math.min(middle + half, PLACES), low + CLOSE);
  return [0, 1, 2, 3].map((part) => (integralTo(table, high, part) - integralTo(table, low, part)) / (high - low)) as Medium;
}
