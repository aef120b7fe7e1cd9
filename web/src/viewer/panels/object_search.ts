// Filters and sorts the chosen objects. Numbers are those of entries (api/catalogue.ts).
import { cardsOf } from "../../shared/cards";
import { orders } from "../../shared/orders";
import { isCavity, numberOf, placeOf, reasonOf, referenceOf, voxelWord } from "../../shared/names";
import { entryOf, type Page } from "../../shared/page";
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
}

export const NOTHING_FOUND: SearchResult = { objects: [], cards: [], background: [], cavities: [], others: [] };

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
  return { objects, cards, background, cavities: sorted(cavities), others: matching(others) };
}

/** A number matches that of the object, v and a number its voxel, as on the command line; other words match as substrings. */
function isAbout(page: Page, i: number, word: string): boolean {
  const texts = [titleOf(page, i), reasonOf(page, i), placeOf(page, i)].map((text) => text.toLowerCase());
  if (/^\d+$/.test(word)) return i !== EVERYTHING && numberOf(page, i) === Number(word);
  if (/^low\d+$/.test(word)) return i !== EVERYTHING && referenceOf(page, i) === word;
  if (/^v\d+$/.test(word)) return i !== EVERYTHING && voxelWord(entryOf(page, i).id) === word;
  return texts.some((text) => text.includes(word));
}

function sortedBy(page: Page, numbers: number[], order: string): number[] {
  const compare = orders.find(([name]) => name === order)?.[1];
  if (!compare || order === "rank") return numbers;
  return [...numbers].sort((p, q) => compare(page, entryOf(page, p), entryOf(page, q)));
}
