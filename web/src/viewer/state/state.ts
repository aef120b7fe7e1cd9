// The state of the viewer: a scene is a list of objects, each at its own isovalue. States are immutable.
import type { HasParts } from "./part";

/** the whole surface, or only the walls of cavities */
export type ShellFilter = "all" | "cavities";

export interface Shown {
  /** entry of the page; -1: the whole isosurface */
  entry: number;
  tau: number;
  /** 0 to 1 */
  opacity: number;
  visible: boolean;
  /** #rrggbb; null: the colour of its entry */
  colour: string | null;
  walls: ShellFilter;
}

export interface State extends HasParts {
  shown: Shown[];
  /** index in shown; -1: none */
  selected: number;
  /** position and target of the camera, six numbers; null: fit to view */
  view: number[] | null;
}

export const NOTHING: State = { shown: [], selected: -1, view: null, parts: {} };

export function shownAt(entry: number, tau: number): Shown {
  return { entry, tau, opacity: 1, visible: true, colour: null, walls: "all" };
}

export function isolate(state: State, entry: number, tau: number): State {
  const before = state.shown.find((shown) => shown.entry === entry);
  return { ...state, shown: [before ? { ...before, visible: true } : shownAt(entry, tau)], selected: 0 };
}

export function add(state: State, entry: number, tau: number): State {
  const at = state.shown.findIndex((shown) => shown.entry === entry);
  if (at >= 0) return { ...change(state, at, { visible: true }), selected: at };
  return { ...state, shown: [...state.shown, shownAt(entry, tau)], selected: state.shown.length };
}

export function remove(state: State, at: number): State {
  const shown = state.shown.filter((_, i) => i !== at);
  const selected = state.selected > at ? state.selected - 1 : state.selected;
  return { ...state, shown, selected: Math.min(selected, shown.length - 1) };
}

export function change(state: State, at: number, what: Partial<Shown>): State {
  return { ...state, shown: state.shown.map((shown, i) => (i === at ? { ...shown, ...what } : shown)) };
}

export function changeAll(state: State, what: Partial<Shown>): State {
  return { ...state, shown: state.shown.map((shown) => ({ ...shown, ...what })) };
}

export function select(state: State, at: number): State {
  return at === state.selected ? state : { ...state, selected: at };
}

/** The closest value above (up) or below an isovalue; null: none. */
export function nextEvent(values: readonly (number | null)[], tau: number, up: boolean): number | null {
  const beyond = values.filter((value): value is number => value !== null && (up ? value > tau : value < tau));
  if (beyond.length === 0) return null;
  return up ? Math.min(...beyond) : Math.max(...beyond);
}
