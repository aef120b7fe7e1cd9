// Undo history: a list of states, the current one, and a name for each change.
import { partNamed } from "./part";
import { NOTHING, type Shown, type State } from "./state";

type Listener = (state: State, before: State, dragging: boolean) => void;

export class History {
  private states: State[];
  private at = 0;
  private dragging = "";
  private readonly listeners: Listener[] = [];

  constructor(first: State) {
    this.states = [first];
  }

  get now(): State {
    return this.states[this.at] ?? NOTHING;
  }

  /** Names of the changes that undo and redo revert and repeat; empty: none. */
  get undoes(): string {
    return this.at > 0 ? nameOfChange(this.states[this.at - 1] as State, this.now) : "";
  }
  get redoes(): string {
    return this.at + 1 < this.states.length ? nameOfChange(this.now, this.states[this.at + 1] as State) : "";
  }

  /** transient: during a drag; all changes of one drag and its final state are one step. */
  go(state: State, transient = false): void {
    const before = this.now;
    const name = nameOfChange(before, state);
    if (name === "" && !this.dragging) return;
    if (name === "" || name === this.dragging) this.states[this.at] = state;
    else this.states = [...this.states.slice(0, this.at + 1), state];
    this.at = this.states.length - 1;
    this.dragging = transient ? name || this.dragging : "";
    this.notify(before, transient);
  }

  /** Replaces the current state without a new step. */
  amend(state: State): void {
    const before = this.now;
    this.states[this.at] = state;
    this.notify(before, false);
  }

  /** Applies a change to all states: it cannot be undone. */
  changeAll(change: (state: State) => State): void {
    const before = this.now;
    this.states = this.states.map(change);
    this.notify(before, false);
  }

  undo(): boolean {
    return this.move(-1);
  }

  redo(): boolean {
    return this.move(1);
  }

  listen(listener: Listener): void {
    this.listeners.push(listener);
  }

  private move(by: number): boolean {
    const to = this.at + by;
    if (to < 0 || to >= this.states.length) return false;
    const before = this.now;
    this.at = to;
    this.dragging = "";
    this.notify(before, false);
    return true;
  }

  private notify(before: State, dragging: boolean): void {
    for (const listener of this.listeners) listener(this.now, before, dragging);
  }
}

const WORDS: Partial<Record<keyof Shown, string>> = {
  tau: "isovalue",
  opacity: "opacity",
  colour: "colour",
  visible: "show or hide",
  walls: "cavities only",
};

/** Empty: no visible change. */
export function nameOfChange(before: State, after: State): string {
  if (before.shown.length !== after.shown.length || before.shown.some((shown, i) => shown.entry !== after.shown[i]?.entry))
    return listChange(before, after);
  for (const [key, word] of Object.entries(WORDS) as [keyof Shown, string][]) {
    const changed = before.shown.filter((shown, i) => shown[key] !== after.shown[i]?.[key]).length;
    if (changed > 0) return changed === 1 || before.shown.length === 1 ? word : `${word} of all`;
  }
  const keys = new Set([...Object.keys(before.parts), ...Object.keys(after.parts)]);
  for (const key of keys) if (before.parts[key] !== after.parts[key]) return partNamed(key)?.title ?? key;
  if (before.selected !== after.selected) return "selection";
  return String(before.view) === String(after.view) ? "" : "view";
}

function listChange(before: State, after: State): string {
  const added = after.shown.filter(({ entry }) => !before.shown.some((shown) => shown.entry === entry)).length;
  const removed = before.shown.filter(({ entry }) => !after.shown.some((shown) => shown.entry === entry)).length;
  if (added > 0) return removed > 0 ? "change scene" : "add to scene";
  return removed === 1 ? "remove from scene" : "isolate";
}
