// Cards: one for each object. An isovalue at which an object looks much as at another one of its table is on the card of that one.
import { entriesOf, furtherIsovalues } from "./names";
import { entryOf, hasCard, type Page } from "./page";

/** The entry whose card shows an entry: itself, where it has another shape than those before it. */
export function cardOf(page: Page, i: number): number {
  const { branch, card } = entryOf(page, i);
  const own = hasCard(entryOf(page, i)) ? i : page.entries.findIndex((other) => other.branch === branch && other.number === card);
  return own < 0 ? i : own;
}

/** The outline of the scanned field: more than two thirds of the volume. */
export function isBackground(page: Page, i: number): boolean {
  return entryOf(page, i).background === true;
}

/** Another isovalue on the card of an entry. */
export interface AlsoAt {
  tau: number;
  why: string;
  /** where it has a number of its own */
  entry?: number;
}

/** Other isovalues on its card, ascending: lines of the table that look the same, and further recommended ones. */
export function alsoAt(page: Page, i: number): AlsoAt[] {
  const alike = entriesOf(page, entryOf(page, i).branch).filter((k) => k !== i && cardOf(page, k) === i);
  const lines = alike.map((k): AlsoAt => ({ tau: entryOf(page, k).tau, why: overlapWords(page, k), entry: k }));
  return [...lines, ...furtherIsovalues(page, i).map(({ tau, why }): AlsoAt => ({ tau, why }))].sort((p, q) => p.tau - q.tau);
}

/** How much an entry has in common with that of its card. */
export function overlapWords(page: Page, i: number): string {
  return `${Math.round(100 * (entryOf(page, i).overlap ?? 1))} % of the voxels are the same`;
}

/** What to show of some entries, in their order. */
export interface Cards {
  cards: number[];
  background: number[];
}

/** all: entries that have a card in any case, and not among the background. */
export function cardsOf(page: Page, entries: number[], all: (i: number) => boolean = () => false): Cards {
  const listed = new Set(entries);
  const own = entries.filter((i) => all(i) || cardOf(page, i) === i || !listed.has(cardOf(page, i)));
  const background = own.filter((i) => !all(i) && isBackground(page, i));
  const rest = new Set(background);
  return { cards: own.filter((i) => !rest.has(i)), background };
}

/** The first entry that shows more than the scanned field, if there is one. */
export function firstToShow(page: Page): number {
  return Math.max(0, page.entries.findIndex((entry) => entry.background !== true));
}
