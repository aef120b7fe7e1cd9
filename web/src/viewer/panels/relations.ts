// What an object has to do with others: inside, contains, merges, merged objects, the same object at other isovalues.
import { value } from "../../shared/format";
import { contentsOf, entriesOf, inOrderOfMerges } from "../../shared/names";
import { branchOf, entryOf, type Page } from "../../shared/page";
import { branchOfShown } from "../api/entries";
import type { Catalogue } from "../api/catalogue";

export interface Relation {
  /** such as "inside" */
  kind: string;
  /** undefined: an object that is not listed */
  entry: number | undefined;
  /** after the name of the other object; may be empty */
  words: string;
}

export function relationsOf(page: Page, catalogue: Pick<Catalogue, "numberOfBranch">, i: number): Relation[] {
  const entry = entryOf(page, i);
  const { parent, merges } = branchOf(page, entry.branch);
  const all: Relation[] = [];
  if (entry.inside >= 0) all.push({ kind: "inside", entry: entry.inside, words: "" });
  if (entry.around >= 0) all.push({ kind: "a cavity of", entry: entry.around, words: "" });
  if (merges !== null) all.push({ kind: "merges into", entry: catalogue.numberOfBranch(parent), words: ` at ${value(merges)}` });
  for (const k of contentsOf(page, i)) all.push({ kind: "contains", entry: k, words: "" });
  for (const k of mergedInto(page, entry.branch))
    all.push({ kind: "merged object", entry: k, words: ` at ${value(branchOfShown(page, k)?.merges ?? 0)}` });
  for (const k of entriesOf(page, entry.branch))
    if (k !== i) all.push({ kind: "same object", entry: k, words: ` at ${value(entryOf(page, k).tau)}` });
  return all;
}

/** The first ones of each kind in turn, so that one long kind does not hide the others; in the order of the list. */
export function firstRelations(all: Relation[], limit: number): Relation[] {
  const seen = new Map<string, number>();
  const turn = all.map((relation, at) => {
    const round = seen.get(relation.kind) ?? 0;
    seen.set(relation.kind, round + 1);
    return { relation, round, at };
  });
  const chosen = turn.sort((p, q) => p.round - q.round || p.at - q.at).slice(0, limit);
  return chosen.sort((p, q) => p.at - q.at).map(({ relation }) => relation);
}

/** One entry for each branch that merges into this one. */
function mergedInto(page: Page, branch: number): number[] {
  const arriving = page.branches
    .flatMap((other, b) => (other.parent === branch ? [b] : []))
    .filter((b) => entriesOf(page, b).length > 0);
  return inOrderOfMerges(page, arriving).flatMap((b) => entriesOf(page, b).slice(0, 1));
}
