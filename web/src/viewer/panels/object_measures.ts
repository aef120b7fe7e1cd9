// Measures of an object at its current isovalue, computed by the server.
import { area, count, length, plural, value, volume } from "../../shared/format";
import { countsVoxels } from "../../shared/units";
import { entryOf, type Page } from "../../shared/page";
import { ConnectionError, failureText, isSuperseded, type Measures } from "../api/api";
import type { ViewerContext } from "../context/viewer_context";
import { branchOfShown, polarityOfEntry } from "../api/entries";
import type { Shown } from "../state/state";

/** Is it at the isovalue of its entry? Then its number of voxels is known exactly. */
export function isMeasuredAtEntry(page: Page, { entry, tau }: Shown): boolean {
  return branchOfShown(page, entry)?.side === "object" && entryOf(page, entry).tau === tau;
}

/** Empty for cavities, the whole isosurface, and objects that do not exist at this isovalue. */
export async function measuredFacts({ api, page }: ViewerContext, shown: Shown): Promise<[name: string, text: string][]> {
  if (branchOfShown(page, shown.entry)?.side !== "object") return [];
  const { id, voxels, measure } = entryOf(page, shown.entry);
  try {
    const [there] = await api.measures(shown.tau, [id], polarityOfEntry(page, shown.entry));
    if (!there) return [];
    const known = isMeasuredAtEntry(page, shown) ? { ...there, voxels: [voxels, voxels] as [number, number] } : there;
    return factsOf(known, id, shown.tau, page.volume.unit, voxels > 0 ? measure / voxels : 1);
  } catch (error) {
    if (isSuperseded(error) || error instanceof ConnectionError) return [];
    return [[`at ${value(shown.tau)}`, failureText(error)]];
  }
}

/**
 * id: the requested object. voxel: volume of a voxel. The first size is that of cards, tables and files: number of voxels times their
 * volume; what the surface encloses is named so.
 */
export function factsOf(there: Measures, id: number, tau: number, unit: string | null, voxel: number): [name: string, text: string][] {
  return [
    [`at ${value(tau)}`, `${there.id === id ? "" : "part of a larger object: "}${sizeOf(there, unit, voxel)}`],
    ["enclosed volume", countsVoxels(unit) ? plural(Number(there.volume.toPrecision(3)), "voxel") : volume(there.volume, unit)],
    ["area", area(there.area, unit)],
    ["diameters", diametersOf(there, unit)],
    ["sphericity", value(there.sphericity)],
    ["values", `mean ${value(there.values.mean)}, ${value(there.values.min)} to ${value(there.values.max)}`],
    ["topology", `${plural(there.tunnels, "tunnel")}, ${plural(there.cavities, "cavity", "cavities")}`],
  ];
}

/** Largest and smallest distance of two parallel planes that touch the object. */
function diametersOf({ feret }: Measures, unit: string | null): string {
  return [feret.max, feret.min].map((one) => (one === null ? "flat" : length(one, unit))).join(" by ");
}

/** relative width below which a range of voxels is shown */
const MIN_RATIO = 0.8;

/** Where only wide bounds of the number of voxels are known, the enclosed volume stands for it. */
function sizeOf({ voxels: [min, max], volume: enclosed }: Measures, unit: string | null, voxel: number): string {
  const voxels = min === max ? plural(max, "voxel") : `${count(min)} to ${plural(max, "voxel")}`;
  if (countsVoxels(unit)) return min === max ? voxels : `about ${plural(Number(enclosed.toPrecision(3)), "voxel")}`;
  if (min === max) return `${volume(max * voxel, unit)}, ${voxels}`;
  return min >= MIN_RATIO * max ? `about ${volume(enclosed, unit)}, ${voxels}` : `about ${volume(enclosed, unit)}`;
}
