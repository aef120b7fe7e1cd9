// State of volume rendering.
import type { Page } from "../../shared/page";
import { number } from "./part";

const MAX_FACTOR = 16;

/** factor of the proposed opacity; null: off */
export const VOLUME_DENSITY = number("volume", "volume rendering", (factor) => factor > 0 && factor <= MAX_FACTOR, "matter");

/** Volume rendering needs even steps: rays go from sample to sample, here and in `isoatlas render --volume`. */
export function hasUniformSpacing({ volume }: Pick<Page, "volume">): boolean {
  return volume.spacing !== null;
}
