// Options of `isoatlas render` for what is drawn besides surfaces: slices and the volume.
import type { Page } from "../../shared/page";
import { AXES, AXIS_NAMES, Grid } from "./grid";
import { pointsText, scaledBy, type Layer } from "./opacity_curve";
import { hasUniformSpacing, VOLUME_CURVE, VOLUME_DENSITY, VOLUME_OPTICS } from "./volume_state";
import { CROSSHAIR, middleOf, PLANES } from "./slice_state";
import type { State } from "./state";

/** proposal: of the opacity curve; null: not known yet, then that of the command line is used. */
export function renderOptions(page: Page, state: State, proposal: readonly Layer[] | null = null): string[] {
  const cross = new Grid(page).inside(CROSSHAIR.of(state) ?? middleOf(page));
  const slices = PLANES.of(state) ? AXES.map((axis) => `--slice ${AXIS_NAMES[axis]}=${cross[axis]}`) : [];
  return [...slices, ...volumeOptions(page, state, proposal)];
}

/** An option for each visible layer, whose opacities include the density, and one for the optical model. */
function volumeOptions(page: Page, state: State, proposal: readonly Layer[] | null): string[] {
  const factor = VOLUME_DENSITY.of(state);
  if (factor === null || !hasUniformSpacing(page)) return [];
  const layers = VOLUME_CURVE.of(state) ?? proposal;
  const model = VOLUME_OPTICS.of(state);
  const optics = model === VOLUME_OPTICS.initial ? [] : [`--optics ${model}`];
  if (layers === null) return ["--volume", ...optics];
  const curve = ({ points }: Layer): string => pointsText(scaledBy(points, factor), (colour) => colour.toUpperCase());
  const curves = layers.filter(({ visible }) => visible).map((layer) => `--transfer='${curve(layer)}'`);
  return curves.length === 0 ? [] : [...curves, ...optics];
}
