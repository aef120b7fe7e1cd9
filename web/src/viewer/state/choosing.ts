// Which objects are listed, and how: parts of the state.
import { Part } from "./part";

export const TABS = ["cards", "list", "tree", "scatter"] as const;
export type TabName = (typeof TABS)[number];

/** At least, at most; null: no limit. */
export type Limits = readonly [number | null, number | null];

/** What is asked for must all hold, as for `isoatlas objects`. */
export interface Choice {
  /** only those that noise does not explain and that are not tiny */
  standsOut: boolean;
  /** so many by rank; null: any */
  keep: number | null;
  /** how far it rises above where it merges, in units of the values */
  contrast: Limits;
  /** just before it merges: physical volume, or voxels where the file has no unit */
  size: Limits;
}

export const ANY: Choice = { standsOut: false, keep: null, contrast: [null, null], size: [null, null] };

/** Sizes of one object. */
export interface Sizes {
  rank: number;
  contrast: number;
  size: number;
  standsOut: boolean;
}

/** The largest object, of rank 0, is kept by every choice that has no upper limit: as on the command line. */
export function isChosen(choice: Choice, { rank, contrast, size, standsOut }: Sizes): boolean {
  if (rank === 0 && choice.contrast[1] === null && choice.size[1] === null) return true;
  if ((choice.standsOut && !standsOut) || (choice.keep !== null && rank >= choice.keep)) return false;
  return isIn(choice.contrast, contrast) && isIn(choice.size, size);
}

function isIn([least, most]: Limits, number: number): boolean {
  return (least === null || number >= least) && (most === null || number <= most);
}

export interface Command {
  line: string;
  /** does it list the same objects? */
  same: boolean;
}

/** The lower limits, as `isoatlas objects` and /api/branches call them. hasUnit: are sizes physical? */
export function selectionWords({ keep, contrast, size }: Choice, hasUnit: boolean): [string, number][] {
  const words: [string, number | null][] = [["keep", keep], ["persistence", contrast[0]], [hasUnit ? "min-volume" : "min-voxels", size[0]]];
  return words.filter((word): word is [string, number] => word[1] !== null);
}

/** Does /api/branches know it too? */
export function isSelection(choice: Choice): boolean {
  return !choice.standsOut && choice.contrast[1] === null && choice.size[1] === null;
}

/** source: the store, as a word of a command line; standingOut: how many objects do. */
export function commandOf(choice: Choice | null, source: string, standingOut: number, hasUnit: boolean): Command {
  const line = `isoatlas objects ${source}`;
  if (choice === null) return { line, same: true };
  const words = selectionWords(choice, hasUnit).map(([name, number]) => ` --${name} ${number}`);
  if (words.length > 0) return { line: line + words.join(""), same: isSelection(choice) };
  const bounded = choice.contrast[1] !== null || choice.size[1] !== null;
  return { line: choice.standsOut ? `${line} --top ${LINES_AN_OBJECT * standingOut}` : `${line} --all`, same: !bounded };
}

/** an object has at most so many isovalues with a line of their own */
const LINES_AN_OBJECT = 4;

function wordOf(choice: Choice | null): string {
  if (choice === null) return "";
  const numbers = [choice.keep, ...choice.contrast, ...choice.size].map((number) => (number === null ? "" : String(number)));
  return `${choice.standsOut ? "out" : ""},${numbers.join(",")}`;
}

function choiceOf(word: string): Choice | null {
  const parts = word.split(",");
  if (parts.length !== 6 || (parts[0] !== "" && parts[0] !== "out")) return null;
  const numbers = parts.slice(1).map((part) => (part === "" ? null : Number(part)));
  if (numbers.some((number) => number !== null && !(Number.isFinite(number) && number >= 0))) return null;
  const [keep, ...limits] = numbers as [number | null, number | null, number | null, number | null, number | null];
  if (keep !== null && !(Number.isInteger(keep) && keep > 0)) return null;
  return { standsOut: parts[0] === "out", keep, contrast: [limits[0], limits[1]], size: [limits[2], limits[3]] };
}

/** Which objects are listed; null: those of the page, chosen automatically. */
export const CHOICE = new Part<Choice | null>("choice", "choice of what is listed", null, wordOf, choiceOf);

/** How they are listed: no step of its own, see History.everywhere(). */
export const TAB = new Part<TabName>("tab", "how objects are listed", "cards", String, tabOf);

function tabOf(word: string): TabName | null {
  return TABS.find((name) => name === word) ?? null;
}
