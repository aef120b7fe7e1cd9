// The orientation cube: how the axes of space lie in the picture; a click on a face looks at it from there. And turning slowly by itself.
import * as three from "three";
import { html } from "../../dom";
import { facesOf, type Face } from "./axis_names";
import type { Desk } from "../desk/desk";

/** pixels */
const HALF_EDGE = 23;
/** a turn takes half a minute */
const TURN_PER_SECOND = (2 * Math.PI) / 30;

export function cube(desk: Desk): void {
  const { page, stage, overlay, history } = desk;
  const element = html("div", { class: "cube", role: "group", "aria-label": "orientation" });
  const faces = facesOf(page.volume.space).map((face) => {
    const from = (): void => {
      stage.eye.along(face.normal.map((n) => 0 - n) as [number, number, number]);
      history.go({ ...history.now, view: stage.eye.view });
    };
    const title = `look from ${face.name}`;
    const button = html("button", { type: "button", title, "aria-label": title, click: from }, face.letter);
    element.append(button);
    return { face, button };
  });
  overlay.append(element);
  stage.onDraw(() => {
    const seen = new three.Matrix4().makeRotationFromQuaternion(stage.eye.camera.quaternion.clone().invert());
    for (const { face, button } of faces) button.style.transform = `matrix3d(${placed(face, seen).join(",")})`;
  });
  turning(desk);
}

/** A face in the picture, as CSS wants it: y is down. */
function placed({ normal }: Face, seen: three.Matrix4): number[] {
  const out = new three.Vector3(...normal);
  const up = normal[2] === 0 ? new three.Vector3(0, 0, 1) : new three.Vector3(0, 1, 0);
  const right = up.clone().cross(out);
  const columns = [right, up.clone().negate(), out, out.clone().multiplyScalar(HALF_EDGE)];
  return columns.flatMap((column, i) => {
    const { x, y, z } = column.applyMatrix4(seen);
    return [x, -y, z, i === 3 ? 1 : 0].map((n) => Number(n.toFixed(5)));
  });
}

/** Around the vertical until anything is touched. */
function turning(desk: Desk): void {
  const { stage, actions, overlay, history } = desk;
  let last: number | null = null;
  const turn = (time: number): void => {
    if (last === null) return;
    stage.eye.turn((Math.min(time - last, 100) / 1000) * TURN_PER_SECOND, 0);
    last = time;
    requestAnimationFrame(turn);
  };
  const stop = (): void => {
    if (last === null) return;
    last = null;
    history.go({ ...history.now, view: stage.eye.view });
  };
  const start = (): void => {
    if (matchMedia("(prefers-reduced-motion: reduce)").matches) return desk.say("your system asks for less motion: the arrow keys turn");
    last = performance.now();
    requestAnimationFrame(turn);
  };
  overlay.addEventListener("pointerdown", stop, { capture: true });
  overlay.addEventListener("wheel", stop, { capture: true, passive: true });
  document.addEventListener("keydown", (event) => event.key !== "T" && event.key !== "Shift" && stop(), { capture: true });
  actions.add({
    group: "Look",
    name: "turn slowly by itself",
    keys: ["T"],
    run: () => (last === null ? start() : stop()),
    isOn: () => last !== null,
  });
}
