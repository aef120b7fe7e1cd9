// Filters and sorts the chosen objects. Numbers are those of entries (api/catalogue.ts).
import { cardsOf } from "../../shared/cards";
import { orders } from "../../shared/orders";
import { value } from "../../shared/format";
import { isCavity, numberOf, placeOf, reasonOf, referenceOf, voxelWord } from "../../shared/names";
import { branchOf, entryOf, type Page } from "../../shared/page";
import { EVERYTHING, titleOf } from "../api/entries";
import type { State } from "../state/state";

export interface SearchOptions {
  /** words, all of which must match */
  text: string;
  /** name in shared/orders.ts */
  order: string;
}

export interface SearchResult {
  objects: number[];
  /** those of the objects that have a card; all that a text finds, and all that are in the scene */
  cards: number[];
  /** of those with a card: the outline of the scanned field, apart from them */
  background: number[];
  cavities: number[];
  /** in the scene, but not among the chosen */
  others: number[];
  /** list the whole isosurface as well */
  everything: boolean;
}

export const NOTHING_FOUND: SearchResult = { objects: [], cards: [], background: [], cavities: [], others: [], everything: false };

/** chosen: objects, without cavities. */
export function find(page: Page, chosen: number[], shown: State["shown"], wanted: SearchOptions): SearchResult {
  const cavities = page.entries.map((_, i) => i).filter((i) => isCavity(page, i));
  const listed = new Set([...chosen, ...cavities, EVERYTHING]);
  const others = shown.map(({ entry }) => entry).filter((i) => !listed.has(i));
  const words = wanted.text.toLowerCase().split(/\s+/).filter((word) => word !== "");
  const isMatch = (i: number): boolean => words.every((word) => isAbout(page, i, word));
  const matching = (numbers: number[]): number[] => (words.length === 0 ? numbers : numbers.filter(isMatch));
  const sorted = (numbers: number[]): number[] => sortedBy(page, matching(numbers), wanted.order);
  const objects = sorted(chosen);
  const inScene = new Set(shown.map(({ entry }) => entry));
  const { cards, background } = cardsOf(page, objects, (i) => words.length > 0 || inScene.has(i));
  const everything = words.length === 0 || words.every((word) => titleOf(page, EVERYTHING).toLowerCase().includes(word));
  return { objects, cards, background, cavities: sorted(cavities), others: matching(others), everything };
}

/** All that is found, in the order of the list. */
export function allOf({ objects, others, cavities }: SearchResult): number[] {
  return [...objects, ...others, ...cavities];
}

/**
 * References as on the command line: 3, c3, low2, v218663, 2@1367. A number is that of the object or an isovalue; @1367 only an
 * isovalue. Other words are parts of the name, the reason or the place.
 */
function isAbout(page: Page, i: number, word: string): boolean {
  const reference = /^(?:low)?c?\d+$|^(?:low)?v\d+$/;
  const [before = "", tau] = word.split("@");
  if (tau !== undefined && (before === "" || reference.test(before))) return isReference(page, i, before) && isIsovalue(page, i, tau);
  if (reference.test(word) && isReference(page, i, word)) return true;
  if (isNumber(word)) return isIsovalue(page, i, word) || titleWords(page, i).includes(word);
  if (reference.test(word)) return false;
  return [titleOf(page, i), reasonOf(page, i), placeOf(page, i)].some((text) => text.toLowerCase().includes(word));
}

/** Numbers are parts of a name only as a whole: 1 is not in "Object 12". */
function titleWords(page: Page, i: number): string[] {
  return titleOf(page, i).toLowerCase().split(/\s+/);
}

function isReference(page: Page, i: number, word: string): boolean {
  if (word === "" || i === EVERYTHING) return word === "";
  return referenceOf(page, i) === word || voxelWord(entryOf(page, i).id) === word || (isNumber(word) && numberOf(page, i) === Number(word));
}

function isNumber(word: string): boolean {
  return /^[-−]?\d+(?:[.,]\d*)?$/.test(word);
}

/** Is it one of its isovalues, with as many digits as typed? Of small numbers all digits: 1 is not an isovalue of 1.4. */
function isIsovalue(page: Page, i: number, word: string): boolean {
  if (i === EVERYTHING || !isNumber(word)) return false;
  const typed = word.replace("−", "-").replace(",", ".");
  const digits = typed.split(".")[1]?.length ?? 0;
  const { tau, branch } = entryOf(page, i);
  const all = [tau, ...(branchOf(page, branch).isovalues ?? []).map((one) => one.tau)];
  const isRounded = digits > 0 || Math.abs(Number(typed)) >= ROUNDED;
  return all.some((one) => plain(value(one)) === typed || (isRounded && one.toFixed(digits) === Number(typed).toFixed(digits)));
}

/** from which on a number without decimals stands for all that round to it */
const ROUNDED = 100;

function plain(text: string): string {
  return text.replaceAll(",", "").replace("−", "-");
}

function sortedBy(page: Page, numbers: number[], order: string): number[] {
  const compare = orders.find(([name]) => name === order)?.[1];
  if (!compare || order === "rank") return numbers;
  return [...numbers].sort((p, q) => compare(page, entryOf(page, p), entryOf(page, q)));
}
