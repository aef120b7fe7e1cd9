// Three slices through the crosshair, with the contours of all visible surfaces.
import { html } from "../../shared/dom";
import { value } from "../../shared/format";
import { onClick, placeOn } from "../context/clicks";
import { Contours } from "../scene/contours";
import type { ViewerContext } from "../context/viewer_context";
import { observePart, coalesce, toggleAction } from "../context/observe";
import { AXES, AXIS_NAMES, Grid, type AxisNumber, type Triple } from "../state/grid";
import { GreyRangeBar, greyOfState } from "./grey_range_bar";
import { LocateBar } from "./locate_bar";
import { CrosshairLines } from "../scene/crosshair_lines";
import { SlicePlanes } from "../scene/slice_planes";
import { sliceLayout, type SliceLayout } from "../state/slice_layout";
import { CROSSHAIR, GREY, middleOf, PLANES, SLICES } from "../state/slice_state";
import { SliceCache } from "../api/slice_cache";
import { shownQuantity } from "../../shared/units";
import { SliceView } from "../scene/slice_view";
import { UNIT } from "../state/unit";
import { UP, upOf } from "../state/up_direction";
import { draggedWindow, type Window } from "../state/window_presets";
import type { Part } from "../state/part";
import type { State } from "../state/state";
import { valueAt } from "../api/wire_samples";

/** previous and next slice along x, y, z */
const KEYS = ["5", "6", "7", "8", "9", "0"];

/** Sample at the crosshair. */
export function crosshairOf({ page, history }: Pick<ViewerContext, "page" | "history">): Triple {
  return new Grid(page).inside(CROSSHAIR.of(history.now) ?? middleOf(page));
}

/** Text of a physical position. */
export function placeText({ page }: Pick<ViewerContext, "page">, place: readonly number[]): string {
  const shown = place.map((length) => shownQuantity(length, page.volume.unit, 1));
  return `${shown.map(({ amount }) => value(amount)).join(", ")} ${shown[0]?.unit ?? ""}`.trimEnd();
}

export class SliceTool {
  private readonly grid: Grid;
  private readonly views: SliceView[];
  private readonly store: SliceCache;
  private readonly contours: Contours;
  private readonly planes: SlicePlanes;
  private readonly mark: CrosshairLines;
  private readonly locateBar: LocateBar;
  private readonly greyBar: GreyRangeBar;
  /** at the start of a drag of the window */
  private windowBefore: Window | null = null;
  private readonly readout = html("output", { class: "at-crosshair", "aria-live": "polite" });
  private readonly element: HTMLElement;
  private readonly coalesce: (state: State) => void;
  private isFrameRequested = false;

  /** takeForMeasure: takes a clicked position if a measure is active. */
  constructor(
    private readonly context: ViewerContext,
    private readonly takeForMeasure: (place: Triple) => boolean,
  ) {
    const { page, viewport, overlay, api } = context;
    this.grid = new Grid(page);
    this.coalesce = coalesce(context.history);
    this.store = new SliceCache(api, () => this.redraw(), (error) => context.reportError(error));
    this.contours = new Contours(viewport, this.grid);
    this.planes = new SlicePlanes(viewport, this.grid);
    this.mark = new CrosshairLines(viewport, this.grid);
    this.locateBar = new LocateBar(context);
    this.greyBar = new GreyRangeBar(context);
    this.views = AXES.map(
      (axis) =>
        new SliceView(axis, this.grid, this.layoutOf(axis), {
          move: (voxel, dragging) => this.move(voxel, dragging),
          step: (axis, by) => this.step(axis, by),
          pick: (voxel) => this.pick(voxel),
          dragWindow: (right, down, done) => this.dragWindow(right, down, done),
        }),
    );
    const foot = html("div", { class: "foot" }, this.readout, this.locateBar.element, this.greyBar.element);
    this.element = html(
      "section",
      { class: "slices", "aria-label": "slices", hidden: true },
      html("div", { class: "views" }, ...this.views.map((view) => view.element)),
      foot,
    );
    overlay.append(this.element);
    this.addActions();
    this.listen();
  }

  move(voxel: Triple, dragging = false): void {
    const { history } = this.context;
    if (!dragging || String(voxel) !== String(crosshairOf(this.context))) history.go(CROSSHAIR.with(history.now, voxel), dragging);
  }

  private step(axis: AxisNumber, by: number): void {
    const voxel = crosshairOf(this.context);
    voxel[axis] += by;
    this.coalesce(CROSSHAIR.with(this.context.history.now, this.grid.inside(voxel)));
  }

  private dragWindow(right: number, down: number, done: boolean): void {
    if (!this.windowBefore && right === 0 && down === 0) return; // a click
    this.windowBefore ??= this.greyBar.window;
    this.greyBar.setWindow(draggedWindow(this.windowBefore, right, down), !done);
    if (done) this.windowBefore = null;
  }

  private layoutOf(axis: AxisNumber): SliceLayout {
    const { page, history } = this.context;
    return sliceLayout(axis, this.grid, page.volume.space, upOf(page, history.now));
  }

  private pick(voxel: Triple): void {
    if (!this.takeForMeasure(this.grid.place(voxel))) void this.locateBar.pick(voxel);
  }

  private listen(): void {
    const { history, overlay, viewport } = this.context;
    observePart(history, SLICES, (on) => {
      this.element.hidden = !on;
      overlay.classList.toggle("with-slices", on);
      if (on) this.locateBar.update(crosshairOf(this.context));
      this.redraw();
    });
    for (const part of [PLANES, GREY, UNIT, UP]) observePart<unknown>(history, part as Part<unknown>, () => this.redraw());
    observePart(history, CROSSHAIR, () => {
      this.redraw();
      if (SLICES.of(history.now)) this.locateBar.update(crosshairOf(this.context));
    });
    viewport.onChange(() => this.redraw());
    history.listen((state, before, dragging) => {
      if (!dragging && state.shown !== before.shown && SLICES.of(state)) this.locateBar.update(crosshairOf(this.context));
    });
    onClick(viewport.canvas, (event) => {
      const place = SLICES.of(history.now) ? viewport.pointAt(...placeOn(viewport.canvas, event)) : null;
      if (place) this.move(this.grid.nearest(place.toArray()));
    });
    this.context.api.connection.onChange(() => this.redraw());
    new ResizeObserver(() => this.redraw()).observe(this.element);
  }

  /** Requests a redraw in the next frame. */
  private redraw(): void {
    if (this.isFrameRequested) return;
    this.isFrameRequested = true;
    requestAnimationFrame(() => {
      this.isFrameRequested = false;
      this.draw();
    });
  }

  private draw(): void {
    const { history, page } = this.context;
    const [open, inPicture] = [SLICES.of(history.now), PLANES.of(history.now)];
    const cross = crosshairOf(this.context);
    this.mark.show(open || inPicture ? cross : null);
    if (!open && !inPicture) return this.planes.hide();
    const grey = greyOfState(page, history.now);
    const slices = AXES.map((axis) => this.store.get(axis, cross[axis]));
    this.views.forEach((view, axis) => {
      const contours = open ? this.contours.on(view.axis, cross[view.axis]) : [];
      const changed = view.draw(slices[axis] ?? null, contours, cross, grey, this.layoutOf(view.axis));
      if (inPicture && view.picture) this.planes.show(view.axis, view.picture, cross[view.axis], changed);
    });
    if (!inPicture) this.planes.hide();
    this.showReadout(cross, slices.map((slice) => slice && valueAt(slice, cross)).find((found) => found !== null) ?? null);
  }

  private showReadout(cross: Triple, found: number | null): void {
    const { valueUnit } = this.context.page.volume;
    const what = found === null ? "" : `${value(found)}${valueUnit ? ` ${valueUnit}` : ""}`;
    this.readout.replaceChildren(
      html("b", { class: "value" }, what || "…"),
      html("span", {}, `sample ${cross.join(", ")}`),
      html("span", {}, `at ${placeText(this.context, this.grid.place(cross))}`),
    );
  }

  private addActions(): void {
    const { actions } = this.context;
    const step = (axis: AxisNumber, by: number) => (): void => this.step(axis, by);
    actions.add(
      { group: "Tools", name: "Slices", keys: ["k"], ...toggleAction(this.context, SLICES) },
      { group: "Tools", name: "Slices in 3D", keys: ["K"], ...toggleAction(this.context, PLANES) },
      {
        group: "Tools",
        name: "Pick object at crosshair",
        keys: ["a"],
        run: () => void this.locateBar.pick(crosshairOf(this.context)),
      },
    );
    for (const axis of AXES) {
      const [name, back, forward] = [AXIS_NAMES[axis], KEYS[2 * axis] ?? "", KEYS[2 * axis + 1] ?? ""];
      actions.add({ group: "Tools", name: `Crosshair backward along ${name}`, keys: [back], run: step(axis, -1) });
      actions.add({ group: "Tools", name: `Crosshair forward along ${name}`, keys: [forward], run: step(axis, 1) });
    }
  }
}
