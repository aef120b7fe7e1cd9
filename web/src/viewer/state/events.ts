// Events of the significant objects: appearances and merges, with their text.
import { value } from "../../shared/format";
import { branchName, entriesOf } from "../../shared/names";
import { branchOf, type Page } from "../../shared/page";

export interface Event {
  tau: number;
  text: string;
}

/** Ascending; several events at one isovalue are joined. */
export function eventsOf(page: Page): Event[] {
  const texts = new Map<number, string[]>();
  const happens = (tau: number, text: string): void => void texts.set(tau, [...(texts.get(tau) ?? []), `${text} at ${value(tau)}`]);
  page.branches.forEach((branch, b) => {
    if (entriesOf(page, b).length === 0) return;
    happens(branch.appears, `${branchName(page, b)} appears`);
    if (branch.merges !== null) happens(branch.merges, `${branchName(page, b)} ${endOf(page, b)}`);
  });
  return [...texts].map(([tau, all]) => ({ tau, text: all.join("; ") })).sort((p, q) => p.tau - q.tau);
}

function endOf(page: Page, b: number): string {
  const { parent, side } = branchOf(page, b);
  const into = parent >= 0 && entriesOf(page, parent).length > 0 ? branchName(page, parent).toLowerCase() : "";
  if (into) return `merges into ${into}`;
  return side === "cavity" ? "opens to the outside or merges into another cavity" : "merges into a larger object";
}

/** The event nearest to an isovalue in a drawing; null: none within `reach`. */
export function eventNear(events: readonly Event[], x: (tau: number) => number, at: number, maxDistance: number): Event | null {
  const away = (event: Event): number => Math.abs(x(event.tau) - at);
  const [nearest] = [...events].sort((p, q) => away(p) - away(q));
  return nearest && away(nearest) <= maxDistance ? nearest : null;
}
