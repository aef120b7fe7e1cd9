// What the volume as matter keeps in a state.
import type { Page } from "../../page";
import { number } from "./part";

const MOST = 16;

/** factor of the densities that the tree proposes; null: the volume is not drawn */
export const MATTER = number("matter", "the volume as matter", (factor) => factor > 0 && factor <= MOST);

/** Matter is drawn of grids with even steps only: rays go from sample to sample, here and in `isoatlas render --volume`. */
export function isEven({ volume }: Pick<Page, "volume">): boolean {
  return volume.spacing !== null;
}
