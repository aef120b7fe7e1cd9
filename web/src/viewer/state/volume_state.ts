// State of volume rendering.
import type { Page } from "../../shared/page";
import { layersIn, layersText, type Layer } from "./opacity_curve";
import { number, Part } from "./part";

const MAX_FACTOR = 16;

/** factor of all opacities; null: off */
export const VOLUME_DENSITY = number("volume", "volume rendering", (factor) => factor > 0 && factor <= MAX_FACTOR, "matter");

/** null: the proposal of the tree (api/transfer_proposal.ts) */
export const VOLUME_CURVE = new Part<readonly Layer[] | null>(
  "curve",
  "opacity curve",
  null,
  (layers) => (layers === null ? "" : layersText(layers)),
  layersIn,
);

const OPTICAL_MODELS = ["absorption-emission", "absorption", "emission", "single-scattering", "multiple-scattering"] as const;

/** optical model in which `isoatlas render` draws the scene; the viewer itself always shows absorption and emission */
export const VOLUME_OPTICS = new Part<(typeof OPTICAL_MODELS)[number]>(
  "optics",
  "optical model",
  OPTICAL_MODELS[0],
  (model) => model,
  (text) => OPTICAL_MODELS.find((model) => model === text) ?? null,
);

/** Volume rendering needs even steps: rays go from sample to sample, here and in `isoatlas render --volume`. */
export function hasUniformSpacing({ volume }: Pick<Page, "volume">): boolean {
  return volume.spacing !== null;
}

/** The length that opacities refer to: the smallest distance of two samples, in the unit of the file. */
export function voxelLength({ volume }: Pick<Page, "volume">): number {
  return Math.min(...(volume.spacing ?? [1]));
}
