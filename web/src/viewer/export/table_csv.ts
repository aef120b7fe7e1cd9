// CSV table of the listed objects, one line each, with the isovalues in the scene.
import { nameOf, referenceOf, voxelWord } from "../../shared/names";
import { shownQuantity } from "../../shared/units";
import { branchOf, entryOf, type Page } from "../../shared/page";
import type { State } from "../state/state";

const COLUMNS = [
  "name",
  "object",
  "id",
  "side",
  "best_tau",
  "appears",
  "merges",
  "voxels",
  "volume",
  "unit",
  "tunnels",
  "cavities",
  "inside",
  "cavity_of",
  "shown_at",
];

/** Entries of the page and further objects of the scene. Volumes are in the unit of the file or the chosen one, or in voxels. */
export function tableCsv(page: Page, state: State): string {
  const further = state.shown.map(({ entry }) => entry).filter((i) => i >= page.entries.length);
  const lines = [...page.entries.keys(), ...further].map((i) => {
    const entry = entryOf(page, i);
    const branch = branchOf(page, entry.branch);
    const name = (k: number): string => (k >= 0 ? nameOf(page, k) : "");
    const shown = state.shown.find((one) => one.entry === i);
    const { amount, unit } = shownQuantity(entry.measure, page.volume.unit, 3);
    return [
      nameOf(page, i),
      referenceOf(page, i),
      voxelWord(entry.id),
      branch.side,
      entry.tau,
      branch.appears,
      branch.merges,
      entry.voxels,
      amount,
      unit ? `${unit}³` : "voxel",
      entry.tunnels,
      entry.cavities,
      name(entry.inside),
      name(entry.around),
      shown?.tau,
    ];
  });
  return [COLUMNS, ...lines].map((line) => `${line.map(cell).join(",")}\r\n`).join("");
}

export function cell(what: string | number | null | undefined): string {
  const text = String(what ?? "");
  return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}
