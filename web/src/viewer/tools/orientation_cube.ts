// Orientation cube: a click on a face views the volume from there. Also slow rotation.
import * as three from "three";
import { html } from "../../shared/dom";
import type { ViewerContext } from "../context/viewer_context";
import { facesOf, type Face } from "../state/directions";
import { dot } from "../state/grid";
import { turnedUp, upOf } from "../state/up_direction";

/** pixels */
const HALF_EDGE = 23;
/** radians per second: 30 s per turn */
const TURN_PER_SECOND = (2 * Math.PI) / 30;

export function addOrientationCube(context: ViewerContext): void {
  const { page, viewport, overlay, history } = context;
  const element = html("div", { class: "cube", role: "group", "aria-label": "orientation" });
  const faces = facesOf(page.volume.space).map((face) => {
    const from = (): void => {
      viewport.rig.along(face.normal.map((n) => 0 - n) as [number, number, number]);
      history.go({ ...history.now, view: viewport.rig.view });
    };
    const title = `view from ${face.name}`;
    const button = html("button", { type: "button", title, "aria-label": title, click: from }, face.letter);
    element.append(button);
    return { face, button };
  });
  overlay.append(element);
  viewport.onDraw(() => {
    const rotation = new three.Matrix4().makeRotationFromQuaternion(viewport.rig.camera.quaternion.clone().invert());
    const up = upOf(page, history.now);
    for (const { face, button } of faces) button.style.transform = `matrix3d(${placed(face, rotation, up).join(",")})`;
  });
  turning(context);
}

/** CSS transform of a face; y is down. Its letter stands upright, along an axis of space. */
function placed({ normal }: Face, rotation: three.Matrix4, upwards: readonly number[]): number[] {
  const out = new three.Vector3(...normal);
  const back = turnedUp(upwards, [0, 1, 0]);
  const standing = facesOf("").map((face) => face.normal).filter((axis) => dot(axis, normal) === 0);
  const height = (axis: readonly number[]): number => dot(axis, upwards) + 0.01 * dot(axis, back); // of faces seen along the axis: back
  const up = new three.Vector3(...standing.reduce((best, axis) => (height(axis) > height(best) + 1e-9 ? axis : best)));
  const right = up.clone().cross(out);
  const columns = [right, up.clone().negate(), out, out.clone().multiplyScalar(HALF_EDGE)];
  return columns.flatMap((column, i) => {
    const { x, y, z } = column.applyMatrix4(rotation);
    return [x, -y, z, i === 3 ? 1 : 0].map((n) => Number(n.toFixed(5)));
  });
}

/** Rotates around the vertical axis until any input. */
function turning(context: ViewerContext): void {
  const { viewport, actions, overlay, history } = context;
  let last: number | null = null;
  const turn = (time: number): void => {
    if (last === null) return;
    viewport.rig.turn((Math.min(time - last, 100) / 1000) * TURN_PER_SECOND, 0);
    last = time;
    requestAnimationFrame(turn);
  };
  const stop = (): void => {
    if (last === null) return;
    last = null;
    history.go({ ...history.now, view: viewport.rig.view });
  };
  const start = (): void => {
    if (matchMedia("(prefers-reduced-motion: reduce)").matches)
      return context.notify("your system prefers less motion: use the arrow keys");
    last = performance.now();
    requestAnimationFrame(turn);
  };
  overlay.addEventListener("pointerdown", stop, { capture: true });
  overlay.addEventListener("wheel", stop, { capture: true, passive: true });
  document.addEventListener("keydown", (event) => event.key !== "T" && event.key !== "Shift" && stop(), { capture: true });
  actions.add({
    group: "View",
    name: "Rotate slowly",
    keys: ["T"],
    run: () => (last === null ? start() : stop()),
    isOn: () => last !== null,
  });
}
