// Which objects are listed, and how: parts of the state.
import { Part } from "./part";

export const TABS = ["cards", "list", "tree", "scatter"] as const;
export type TabName = (typeof TABS)[number];

/** At least, at most; null: no limit. */
export type Limits = readonly [number | null, number | null];

/** All conditions must hold, as in `isoatlas objects`. */
export interface Choice {
  /** only those above the noise level that are not very small */
  significant: boolean;
  /** number of objects, by rank; null: all */
  keep: number | null;
  /** persistence: difference of values between appearance and merge */
  contrast: Limits;
  /** just before it merges: physical volume, or voxels where the file has no unit */
  size: Limits;
}

export const ANY: Choice = { significant: false, keep: null, contrast: [null, null], size: [null, null] };

/** Measures of one object. */
export interface Sizes {
  rank: number;
  contrast: number;
  size: number;
  significant: boolean;
}

/** The largest object, of rank 0, is kept by every choice without an upper limit: as on the command line. */
export function isChosen(choice: Choice, { rank, contrast, size, significant }: Sizes): boolean {
  if (rank === 0 && choice.contrast[1] === null && choice.size[1] === null) return true;
  if ((choice.significant && !significant) || (choice.keep !== null && rank >= choice.keep)) return false;
  return isIn(choice.contrast, contrast) && isIn(choice.size, size);
}

function isIn([min, max]: Limits, number: number): boolean {
  return (min === null || number >= min) && (max === null || number <= max);
}

export interface Command {
  line: string;
  /** is the list the same? */
  same: boolean;
}

/** The lower limits as options of `isoatlas objects` and /api/branches. hasUnit: sizes are physical. */
export function selectionOptions({ keep, contrast, size }: Choice, hasUnit: boolean): [string, number][] {
  const words: [string, number | null][] = [["keep", keep], ["persistence", contrast[0]], [hasUnit ? "min-volume" : "min-voxels", size[0]]];
  return words.filter((word): word is [string, number] => word[1] !== null);
}

/** Does /api/branches have equivalent parameters? */
export function isSelection(choice: Choice): boolean {
  return !choice.significant && choice.contrast[1] === null && choice.size[1] === null;
}

/** source: the store, as an argument of a command line; significant: number of significant objects. */
export function commandOf(choice: Choice | null, source: string, significant: number, hasUnit: boolean): Command {
  const line = `isoatlas objects ${source}`;
  if (choice === null) return { line, same: true };
  const words = selectionOptions(choice, hasUnit).map(([name, number]) => ` --${name} ${number}`);
  if (words.length > 0) return { line: line + words.join(""), same: isSelection(choice) };
  const bounded = choice.contrast[1] !== null || choice.size[1] !== null;
  return { line: choice.significant ? `${line} --top ${LINES_AN_OBJECT * significant}` : `${line} --all`, same: !bounded };
}

/** maximal number of recommended isovalues of an object */
const LINES_AN_OBJECT = 4;

function wordOf(choice: Choice | null): string {
  if (choice === null) return "";
  const numbers = [choice.keep, ...choice.contrast, ...choice.size].map((number) => (number === null ? "" : String(number)));
  return `${choice.significant ? "out" : ""},${numbers.join(",")}`;
}

function choiceOf(word: string): Choice | null {
  const parts = word.split(",");
  if (parts.length !== 6 || (parts[0] !== "" && parts[0] !== "out")) return null;
  const numbers = parts.slice(1).map((part) => (part === "" ? null : Number(part)));
  if (numbers.some((number) => number !== null && !(Number.isFinite(number) && number >= 0))) return null;
  const [keep, ...limits] = numbers as [number | null, number | null, number | null, number | null, number | null];
  if (keep !== null && !(Number.isInteger(keep) && keep > 0)) return null;
  return { significant: parts[0] === "out", keep, contrast: [limits[0], limits[1]], size: [limits[2], limits[3]] };
}

/** Which objects are listed; null: the automatic choice of the page. */
export const CHOICE = new Part<Choice | null>("choice", "filter", null, wordOf, choiceOf);

/** How they are listed; not an undo step, see History.changeAll(). */
export const TAB = new Part<TabName>("tab", "tab", "cards", String, tabOf);

function tabOf(word: string): TabName | null {
  return TABS.find((name) => name === word) ?? null;
}
