// Text of numbers, volumes and areas.
import { shownQuantity } from "./units";

const groups = new Intl.NumberFormat("en", { maximumFractionDigits: 0 });

/** About four significant digits; integers of 1000 and more keep all digits. */
export function value(x: number): string {
  if (x === 0) return "0";
  const size = Math.abs(x);
  if (size >= 1e6 || size < 1e-3) return x.toExponential(2).replace(/\.?0*e\+?/, "e");
  return String(size >= 1000 ? Math.round(x) : Number(x.toPrecision(4)));
}

export function count(n: number): string {
  return groups.format(n);
}

export function plural(n: number, one: string, many = `${one}s`): string {
  return n === 0 ? `no ${many}` : `${count(n)} ${n === 1 ? one : many}`;
}

const ladders: Record<string, [string, number][]> = {
  mm: [["cm", 10], ["dm", 10], ["m", 10]],
  "µm": [["mm", 1000], ["m", 1000]],
  nm: [["µm", 1000], ["mm", 1000], ["m", 1000]],
};

/** A volume in unit^3, in the largest unit in which it is at least 1, or in the chosen one. */
export function volume(measure: number, unit: string | null): string {
  return powerOf(measure, unit, 3) ?? plural(measure, "voxel");
}

/** An area in unit^2; null: the unit is a face of a voxel, as a voxel is the unit of volumes. */
export function area(measure: number, unit: string | null): string {
  return powerOf(measure, unit, 2) ?? plural(Math.round(measure), "voxel face");
}

/** A length in the unit; null: in voxels. */
export function length(measure: number, unit: string | null): string {
  return powerOf(measure, unit, 1) ?? `${value(Number(measure.toPrecision(3)))} voxels`;
}

/** null: there is no unit, and none is chosen. */
function powerOf(measure: number, unit: string | null, power: 1 | 2 | 3): string | null {
  const shown = shownQuantity(measure, unit, power);
  if (shown.unit === null) return null;
  let name = shown.unit;
  let size = shown.amount;
  for (const [larger, factor] of shown.isChosen ? [] : (ladders[name] ?? [])) {
    if (size < factor ** power) break;
    size /= factor ** power;
    name = larger;
  }
  const digits = Number(size.toPrecision(3));
  const text = digits >= 1000 && digits < 1e15 ? count(digits) : value(digits);
  return `${text} ${name}${["", "²", "³"][power - 1]}`;
}
