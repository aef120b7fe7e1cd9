// Where the objects that matter begin, and where they end in another one: what happens at an isovalue, in words.
import { value } from "../../format";
import { branchName, entriesOf } from "../../names";
import { branchOf, type Page } from "../../page";

export interface Event {
  tau: number;
  text: string;
}

/** From the lowest on; all that happens at one isovalue is one event. */
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
  if (into) return `joins ${into}`;
  return side === "dark" ? "opens to the outside or joins another dark object" : "joins a larger object";
}

/** The event at an isovalue that is nearest to it in a drawing; null: none within `reach` of it. */
export function eventNear(events: readonly Event[], x: (tau: number) => number, at: number, reach: number): Event | null {
  const away = (event: Event): number => Math.abs(x(event.tau) - at);
  const [nearest] = [...events].sort((p, q) => away(p) - away(q));
  return nearest && away(nearest) <= reach ? nearest : null;
}
