// Brings the picture to what the state says: surfaces are asked for, put on the stage and taken away.
import type { Desk } from "./desk";
import { flag } from "../state/part";
import { colourOfShown, whichOf } from "../ask/shown";
import type { Dress } from "../draw/stage";
import type { Shown, State } from "../state/state";
import { keyOf, Surfaces, type Arrival } from "../ask/surfaces";
import type { Mesh } from "../ask/wire";

/** Those that are not selected are pale, and a click goes through them. */
export const GHOSTS = flag("ghosts", "ghost the others");
const PALE = 0.12;

export class Scene {
  private readonly surfaces: Surfaces;
  private readonly listeners: ((entry: number) => void)[] = [];

  constructor(private readonly desk: Desk) {
    this.surfaces = new Surfaces(
      desk.api,
      (entry, mesh, tau) => this.put(entry, mesh, tau),
      (entry) => this.listeners.forEach((listener) => listener(entry)),
    );
  }

  /** Calls when something is asked for and when it has come. */
  onArrival(listener: (entry: number) => void): void {
    this.listeners.push(listener);
  }

  arrivalOf(entry: number): Arrival {
    return this.surfaces.arrivalOf(entry);
  }

  /** When all that is asked for is on the stage. */
  settled(): Promise<void> {
    return this.surfaces.settled();
  }

  /** dragging: only coarse surfaces, as more will come. */
  show(state: State, before: State, dragging: boolean): void {
    for (const { entry } of before.shown) if (!state.shown.some((shown) => shown.entry === entry)) this.forget(entry);
    state.shown.forEach((shown, i) => {
      this.desk.stage.dress(shown.entry, this.dressOf(state, i));
      if (shown.visible) this.want(shown, dragging);
    });
    this.fit();
  }

  private want({ entry, tau, walls }: Shown, dragging: boolean): void {
    this.surfaces.want(entry, { tau, walls, which: whichOf(this.desk.page, entry) }, dragging);
  }

  private forget(entry: number): void {
    this.surfaces.forget(entry);
    this.desk.stage.remove(entry);
  }

  /** As it is drawn: a ghost with its opacity. */
  drawnOf(state: State): Shown[] {
    return state.shown.map((shown, i) => ({ ...shown, opacity: this.dressOf(state, i).opacity }));
  }

  private dressOf(state: State, i: number): Dress {
    const shown = state.shown[i] as Shown;
    const pale = GHOSTS.of(state) && i !== state.selected;
    return {
      colour: colourOfShown(this.desk.page, shown),
      opacity: pale ? PALE * shown.opacity : shown.opacity,
      visible: shown.visible,
      solid: !pale,
    };
  }

  private put(entry: number, mesh: Mesh | null, tau: number): void {
    const { stage, history } = this.desk;
    const i = history.now.shown.findIndex((shown) => shown.entry === entry);
    if (!mesh || mesh.triangles === 0 || i < 0) stage.remove(entry);
    else stage.put(entry, mesh, this.dressOf(history.now, i), tau);
    this.fit();
  }

  /** Brings all that is asked for into the middle, once: when each has come, be it coarse. Then the state says where one looks from. */
  private fit(): void {
    const { history, stage } = this.desk;
    const { shown, view } = history.now;
    const isThere = (one: Shown): boolean => !one.visible || this.arrivalOf(one.entry).of === keyOf(one);
    if (view !== null || shown.length === 0 || !shown.every(isThere)) return;
    stage.fit();
    history.amend({ ...history.now, view: stage.eye.view });
  }
}
