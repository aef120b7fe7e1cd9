// How many objects and cavities the page leaves out, and why.
import { count, plural } from "./format";
import type { Page } from "./page";

/** Sentences: how many objects and cavities there are, are shown, and are hidden, and why. */
export function hiddenSentences(page: Page): string[] {
  if (page.polarity === "both") return sentencesOfBoth(page);
  const sentences: string[] = [];
  for (const side of ["object", "cavity"] as const) {
    const { all, significant } = side === "object" ? page.found.objects : page.found.cavities;
    const shown = new Set(page.entries.filter((e) => page.branches[e.branch]?.side === side).map((e) => e.branch)).size;
    const name = side === "object" ? plural(all, "object") : plural(all, "cavity", "cavities");
    if (all === 0) continue;
    const more = significant - shown;
    const later = more > 0 ? ` ${count(more)} more ${more === 1 ? "is" : "are"} significant.` : "";
    const rest = all - Math.max(significant, shown);
    const hidden = rest > 0 ? ` ${count(rest)} not shown: below noise level or very small.` : "";
    sentences.push(`${name} in all, ${count(shown)} shown.${later}${hidden}`);
  }
  return sentences;
}

/** For objects of high and of low values each. */
function sentencesOfBoth(page: Page): string[] {
  const sides = [["high", page.found.objects], ["low", page.low?.found]] as const;
  return sides.flatMap(([polarity, found]) => {
    if (!found || found.all === 0) return [];
    const shown = new Set(page.entries.filter((e) => page.branches[e.branch]?.polarity === polarity).map((e) => e.branch)).size;
    const rest = found.all - Math.max(found.significant, shown);
    const more = found.significant - shown;
    const later = more > 0 ? ` ${count(more)} more ${more === 1 ? "is" : "are"} significant.` : "";
    const hidden = rest > 0 ? ` ${count(rest)} not shown: below noise level or very small.` : "";
    return [`${plural(found.all, "object")} of ${polarity} values in all, ${count(shown)} shown.${later}${hidden}`];
  });
}
