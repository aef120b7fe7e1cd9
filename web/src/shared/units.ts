// Units of lengths: that of the file, or the one that the user has chosen to see. A file that has none is taken to be in the chosen one.

/** in metres */
const METRES: Record<string, number> = { nm: 1e-9, "µm": 1e-6, mm: 1e-3, cm: 1e-2, m: 1 };

/** Those that can be chosen. */
export const UNITS: readonly string[] = Object.keys(METRES);

let chosen: string | null = null;

/** null: that of the file. Text that is made from now on has it. */
export function chooseUnit(unit: string | null): void {
  chosen = unit;
}

/** Does the file say no unit? unit: Page.volume.unit. */
export function hasNoUnit(unit: string | null): boolean {
  return unit === null || unit === "units";
}

/** Are lengths in voxels, and volumes their number? */
export function countsVoxels(unit: string | null): boolean {
  return unit === null && chosen === null;
}

/** Can lengths of the file be shown in other units? Not in those of degrees, parsecs, ... */
export function canChoose(unit: string | null): boolean {
  return hasNoUnit(unit) || METRES[unit ?? ""] !== undefined;
}

/** The chosen unit where the file says none: what commands and files have to be told. */
export function declaredUnit(unit: string | null): string | null {
  return hasNoUnit(unit) ? chosen : null;
}

export interface Quantity {
  amount: number;
  /** null: voxels */
  unit: string | null;
  isChosen: boolean;
}

/** A length (power 1), area (2) or volume (3), given in the unit of the file, as it is shown. */
export function shownQuantity(amount: number, unit: string | null, power: 1 | 2 | 3): Quantity {
  if (chosen === null || !canChoose(unit)) return { amount, unit, isChosen: false };
  const factor = hasNoUnit(unit) ? 1 : Number(((METRES[unit ?? ""] ?? 1) / (METRES[chosen] ?? 1)).toPrecision(12));
  return { amount: amount * factor ** power, unit: chosen, isChosen: true };
}
