// What stands beside the surfaces of a picture, as words of `isoatlas render`.
import type { Page } from "../../page";
import { AXES, AXIS_NAMES, Grid } from "./grid";
import { isEven, MATTER } from "./matter_state";
import { CROSSHAIR, middleOf, PLANES } from "./slice_state";
import type { State } from "./state";

export function besideWords(page: Page, state: State): string[] {
  const cross = new Grid(page).inside(CROSSHAIR.of(state) ?? middleOf(page));
  const slices = PLANES.of(state) ? AXES.map((axis) => `--slice ${AXIS_NAMES[axis]}=${cross[axis]}`) : [];
  return MATTER.of(state) === null || !isEven(page) ? slices : [...slices, "--volume"];
}
