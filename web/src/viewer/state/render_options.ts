// Options of `isoatlas render` for what is drawn besides surfaces: slices and the volume.
import type { Page } from "../../shared/page";
import { AXES, AXIS_NAMES, Grid } from "./grid";
import { hasUniformSpacing, VOLUME_DENSITY } from "./volume_state";
import { CROSSHAIR, middleOf, PLANES } from "./slice_state";
import type { State } from "./state";

export function renderOptions(page: Page, state: State): string[] {
  const cross = new Grid(page).inside(CROSSHAIR.of(state) ?? middleOf(page));
  const slices = PLANES.of(state) ? AXES.map((axis) => `--slice ${AXIS_NAMES[axis]}=${cross[axis]}`) : [];
  return VOLUME_DENSITY.of(state) === null || !hasUniformSpacing(page) ? slices : [...slices, "--volume"];
}
