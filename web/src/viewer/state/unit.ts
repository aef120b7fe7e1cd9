// The unit of lengths that the user has chosen: a part of the link.
import { UNITS } from "../../shared/units";
import { Part } from "./part";

/** in addresses: letters alone */
const ascii = (unit: string): string => unit.replace("µ", "u");

/** null: that of the file. */
export const UNIT = new Part<string | null>(
  "unit",
  "unit of lengths",
  null,
  (unit) => (unit === null ? "" : ascii(unit)),
  (text) => UNITS.find((unit) => ascii(unit) === text) ?? null,
);
