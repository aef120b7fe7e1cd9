// What lies inside an object is seen through it: the outer one turns transparent when the inner one is added.
import type { Page } from "../../shared/page";
import { entryOf } from "../../shared/page";
import type { Shown, State } from "./state";

/** Opacity of an object with another one inside. */
export const SEE_THROUGH = 0.35;

/** Does one entry lie inside another one, at their best isovalues? The whole isosurface (-1) is around everything. */
export function liesInside(page: Page, inner: number, outer: number): boolean {
  if (inner === outer || inner < 0) return false;
  if (outer < 0) return true;
  for (let at = inner, left = page.entries.length + 1; at >= 0 && left > 0; --left) {
    const { inside, around } = entryOf(page, at);
    at = inside >= 0 ? inside : around;
    if (at === outer) return true;
  }
  return false;
}

function changed(state: State, opacityOf: (shown: Shown) => number): State {
  return { ...state, shown: state.shown.map((shown) => ({ ...shown, opacity: opacityOf(shown) })) };
}

/** After adding an entry: what is opaque and around it, or is it itself and around others, turns transparent. */
export function seenThrough(page: Page, state: State, added: number): State {
  const holds = (outer: number): boolean =>
    outer === added
      ? state.shown.some(({ entry, visible }) => visible && liesInside(page, entry, added))
      : liesInside(page, added, outer);
  return changed(state, ({ entry, opacity }) => (opacity === 1 && holds(entry) ? SEE_THROUGH : opacity));
}

/** After removing an entry: what was transparent for its sake alone is opaque again. */
export function closedAgain(page: Page, state: State, removed: number): State {
  const holdsOthers = (outer: number): boolean =>
    state.shown.some(({ entry, visible }) => visible && liesInside(page, entry, outer));
  return changed(state, ({ entry, opacity }) =>
    opacity === SEE_THROUGH && liesInside(page, removed, entry) && !holdsOthers(entry) ? 1 : opacity,
  );
}
