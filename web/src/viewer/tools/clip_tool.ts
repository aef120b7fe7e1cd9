// Clipping plane: by key, along an axis, with a slider, and by dragging the handle of the plane.
import * as three from "three";
import { html } from "../../shared/dom";
import { CUT, middleOfAll, moved, outlineOf, planeOf, turned, type Plane } from "../state/cut_plane";
import type { ViewerContext } from "../context/viewer_context";
import { observePart } from "../context/observe";
import { AXES, AXIS_NAMES, Grid, type Triple } from "../state/grid";
import { dragHandle } from "../scene/handle";

const COLOUR = 0x0072b2;
/** step of a key, as a fraction of the extent */
const STEP = 0.02;

/** tools: the container of the tool bars. */
export function addClipTool(context: ViewerContext, tools: HTMLElement): void {
  const { page, viewport, actions, overlay, history } = context;
  const grid = new Grid(page);
  const corners = grid.corners();
  const now = (): number[] | null => CUT.of(history.now);
  const go = (cut: number[] | null, transient = false): void => history.go(CUT.with(history.now, cut), transient);
  const change = (by: (cut: number[]) => number[]) => (): void => {
    const cut = now();
    if (cut) go(by(cut));
  };
  const fromHere = (): number[] => [...viewport.rig.camera.getWorldDirection(new three.Vector3()).toArray(), 0.5];
  const along = (axis: 0 | 1 | 2) => (): void => go([...grid.directions[axis], 0.5]);

  const outline = new Outline(context, corners);
  const slider = html("input", { type: "range", min: 0, max: 1, step: 0.005, "aria-label": "fraction of the volume that stays" });
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
    { class: "cut-bar", role: "group", "aria-label": "clipping plane", hidden: true },
    html("span", {}, "Clip"),
    ...AXES.map((axis) => button(AXIS_NAMES[axis], `clip along ${AXIS_NAMES[axis]}`, along(axis))),
    button("camera", "clip facing the camera", () => go(fromHere())),
    slider,
    button("⇄", "flip the clipping plane", change(turned)),
    button("✕", "remove the clipping plane", () => go(null)),
  );
  tools.append(bar);
  observePart(history, CUT, (cut) => {
    bar.hidden = !cut;
    if (cut) slider.value = String(cut[3]);
    const plane = cut && planeOf(cut, corners);
    viewport.setClipPlane(plane && new three.Plane(new three.Vector3(...plane.normal), plane.constant));
    outline.show(plane);
  });
  dragHandle(viewport, overlay, () => outline.handle, (by, done) => {
    const cut = now();
    if (cut) go(moved(cut, by, corners), !done);
  });
  actions.add({
    group: "View",
    name: "Clip with a plane facing the camera",
    keys: ["c"],
    run: () => go(now() ? null : fromHere()),
    isOn: () => now() !== null,
  });
  for (const axis of AXES) {
    const short = `along ${AXIS_NAMES[axis]}`;
    actions.add({ group: "View", name: `Clip ${short}`, short, run: along(axis) });
  }
  const resized = (by: number) => change(([x, y, z, share]) => [x!, y!, z!, Math.min(Math.max(share! + by, 0), 1)]);
  actions.add(
    { group: "View", name: "Clip more", short: "more", keys: [">"], run: resized(-STEP) },
    { group: "View", name: "Clip less", short: "less", keys: ["<"], run: resized(STEP) },
    { group: "View", name: "Flip the clipping plane", short: "Flip", run: change(turned) },
  );
}

/** Outline of the plane in the box of the volume, with a handle in its middle. */
class Outline {
  private lines: three.Object3D | null = null;
  handle: { place: three.Vector3; direction: three.Vector3 } | null = null;

  constructor(
    private readonly context: ViewerContext,
    private readonly corners: readonly Triple[],
  ) {}

  show(plane: Plane | null): void {
    const { viewport } = this.context;
    if (this.lines) viewport.drop(this.lines);
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
      new three.PointsMaterial({ color: COLOUR, size: 14 * viewport.renderer.getPixelRatio(), sizeAttenuation: false, depthTest: false }),
    );
    dot.renderOrder = 1000;
    this.lines = new three.Group().add(line, dot);
    this.lines.userData.isTool = true;
    this.handle = { place: new three.Vector3(...middle), direction: new three.Vector3(...plane.normal) };
    viewport.add(this.lines);
  }
}
