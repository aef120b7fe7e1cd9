// Are the values of a volume Hounsfield units? Presets of CT are offered where they are, or look like it.
import type { Page } from "../../shared/page";

/** Hounsfield units of air and of water, and the lowest and highest values that scanners write */
const [AIR, WATER, LOWEST, HIGHEST] = [-1000, 0, -10_000, 70_000];
/** values of air are at most this far from that of the definition */
const AIR_SPREAD = 300;

/**
 * By the unit of the values. null: the file says none, but there are values of air, as far below those of water as in
 * Hounsfield units.
 */
export function isHounsfield({ volume }: Pick<Page, "volume">): boolean | null {
  const { low, high, valueUnit, type } = volume;
  if ((valueUnit ?? "") !== "") return /^(hu|hounsfield( units?)?)$/i.test(valueUnit!);
  if (type === "uint8" || type === "int8") return false;
  return low >= LOWEST && low <= AIR + AIR_SPREAD && high > WATER && high <= HIGHEST ? null : false;
}
