// Locates a sample: the objects that contain it, by the trees of the server.
import { voxelWord } from "../../shared/names";
import { entryOf, type Page } from "../../shared/page";
import type { Api } from "./api";
import type { Triple } from "../state/grid";
import { EVERYTHING, targetOf } from "./entries";
import type { State } from "../state/state";

export interface Located {
  voxel: Triple;
  /** in units of the file */
  value: number;
  /** visible entries that contain it at their isovalue in the scene, innermost first */
  shown: number[];
  /** entries of the page that contain it at their recommended isovalue, innermost first */
  entries: number[];
}

interface LocateResponse {
  value: number;
  entries: number[];
  objects: boolean[];
  contours: boolean[];
}

/** Ascending size: objects that contain the same sample are nested. The whole isosurface comes last. */
export function innermostFirst(page: Page, entries: readonly number[]): number[] {
  const size = (entry: number): number => (entry === EVERYTHING ? Infinity : entryOf(page, entry).voxels);
  return [...entries].sort((p, q) => size(p) - size(q) || q - p);
}

export async function locate(api: Api, page: Page, state: State, voxel: Triple): Promise<Located> {
  const objects: number[] = [];
  const contours: number[] = [];
  const parameters = { object: [] as string[], contour: [] as string[] };
  for (const { entry, tau, visible } of state.shown) {
    const target = targetOf(page, entry);
    if (!target || !visible) continue;
    const low = target.polarity ?? "";
    if ("object" in target) parameters.object.push(`${low}${voxelWord(target.object)}@${tau}`), objects.push(entry);
    else parameters.contour.push(`${low}${voxelWord(target.contour)}@${tau}`), contours.push(entry);
  }
  const query = Object.entries(parameters).map(([name, items]) => (items.length > 0 ? `&${name}=${items.join(",")}` : ""));
  const response = (await (await api.request(`/api/at?voxel=${voxel.join(",")}${query.join("")}`, "at")).json()) as LocateResponse;
  const everything = state.shown.filter(({ entry, tau, visible }) => entry === EVERYTHING && visible && response.value >= tau);
  const located = [
    ...objects.filter((_, i) => response.objects[i]),
    ...contours.filter((_, i) => response.contours[i]),
    ...everything.map(({ entry }) => entry),
  ];
  return { voxel, value: response.value, shown: innermostFirst(page, located), entries: response.entries };
}
