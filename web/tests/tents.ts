// The sum of tents as a table, tent by tent, in closed form: the oracle of the opacity curves.
import { linearOf } from "../src/viewer/state/light";
import { PLACES, type OpacityTent } from "../src/viewer/api/transfer_function";

/** Integral from -infinity to value of a ramp that rises from 0 at start to 1 at start + ramp and stays 1. */
function rampIntegral(value: number, start: number, ramp: number): number {
  const x = value - start;
  if (x <= 0) return 0;
  return x < ramp ? (x * x) / (2 * ramp) : x - ramp / 2;
}

/** As transferTable() of the layers of these tents. */
export function tableOfTents(tents: readonly OpacityTent[], low: number, high: number): Float32Array {
  const table = new Float64Array(4 * (PLACES + 1));
  const perPlace = (high - low) / PLACES;
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
  return new Float32Array(table);
}
