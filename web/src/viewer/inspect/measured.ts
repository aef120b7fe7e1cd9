// What the server measures of an object at the isovalue it is shown at.
import { area, count, plural, value, volume } from "../../format";
import { entryOf } from "../../page";
import { isOvertaken, type Measures } from "../ask/api";
import type { Desk } from "../desk/desk";
import { branchOfShown } from "../ask/shown";
import type { Shown } from "../state/state";

/** Nothing where it cannot be told: of a dark object, of all there is, or of an object that is not there. */
export async function measuredFacts({ api, page }: Desk, shown: Shown): Promise<[name: string, text: string][]> {
  if (branchOfShown(page, shown.entry)?.side !== "bright") return [];
  const { id } = entryOf(page, shown.entry);
  try {
    const [there] = await api.measures(shown.tau, [id]);
    return there ? factsOf(there, id, shown.tau, page.volume.unit) : [];
  } catch (error) {
    return isOvertaken(error) ? [] : [[`at ${value(shown.tau)}`, "it is not there"]];
  }
}

/** id: of the object that was asked for. */
export function factsOf(there: Measures, id: number, tau: number, unit: string | null): [name: string, text: string][] {
  const [least, most] = there.voxels;
  const voxels = least === most ? plural(most, "voxel") : `${count(least)} to ${plural(most, "voxel")}`;
  const size = unit === null ? voxels : `${volume(there.volume, unit)}, ${voxels}`;
  return [
    [`at ${value(tau)}`, `${there.id === id ? "" : "part of a larger object: "}${size}`],
    ["area", area(there.area, unit)],
    ["shape", `${plural(there.tunnels, "tunnel")}, ${plural(there.cavities, "cavity", "cavities")}`],
  ];
}
