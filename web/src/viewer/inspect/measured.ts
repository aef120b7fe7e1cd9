// What the server measures of an object at the isovalue it is shown at.
import { area, count, plural, value, volume } from "../../format";
import { entryOf, type Page } from "../../page";
import { isOvertaken, type Measures } from "../ask/api";
import type { Desk } from "../desk/desk";
import { branchOfShown } from "../ask/shown";
import type { Shown } from "../state/state";

/** Is it measured at the isovalue of its entry? Then the number of its voxels is known, too. */
export function tellsOfItself(page: Page, { entry, tau }: Shown): boolean {
  return branchOfShown(page, entry)?.side === "bright" && entryOf(page, entry).tau === tau;
}

/** Nothing where it cannot be told: of a dark object, of all there is, or of an object that is not there. */
export async function measuredFacts({ api, page }: Desk, shown: Shown): Promise<[name: string, text: string][]> {
  if (branchOfShown(page, shown.entry)?.side !== "bright") return [];
  const { id, voxels } = entryOf(page, shown.entry);
  try {
    const [there] = await api.measures(shown.tau, [id]);
    if (!there) return [];
    return factsOf(tellsOfItself(page, shown) ? { ...there, voxels: [voxels, voxels] } : there, id, shown.tau, page.volume.unit);
  } catch (error) {
    return isOvertaken(error) ? [] : [[`at ${value(shown.tau)}`, "it is not there"]];
  }
}

/** id: of the object that was asked for. */
export function factsOf(there: Measures, id: number, tau: number, unit: string | null): [name: string, text: string][] {
  return [
    [`at ${value(tau)}`, `${there.id === id ? "" : "part of a larger object: "}${sizeOf(there, unit)}`],
    ["area", area(there.area, unit)],
    ["shape", `${plural(there.tunnels, "tunnel")}, ${plural(there.cavities, "cavity", "cavities")}`],
  ];
}

/** of the most: then the least says something, too */
const KNOWN = 0.8;

/** Of voxels there may be bounds alone: those that say little are left out; without a unit, what the surface encloses is told. */
function sizeOf({ voxels: [least, most], volume: enclosed }: Measures, unit: string | null): string {
  const voxels = least === most ? plural(most, "voxel") : `${count(least)} to ${plural(most, "voxel")}`;
  if (unit === null) return least === most ? voxels : `about ${plural(Number(enclosed.toPrecision(3)), "voxel")}`;
  return least >= KNOWN * most ? `${volume(enclosed, unit)}, ${voxels}` : volume(enclosed, unit);
}
