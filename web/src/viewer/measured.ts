// What the server measures of an object at the isovalue it is shown at.
import { count, plural, value } from "../format";
import { entryOf } from "../page";
import type { Desk } from "./desk";
import { branchOfShown } from "./shown";
import type { Shown } from "./state";

/** Nothing where it cannot be told: a dark object, all there is, or an object that another one has taken in. */
export async function measuredFacts({ api, page }: Desk, shown: Shown): Promise<[name: string, text: string][]> {
  if (branchOfShown(page, shown.entry)?.side !== "bright") return [];
  const { id } = entryOf(page, shown.entry);
  const there = await api.objects(shown.tau).then((all) => all.find((object) => object.id === id), () => undefined);
  const at = value(shown.tau);
  if (!there) return [[`at ${at}`, "part of a larger object, or not there"]];
  const [least, most] = there.voxels;
  const voxels = least === most ? plural(most, "voxel") : `${count(least)} to ${plural(most, "voxel")}`;
  return [[`at ${at}`, `${voxels}, ${plural(there.tunnels, "tunnel")}, ${plural(there.cavities, "cavity", "cavities")}`]];
}
