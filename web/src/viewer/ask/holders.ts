// What holds a sample: the server's trees know.
import { entryOf, type Page } from "../../page";
import type { Api } from "./api";
import type { Triple } from "../state/grid";
import { EVERYTHING, whichOf } from "./shown";
import type { State } from "../state/state";

export interface Held {
  voxel: Triple;
  /** in units of the file */
  value: number;
  /** entries that are shown and hold it at the isovalue they are shown at, innermost first */
  shown: number[];
  /** entries of the atlas that hold it at their isovalues, innermost first */
  entries: number[];
}

interface Answer {
  value: number;
  entries: number[];
  objects: boolean[];
  contours: boolean[];
}

/** The smallest first: what holds the same sample lies in each other. What is all there is lies around everything. */
export function innermostFirst(page: Page, entries: readonly number[]): number[] {
  const size = (entry: number): number => (entry === EVERYTHING ? Infinity : entryOf(page, entry).voxels);
  return [...entries].sort((p, q) => size(p) - size(q) || q - p);
}

export async function holdersOf(api: Api, page: Page, state: State, voxel: Triple): Promise<Held> {
  const objects: number[] = [];
  const contours: number[] = [];
  const words = { object: [] as string[], contour: [] as string[] };
  for (const { entry, tau, visible } of state.shown) {
    const which = whichOf(page, entry);
    if (!which || !visible) continue;
    if ("object" in which) words.object.push(`${which.object}@${tau}`), objects.push(entry);
    else words.contour.push(`${which.contour}@${tau}`), contours.push(entry);
  }
  const more = Object.entries(words).map(([name, items]) => (items.length > 0 ? `&${name}=${items.join(",")}` : ""));
  const answer = (await (await api.ask(`/api/at?voxel=${voxel.join(",")}${more.join("")}`, "at")).json()) as Answer;
  const everything = state.shown.filter(({ entry, tau, visible }) => entry === EVERYTHING && visible && answer.value >= tau);
  const held = [
    ...objects.filter((_, i) => answer.objects[i]),
    ...contours.filter((_, i) => answer.contours[i]),
    ...everything.map(({ entry }) => entry),
  ];
  return { voxel, value: answer.value, shown: innermostFirst(page, held), entries: answer.entries };
}
