// Synchronizes the viewport with the state: loads surfaces, shows and removes them.
import type { Api } from "../api/api";
import { GHOSTS } from "../state/ghosts";
import { POINTS } from "../state/points";
import { colourOfShown, targetOf } from "../api/entries";
import type { Appearance, Viewport } from "./viewport";
import type { Shown, State } from "../state/state";
import { keyOf, Surfaces, type LoadState } from "../api/surfaces";
import type { Mesh } from "../../shared/wire";
import type { History } from "../state/history";
import type { Page } from "../../shared/page";

const PALE = 0.12;

/** The parts of ViewerContext that a scene uses. */
export interface SceneContext {
  readonly page: Page;
  readonly api: Api;
  readonly viewport: Viewport;
  readonly history: History;
}

export class Scene {
  private readonly surfaces: Surfaces;
  private readonly listeners: ((entry: number) => void)[] = [];

  constructor(private readonly context: SceneContext) {
    this.surfaces = new Surfaces(
      context.api,
      (entry, mesh, tau) => this.onMesh(entry, mesh, tau),
      (entry) => this.listeners.forEach((listener) => listener(entry)),
      () => context.viewport.eye,
      () => context.viewport.frameTime,
    );
  }

  /** Calls when the load state of an object changes. */
  onLoadState(listener: (entry: number) => void): void {
    this.listeners.push(listener);
  }

  loadStateOf(entry: number): LoadState {
    return this.surfaces.loadStateOf(entry);
  }

  /** Resolves when all requested surfaces are loaded. */
  settled(): Promise<void> {
    return this.surfaces.settled();
  }

  /** dragging: only coarse surfaces. */
  show(state: State, before: State, dragging: boolean): void {
    this.surfaces.drawAsPoints(POINTS.of(state));
    for (const { entry } of before.shown) if (!state.shown.some((shown) => shown.entry === entry)) this.remove(entry);
    state.shown.forEach((shown, i) => {
      this.context.viewport.applyAppearance(shown.entry, this.appearanceOf(state, i));
      if (shown.visible) this.request(shown, dragging);
    });
    this.fit();
  }

  private request({ entry, tau, walls }: Shown, dragging: boolean): void {
    this.surfaces.request(entry, { tau, walls, target: targetOf(this.context.page, entry) }, dragging);
  }

  private remove(entry: number): void {
    this.surfaces.remove(entry);
    this.context.viewport.remove(entry);
  }

  /** Objects as drawn: with the opacity of ghosts. */
  drawnOf(state: State): Shown[] {
    return state.shown.map((shown, i) => ({ ...shown, opacity: this.appearanceOf(state, i).opacity }));
  }

  private appearanceOf(state: State, i: number): Appearance {
    const shown = state.shown[i] as Shown;
    const pale = GHOSTS.of(state) && i !== state.selected;
    return {
      colour: colourOfShown(this.context.page, shown),
      opacity: pale ? PALE * shown.opacity : shown.opacity,
      visible: shown.visible,
      pickable: !pale,
    };
  }

  private onMesh(entry: number, mesh: Mesh | null, tau: number): void {
    const { viewport, history } = this.context;
    const i = history.now.shown.findIndex((shown) => shown.entry === entry);
    if (!mesh || mesh.positions.length === 0 || i < 0) viewport.remove(entry);
    else viewport.put(entry, mesh, this.appearanceOf(history.now, i), tau);
    this.fit();
  }

  /** Fits the view once all objects have a surface, coarse or full, if the state has no view; then stores the view. */
  private fit(): void {
    const { history, viewport } = this.context;
    const { shown, view } = history.now;
    const isLoaded = (one: Shown): boolean => !one.visible || this.loadStateOf(one.entry).key === keyOf(one);
    if (view !== null || shown.length === 0 || !shown.every(isLoaded)) return;
    viewport.fit();
    history.amend({ ...history.now, view: viewport.rig.view });
  }
}
