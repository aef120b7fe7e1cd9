// What the volume as matter keeps in a state.
import { number } from "./part";

const MOST = 16;

/** factor of the densities that the tree proposes; null: the volume is not drawn */
export const MATTER = number("matter", "the volume as matter", (factor) => factor > 0 && factor <= MOST);
