// The layers of the opacity curve as the editor changes them, and what is selected in it; each change is one step of the history.
import { coalesce } from "../context/observe";
import type { ViewerContext } from "../context/viewer_context";
import {
  addPoint,
  extinctionOf,
  highestOpacity,
  movePoint,
  removePoint,
  scaledBy,
  type CurvePoint,
  type Layer,
} from "../state/opacity_curve";
import type { State } from "../state/state";
import { VOLUME_CURVE } from "../state/volume_state";

/** One step; a part of a drag, which finish() ends; one of several keys in quick succession. */
export type Change = "step" | "drag" | "keys";

export class OpacityModel {
  private layer = 0;
  private point = 0;
  private readonly listeners: (() => void)[] = [];

  private readonly goByKeys: (state: State) => void;

  constructor(private readonly context: ViewerContext) {
    this.goByKeys = coalesce(context.history);
  }

  /** Calls when another layer or point is selected. */
  onSelect(listener: () => void): void {
    this.listeners.push(listener);
  }

  /** Of the scene, or of the proposal; empty: not loaded. */
  get layers(): readonly Layer[] {
    return VOLUME_CURVE.of(this.context.history.now) ?? this.context.proposal.layers ?? [];
  }
  get isProposal(): boolean {
    return VOLUME_CURVE.of(this.context.history.now) === null;
  }

  /** Index of the selected layer. */
  get at(): number {
    return Math.min(this.layer, this.layers.length - 1);
  }
  get selected(): Layer | undefined {
    return this.layers[this.at];
  }
  /** Index of the selected point in its layer. */
  get pointAt(): number {
    return Math.min(this.point, (this.selected?.points.length ?? 1) - 1);
  }
  get selectedPoint(): CurvePoint | undefined {
    return this.selected?.points[this.pointAt];
  }

  select(layer: number, point = 0): void {
    if (layer === this.at && point === this.pointAt) return;
    [this.layer, this.point] = [layer, point];
    for (const listener of this.listeners) listener();
  }

  /** null: back to the proposal */
  put(layers: readonly Layer[] | null, change: Change = "step"): void {
    const { history } = this.context;
    const state = VOLUME_CURVE.with(history.now, layers);
    if (change === "keys") this.goByKeys(state);
    else history.go(state, change === "drag");
  }

  /** The end of a drag. */
  finish(): void {
    const { history } = this.context;
    history.go(history.now);
  }

  changeLayer(what: Partial<Layer>, change: Change = "step", at = this.at): void {
    this.put(
      this.layers.map((layer, i) => (i === at ? { ...layer, ...what } : layer)),
      change,
    );
  }

  /** Only the selected layer is visible; if that is so already, all are. */
  showOnly(): void {
    const isAlone = this.layers.every(({ visible }, i) => visible === (i === this.at));
    this.put(this.layers.map((layer, i) => ({ ...layer, visible: isAlone || i === this.at })));
  }

  /** Scales a layer so that its densest point has this opacity, above 0. */
  setOpacity(opacity: number, change: Change = "step"): void {
    const { points } = this.selected ?? { points: [] };
    const highest = points.length > 0 ? extinctionOf(highestOpacity(points)) : 0;
    if (highest > 0) this.changeLayer({ points: scaledBy(points, extinctionOf(opacity) / highest) }, change);
  }

  move(value: number, opacity: number, change: Change = "step"): void {
    const { low, high } = this.context.page.axis;
    const inside = Math.min(Math.max(value, low), high);
    if (this.selected) this.changeLayer({ points: movePoint(this.selected.points, this.pointAt, inside, opacity) }, change);
  }

  colour(colour: string, change: Change = "step"): void {
    const points = this.selected?.points.map((point, i) => (i === this.pointAt ? { ...point, colour } : point));
    if (points) this.changeLayer({ points }, change);
  }

  /** opacity: null: on the curve. False: there are too many. */
  add(value: number, opacity: number | null = null, change: Change = "step"): boolean {
    const added = this.selected && addPoint(this.selected.points, value, opacity);
    if (!added) return false;
    this.select(this.at, added.at);
    this.point = added.at; // the list has been shorter until now
    this.changeLayer({ points: added.points }, change);
    return true;
  }

  /** Between the selected point and the next one, or the one before. */
  addBeside(): boolean {
    const points = this.selected?.points ?? [];
    const [p, q] = [this.selectedPoint, points[this.pointAt + 1] ?? points[this.pointAt - 1]];
    return p !== undefined && q !== undefined && this.add((p.value + q.value) / 2);
  }

  /** False: only two are left. */
  remove(): boolean {
    if (!this.selected || this.selected.points.length <= 2) return false;
    const points = removePoint(this.selected.points, this.pointAt);
    this.point = Math.min(this.pointAt, points.length - 1);
    this.changeLayer({ points });
    return true;
  }
}
