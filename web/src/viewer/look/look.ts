// Where one looks from, with or without perspective, the edges of the volume and how long things are.
import * as three from "three";
import type { Page } from "../../page";
import type { Desk } from "../desk/desk";
import { VIEWS } from "../draw/eye";
import { follow, quickly, switching } from "../desk/follow";
import { AXES, Grid } from "../state/grid";
import { flag } from "../state/part";
import { ScaleBar } from "../draw/scale_bar";

const ANGLE = Math.PI / 24;
const EDGES = flag("edges", "edges of the volume");
const FLAT = flag("flat", "without perspective");

export function look(desk: Desk): void {
  const { page, stage, actions, overlay, history } = desk;
  stage.eye.fit(new three.Box3().setFromPoints(cornersOf(page)).getBoundingSphere(new three.Sphere())); // until there is something to see
  const bar = new ScaleBar(page.volume.unit);
  stage.onDraw(() => bar.show(stage.eye.height, stage.canvas.clientHeight));
  overlay.append(bar.element);
  showEdges(desk);
  follow(history, FLAT, (flat) => (stage.eye.isFlat = flat));
  const go = quickly(history);
  const see = (name: string, keys: string[], move: () => void): void => {
    const run = (): void => {
      move();
      go({ ...history.now, view: stage.eye.view });
    };
    actions.add({ group: "Look", name, keys, run });
  };
  see("all that is shown in the middle", ["f"], () => stage.fit());
  see("turn left", ["ArrowLeft"], () => stage.eye.turn(-ANGLE, 0));
  see("turn right", ["ArrowRight"], () => stage.eye.turn(ANGLE, 0));
  see("turn up", ["ArrowUp"], () => stage.eye.turn(0, ANGLE));
  see("turn down", ["ArrowDown"], () => stage.eye.turn(0, -ANGLE));
  for (const [key, direction] of Object.entries(VIEWS)) {
    const way = key === key.toLowerCase() ? "along" : "against";
    see(`look ${way} ${key.toLowerCase()}`, [key], () => stage.eye.along(direction));
  }
  actions.add(
    { group: "Look", name: "without perspective", keys: ["o"], ...switching(desk, FLAT) },
    { group: "Look", name: "edges of the volume", keys: ["b"], ...switching(desk, EDGES) },
  );
}

function showEdges({ page, stage, history }: Desk): void {
  const corners = cornersOf(page);
  let edges: three.LineSegments | null = null;
  follow(history, EDGES, (on) => {
    if (edges) stage.drop(edges);
    edges = null;
    if (!on) return;
    const ends = AXES.flatMap((axis) =>
      corners.flatMap((corner, i) => (i & (1 << axis) ? [] : [corner, corners[i | (1 << axis)] ?? corner])),
    );
    const geometry = new three.BufferGeometry().setFromPoints(ends);
    edges = new three.LineSegments(geometry, new three.LineBasicMaterial({ color: 0x888888 }));
    stage.add(edges);
  });
}

function cornersOf(page: Page): three.Vector3[] {
  return new Grid(page).corners().map((corner) => new three.Vector3(...corner));
}
