// Camera actions: standard views, projection, fit; edges of the volume, scale bar.
import * as three from "three";
import type { Page } from "../../shared/page";
import type { ViewerContext } from "../context/viewer_context";
import { VIEWS } from "../scene/camera_rig";
import { observePart, coalesce, toggleAction } from "../context/observe";
import { anatomicalAxes, directionAlong } from "../state/directions";
import { AXES, Grid, type AxisNumber, type Triple } from "../state/grid";
import { flag } from "../state/part";
import { ScaleBar } from "../scene/scale_bar";

const ANGLE = Math.PI / 24;
const EDGES = flag("edges", "bounding box");
const FLAT = flag("flat", "orthographic");

export function addCameraTool(context: ViewerContext): void {
  const { page, viewport, actions, overlay, history } = context;
  viewport.rig.fit(new three.Box3().setFromPoints(cornersOf(page)).getBoundingSphere(new three.Sphere())); // until there is a surface
  const bar = new ScaleBar(page.volume.unit);
  viewport.onDraw(() => bar.show(viewport.rig.height, viewport.canvas.clientHeight));
  overlay.append(bar.element);
  showEdges(context);
  observePart(history, FLAT, (flat) => (viewport.rig.isFlat = flat));
  const go = coalesce(history);
  const addView = (name: string, keys: string[], move: () => void, short?: string): void => {
    const run = (): void => {
      move();
      go({ ...history.now, view: viewport.rig.view });
    };
    actions.add({ group: "View", name, short, keys, run });
  };
  addView("Fit to view", ["f"], () => viewport.fit());
  addView("Orbit left", ["ArrowLeft"], () => viewport.rig.turn(-ANGLE, 0));
  addView("Orbit right", ["ArrowRight"], () => viewport.rig.turn(ANGLE, 0));
  addView("Orbit up", ["ArrowUp"], () => viewport.rig.turn(0, ANGLE));
  addView("Orbit down", ["ArrowDown"], () => viewport.rig.turn(0, -ANGLE));
  for (const [key, direction] of Object.entries(VIEWS)) {
    const short = nameOfView(page, direction);
    addView(`View ${anatomicalAxes(page.volume.space) ? "from " : ""}${short}`, [key], () => viewport.rig.along(direction), short);
  }
  actions.add(
    { group: "View", name: "Orthographic", keys: ["o"], ...toggleAction(context, FLAT) },
    { group: "View", name: "Bounding box", keys: ["b"], ...toggleAction(context, EDGES) },
  );
}

/** Along a direction: "right, +X" of anatomical volumes, from that side; else "+X". */
function nameOfView({ volume }: Page, direction: Triple): string {
  const axis = direction.findIndex((n) => n !== 0) as AxisNumber;
  const sign = (direction[axis] ?? 0) > 0 ? 1 : -1;
  const along = `${sign > 0 ? "+" : "−"}${"XYZ"[axis]}`;
  const from = directionAlong(volume.space, axis, sign > 0 ? -1 : 1);
  return anatomicalAxes(volume.space) ? `${from.side}, ${along}` : along;
}

function showEdges({ page, viewport, history }: ViewerContext): void {
  const corners = cornersOf(page);
  let edges: three.LineSegments | null = null;
  observePart(history, EDGES, (on) => {
    if (edges) viewport.drop(edges);
    edges = null;
    if (!on) return;
    const ends = AXES.flatMap((axis) =>
      corners.flatMap((corner, i) => (i & (1 << axis) ? [] : [corner, corners[i | (1 << axis)] ?? corner])),
    );
    const geometry = new three.BufferGeometry().setFromPoints(ends);
    edges = new three.LineSegments(geometry, new three.LineBasicMaterial({ color: 0x888888 }));
    viewport.add(edges);
  });
}

function cornersOf(page: Page): three.Vector3[] {
  return new Grid(page).corners().map((corner) => new three.Vector3(...corner));
}
