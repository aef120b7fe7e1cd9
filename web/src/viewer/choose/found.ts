// What is listed of what is chosen: searched and sorted. Numbers are those of entries (catalogue.ts).
import { orders } from "../../choice";
import { isDark, placeOf, reasonOf } from "../../names";
import { entryOf, type Page } from "../../page";
import { EVERYTHING, titleOf } from "../ask/shown";
import type { State } from "../state/state";

export interface Wanted {
  /** words, all of which must be found */
  text: string;
  /** of choice.ts: orders */
  order: string;
}

export interface Found {
  bright: number[];
  dark: number[];
  /** in the scene, but not among the chosen */
  also: number[];
}

/** chosen: bright ones. */
export function find(page: Page, chosen: number[], shown: State["shown"], wanted: Wanted): Found {
  const dark = page.entries.map((_, i) => i).filter((i) => isDark(page, i));
  const listed = new Set([...chosen, ...dark, EVERYTHING]);
  const also = shown.map(({ entry }) => entry).filter((i) => !listed.has(i));
  const words = wanted.text.toLowerCase().split(/\s+/).filter((word) => word !== "");
  const isMatch = (i: number): boolean => words.every((word) => isAbout(page, i, word));
  const matching = (numbers: number[]): number[] => (words.length === 0 ? numbers : numbers.filter(isMatch));
  const sorted = (numbers: number[]): number[] => sortedBy(page, matching(numbers), wanted.order);
  return { bright: sorted(chosen), dark: sorted(dark), also: matching(also) };
}

/** A number finds the objects that have it in their title or are called so on the command line; a word, what contains it. */
function isAbout(page: Page, i: number, word: string): boolean {
  const texts = [titleOf(page, i), reasonOf(page, i), placeOf(page, i)].map((text) => text.toLowerCase());
  if (/^\d+$/.test(word)) return texts[0]?.split(" ").includes(word) === true || entryOf(page, i).id === Number(word);
  return texts.some((text) => text.includes(word));
}

function sortedBy(page: Page, numbers: number[], order: string): number[] {
  const compare = orders.find(([name]) => name === order)?.[1];
  if (!compare || order === "rank") return numbers;
  return [...numbers].sort((p, q) => compare(page, entryOf(page, p), entryOf(page, q)));
}
