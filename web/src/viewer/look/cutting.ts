// Cutting everything open: by a key, along an axis, with a slider, and by pulling the handle on the plane.
import * as three from "three";
import { html } from "../../dom";
import { CUT, middleOfAll, moved, outlineOf, planeOf, turned, type Plane } from "../state/cut_plane";
import type { Desk } from "../desk/desk";
import { follow } from "../desk/follow";
import { AXES, AXIS_NAMES, Grid, type Triple } from "../state/grid";
import { dragging } from "../draw/handle";

const COLOUR = 0x0072b2;
/** of the extent, for one press of a key */
const STEP = 0.02;

/** tools: where the bar of the cut goes. */
export function cutting(desk: Desk, tools: HTMLElement): void {
  const { page, stage, actions, overlay, history } = desk;
  const grid = new Grid(page);
  const corners = grid.corners();
  const now = (): number[] | null => CUT.of(history.now);
  const go = (cut: number[] | null, transient = false): void => history.go(CUT.in(history.now, cut), transient);
  const change = (by: (cut: number[]) => number[]) => (): void => {
    const cut = now();
    if (cut) go(by(cut));
  };
  const fromHere = (): number[] => [...stage.eye.camera.getWorldDirection(new three.Vector3()).toArray(), 0.5];
  const along = (axis: 0 | 1 | 2) => (): void => go([...grid.directions[axis], 0.5]);

  const outline = new Outline(desk, corners);
  const slider = html("input", { type: "range", min: 0, max: 1, step: 0.005, "aria-label": "where it is cut open: how much stays" });
  const slide = (transient: boolean): void => {
    const cut = now();
    if (cut) go([...cut.slice(0, 3), Number(slider.value)], transient);
  };
  slider.addEventListener("input", () => slide(true));
  slider.addEventListener("change", () => slide(false));
  const button = (name: string, title: string, run: () => void): HTMLElement =>
    html("button", { type: "button", title, "aria-label": title, click: run }, name);
  const bar = html(
    "div",
    { class: "cut-bar", role: "group", "aria-label": "the cut", hidden: true },
    html("span", {}, "Cut"),
    ...AXES.map((axis) => button(AXIS_NAMES[axis], `cut along ${AXIS_NAMES[axis]}`, along(axis))),
    button("view", "cut from the view of the eye", () => go(fromHere())),
    slider,
    button("⇄", "keep the other half", change(turned)),
    button("✕", "close the cut", () => go(null)),
  );
  tools.append(bar);
  follow(history, CUT, (cut) => {
    bar.hidden = !cut;
    if (cut) slider.value = String(cut[3]);
    const plane = cut && planeOf(cut, corners);
    stage.cut(plane && new three.Plane(new three.Vector3(...plane.normal), plane.constant));
    outline.show(plane);
  });
  dragging(stage, overlay, () => outline.handle, (by, done) => {
    const cut = now();
    if (cut) go(moved(cut, by, corners), !done);
  });
  actions.add({
    group: "Look",
    name: "cut everything open, from where you look",
    keys: ["c"],
    run: () => go(now() ? null : fromHere()),
    isOn: () => now() !== null,
  });
  for (const axis of AXES) actions.add({ group: "Look", name: `cut along ${AXIS_NAMES[axis]}`, run: along(axis) });
  actions.add(
    { group: "Look", name: "cut deeper", keys: [">"], run: change(([x, y, z, share]) => [x!, y!, z!, Math.max(0, share! - STEP)]) },
    { group: "Look", name: "cut less deep", keys: ["<"], run: change(([x, y, z, share]) => [x!, y!, z!, Math.min(1, share! + STEP)]) },
    { group: "Look", name: "keep the other half of the cut", run: change(turned) },
  );
}

/** The plane in the box of the volume, and a handle in its middle. */
class Outline {
  private lines: three.Object3D | null = null;
  handle: { place: three.Vector3; direction: three.Vector3 } | null = null;

  constructor(
    private readonly desk: Desk,
    private readonly corners: readonly Triple[],
  ) {}

  show(plane: Plane | null): void {
    const { stage } = this.desk;
    if (this.lines) stage.drop(this.lines);
    this.lines = this.handle = null;
    const points = plane ? outlineOf(plane, this.corners) : [];
    if (!plane || points.length === 0) return;
    const middle = middleOfAll(points);
    const line = new three.LineLoop(
      new three.BufferGeometry().setFromPoints(points.map((point) => new three.Vector3(...point))),
      new three.LineBasicMaterial({ color: COLOUR }),
    );
    const dot = new three.Points(
      new three.BufferGeometry().setFromPoints([new three.Vector3(...middle)]),
      new three.PointsMaterial({ color: COLOUR, size: 14 * stage.renderer.getPixelRatio(), sizeAttenuation: false, depthTest: false }),
    );
    dot.renderOrder = 1000;
    this.lines = new three.Group().add(line, dot);
    this.lines.userData.isTool = true;
    this.handle = { place: new three.Vector3(...middle), direction: new three.Vector3(...plane.normal) };
    stage.add(this.lines);
  }
}
