// What is to be seen: a scene is a list of objects, each at its own isovalue. A state never changes; a change is another state.
export interface Shown {
  /** which entry of the atlas; -1: all there is at the isovalue */
  entry: number;
  tau: number;
  /** 0 to 1 */
  opacity: number;
  visible: boolean;
}

export interface State {
  shown: Shown[];
  /** which of them; -1: none */
  selected: number;
  /** where the camera stands and what it looks at, six numbers; null: all that is shown in the middle */
  view: number[] | null;
}

export const NOTHING: State = { shown: [], selected: -1, view: null };

export function isolate(state: State, entry: number, tau: number): State {
  const before = state.shown.find((shown) => shown.entry === entry);
  return { ...state, shown: [before ? { ...before, visible: true } : { entry, tau, opacity: 1, visible: true }], selected: 0 };
}

export function add(state: State, entry: number, tau: number): State {
  const at = state.shown.findIndex((shown) => shown.entry === entry);
  if (at >= 0) return { ...state, selected: at };
  return { ...state, shown: [...state.shown, { entry, tau, opacity: 1, visible: true }], selected: state.shown.length };
}

export function remove(state: State, at: number): State {
  const shown = state.shown.filter((_, i) => i !== at);
  return { ...state, shown, selected: Math.min(state.selected, shown.length - 1) };
}

export function change(state: State, at: number, what: Partial<Shown>): State {
  return { ...state, shown: state.shown.map((shown, i) => (i === at ? { ...shown, ...what } : shown)) };
}

/** The events of the objects that matter, next to an isovalue: the closest value above (up) or below it at which one begins or ends. */
export function nextEvent(values: readonly (number | null)[], tau: number, up: boolean): number | null {
  const beyond = values.filter((value): value is number => value !== null && (up ? value > tau : value < tau));
  if (beyond.length === 0) return null;
  return up ? Math.min(...beyond) : Math.max(...beyond);
}

/** All states so far, and where among them one is. */
export class History {
  private states: State[];
  private at = 0;
  private readonly listeners: ((state: State, before: State) => void)[] = [];

  constructor(first: State) {
    this.states = [first];
  }

  get now(): State {
    return this.states[this.at] ?? NOTHING;
  }

  /** transient: what follows replaces this state, as while something is dragged. */
  go(state: State, transient = false): void {
    const before = this.now;
    if (transient && this.transient) this.states[this.at] = state;
    else {
      this.states = [...this.states.slice(0, this.at + 1), state];
      this.at = this.states.length - 1;
    }
    this.transient = transient;
    this.tell(before);
  }

  undo(): boolean {
    return this.move(-1);
  }

  redo(): boolean {
    return this.move(1);
  }

  listen(listener: (state: State, before: State) => void): void {
    this.listeners.push(listener);
  }

  private transient = false;

  private move(by: number): boolean {
    const to = this.at + by;
    if (to < 0 || to >= this.states.length) return false;
    const before = this.now;
    this.at = to;
    this.transient = false;
    this.tell(before);
    return true;
  }

  private tell(before: State): void {
    for (const listener of this.listeners) listener(this.now, before);
  }
}

/** The state as the part of an address behind '#'. */
export function toHash(state: State): string {
  const parts = state.shown.map((s) => [s.entry, s.tau, s.opacity, s.visible ? 1 : 0].join(","));
  const view = state.view ? `&view=${state.view.map((n) => Number(n.toPrecision(6))).join(",")}` : "";
  return `#scene=${parts.join(";")}&selected=${state.selected}${view}`;
}

/** entries: how many there are. null: that is none of ours. */
export function fromHash(hash: string, entries: number): State | null {
  const words = new URLSearchParams(hash.replace(/^#/, ""));
  const scene = words.get("scene");
  if (scene === null) return null;
  const shown: Shown[] = [];
  for (const part of scene.split(";").filter((text) => text !== "")) {
    const numbers = part.split(",").map(Number);
    const [entry, tau, opacity, visible] = numbers;
    if (numbers.length !== 4 || entry === undefined || tau === undefined || opacity === undefined || numbers.some((n) => !Number.isFinite(n))) return null;
    if (!Number.isInteger(entry) || entry < -1 || entry >= entries || opacity < 0 || opacity > 1) return null;
    shown.push({ entry, tau, opacity, visible: visible === 1 });
  }
  const selected = Number(words.get("selected") ?? -1);
  const view = (words.get("view") ?? "").split(",").map(Number);
  return {
    shown,
    selected: Number.isInteger(selected) && selected < shown.length ? selected : shown.length - 1,
    view: view.length === 6 && view.every(Number.isFinite) ? view : null,
  };
}
