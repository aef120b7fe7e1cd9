// Surfaces drawn as the points of Dividing Cubes.
import { flag } from "./part";

export const POINTS = flag("points", "surfaces as points");
/** small cubes along each axis of a cell */
export const DIVISIONS = 2;
