// Three slices through one point, with the contour of every surface that is shown, and a crosshair that they share with the picture.
import { html } from "../../dom";
import { value } from "../../format";
import { onClick, placeOn } from "../desk/clicks";
import { Contours } from "../draw/contours";
import type { Desk } from "../desk/desk";
import { follow, quickly, switching } from "../desk/follow";
import { AXES, AXIS_NAMES, Grid, type AxisNumber, type Triple } from "../state/grid";
import { greyBar } from "./grey_bar";
import { HeldHere } from "./held_here";
import { Mark } from "../draw/mark";
import { SlicePlanes } from "../draw/slice_planes";
import { CROSSHAIR, GREY, greyRange, middleOf, PLANES, SLICES } from "../state/slice_state";
import { SliceStore } from "../ask/slice_store";
import { SliceView } from "../draw/slice_view";
import type { State } from "../state/state";
import { valueAt } from "../ask/wire_samples";

/** back and on along x, y, z */
const KEYS = ["5", "6", "7", "8", "9", "0"];

/** Where the crosshair is. */
export function crosshairOf({ page, history }: Pick<Desk, "page" | "history">): Triple {
  return new Grid(page).inside(CROSSHAIR.of(history.now) ?? middleOf(page));
}

/** Of a place in space, as one says it. */
export function placeText({ page }: Pick<Desk, "page">, place: readonly number[]): string {
  return `${place.map(value).join(", ")} ${page.volume.unit ?? ""}`.trimEnd();
}

export class Slices {
  private readonly grid: Grid;
  private readonly views: SliceView[];
  private readonly store: SliceStore;
  private readonly contours: Contours;
  private readonly planes: SlicePlanes;
  private readonly mark: Mark;
  private readonly held: HeldHere;
  private readonly said = html("output", { class: "at-crosshair", "aria-live": "polite" });
  private readonly element: HTMLElement;
  private readonly quickly: (state: State) => void;
  private asked = false;

  /** measured: a place that is clicked is taken for a measure. */
  constructor(
    private readonly desk: Desk,
    private readonly measured: (place: Triple) => boolean,
  ) {
    const { page, stage, overlay, api } = desk;
    this.grid = new Grid(page);
    this.quickly = quickly(desk.history);
    this.store = new SliceStore(api, () => this.redraw(), (error) => desk.fail(error));
    this.contours = new Contours(stage, this.grid);
    this.planes = new SlicePlanes(stage, this.grid);
    this.mark = new Mark(stage, this.grid);
    this.held = new HeldHere(desk);
    this.views = AXES.map(
      (axis) =>
        new SliceView(axis, this.grid, {
          move: (voxel, dragging) => this.move(voxel, dragging),
          step: (axis, by) => this.step(axis, by),
          choose: (voxel) => this.choose(voxel),
        }),
    );
    const foot = html("div", { class: "foot" }, this.said, this.held.element, greyBar(desk));
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
    const { history } = this.desk;
    if (!dragging || String(voxel) !== String(crosshairOf(this.desk))) history.go(CROSSHAIR.in(history.now, voxel), dragging);
  }

  private step(axis: AxisNumber, by: number): void {
    const voxel = crosshairOf(this.desk);
    voxel[axis] += by;
    this.quickly(CROSSHAIR.in(this.desk.history.now, this.grid.inside(voxel)));
  }

  private choose(voxel: Triple): void {
    if (!this.measured(this.grid.place(voxel))) void this.held.choose(voxel);
  }

  private listen(): void {
    const { history, overlay, stage } = this.desk;
    follow(history, SLICES, (on) => {
      this.element.hidden = !on;
      overlay.classList.toggle("with-slices", on);
      if (on) this.held.look(crosshairOf(this.desk));
      this.redraw();
    });
    follow(history, PLANES, () => this.redraw());
    follow(history, GREY, () => this.redraw());
    follow(history, CROSSHAIR, () => {
      this.redraw();
      if (SLICES.of(history.now)) this.held.look(crosshairOf(this.desk));
    });
    stage.onChange(() => this.redraw());
    history.listen((state, before, dragging) => {
      if (!dragging && state.shown !== before.shown && SLICES.of(state)) this.held.look(crosshairOf(this.desk));
    });
    onClick(stage.canvas, (event) => {
      const place = SLICES.of(history.now) ? stage.touch(...placeOn(stage.canvas, event)) : null;
      if (place) this.move(this.grid.nearest(place.toArray()));
    });
    new ResizeObserver(() => this.redraw()).observe(this.element);
  }

  /** Soon; once for all that has changed. */
  private redraw(): void {
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame(() => {
      this.asked = false;
      this.draw();
    });
  }

  private draw(): void {
    const { history, page } = this.desk;
    const [open, inPicture] = [SLICES.of(history.now), PLANES.of(history.now)];
    const cross = crosshairOf(this.desk);
    this.mark.show(open || inPicture ? cross : null);
    if (!open && !inPicture) return this.planes.hide();
    const grey = (GREY.of(history.now) as [number, number] | null) ?? greyRange(page);
    const slices = AXES.map((axis) => this.store.get(axis, cross[axis]));
    this.views.forEach((view, axis) => {
      const contours = open ? this.contours.on(view.axis, cross[view.axis]) : [];
      const fresh = view.draw(slices[axis] ?? null, contours, cross, grey);
      if (inPicture && view.picture) this.planes.show(view.axis, view.picture, cross[view.axis], fresh);
    });
    if (!inPicture) this.planes.hide();
    this.tell(cross, slices.map((slice) => slice && valueAt(slice, cross)).find((found) => found !== null) ?? null);
  }

  private tell(cross: Triple, found: number | null): void {
    const { valueUnit } = this.desk.page.volume;
    const what = found === null ? "" : `${value(found)}${valueUnit ? ` ${valueUnit}` : ""}`;
    this.said.replaceChildren(
      html("b", { class: "value" }, what || "…"),
      html("span", {}, `sample ${cross.join(", ")}`),
      html("span", {}, `at ${placeText(this.desk, this.grid.place(cross))}`),
    );
  }

  private addActions(): void {
    const { actions } = this.desk;
    const step = (axis: AxisNumber, by: number) => (): void => this.step(axis, by);
    actions.add(
      { group: "Tools", name: "slices", keys: ["k"], ...switching(this.desk, SLICES) },
      { group: "Tools", name: "slices in the picture", keys: ["K"], ...switching(this.desk, PLANES) },
      {
        group: "Tools",
        name: "select what holds the sample at the crosshair",
        keys: ["a"],
        run: () => void this.held.choose(crosshairOf(this.desk)),
      },
    );
    for (const axis of AXES) {
      actions.add({ group: "Tools", name: `crosshair back along ${AXIS_NAMES[axis]}`, keys: [KEYS[2 * axis] ?? ""], run: step(axis, -1) });
      actions.add({ group: "Tools", name: `crosshair on along ${AXIS_NAMES[axis]}`, keys: [KEYS[2 * axis + 1] ?? ""], run: step(axis, 1) });
    }
  }
}
