// A handle that is dragged along a line. If the line is parallel to the view, dragging down moves along it.
import * as three from "three";
import type { Viewport } from "./viewport";

const NEAR_PIXELS = 16;
/** shorter projections count as parallel to the view, as a fraction of the length */
const MIN_PROJECTION = 0.25;

/** milliseconds between pointerup and click of one press */
const SAME_PRESS = 50;

export interface Handle {
  place: three.Vector3;
  /** unit vector */
  direction: three.Vector3;
}

/** Pixel of a position in the viewport, from its left and its top. */
export function pixelOf(viewport: Viewport, place: three.Vector3): three.Vector2 {
  const { clientWidth, clientHeight } = viewport.canvas;
  const projected = place.clone().project(viewport.rig.camera);
  return new three.Vector2(((projected.x + 1) / 2) * clientWidth, ((1 - projected.y) / 2) * clientHeight);
}

/** Physical distance along the line for a movement of the pointer in pixels. */
function dragDistance(viewport: Viewport, { place, direction }: Handle, movement: three.Vector2): number {
  const perPixel = viewport.rig.height / viewport.canvas.clientHeight;
  const length = 20 * perPixel;
  const projected = pixelOf(viewport, place.clone().addScaledVector(direction, length)).sub(pixelOf(viewport, place));
  if (projected.length() < MIN_PROJECTION * 20) return movement.y * perPixel;
  return (movement.dot(projected) / projected.lengthSq()) * length;
}

/** around: an ancestor of the canvas, which captures events. pull(by, done): physical distance since the last call. */
export function dragHandle(
  viewport: Viewport,
  around: HTMLElement,
  handle: () => Handle | null,
  pull: (by: number, done: boolean) => void,
): void {
  const at = (event: PointerEvent): three.Vector2 => {
    const frame = viewport.canvas.getBoundingClientRect();
    return new three.Vector2(event.clientX - frame.left, event.clientY - frame.top);
  };
  const isNear = (event: PointerEvent): boolean => {
    const current = handle();
    return event.target === viewport.canvas && current !== null && pixelOf(viewport, current.place).distanceTo(at(event)) < NEAR_PIXELS;
  };
  around.addEventListener("pointermove", (event) => {
    if (event.buttons === 0) viewport.canvas.style.cursor = isNear(event) ? "grab" : "";
  });
  let ended = -1;
  const start = (event: PointerEvent): void => {
    if (event.button !== 0 || !isNear(event)) return;
    event.stopPropagation();
    let last = at(event);
    const handlerOf = (done: boolean) => (next: PointerEvent): void => {
      const current = handle();
      if (current) pull(dragDistance(viewport, current, at(next).sub(last)), done);
      last = at(next);
    };
    const move = handlerOf(false);
    const end = (next: PointerEvent): void => {
      window.removeEventListener("pointermove", move);
      handlerOf(true)(next);
      ended = next.timeStamp;
    };
    window.addEventListener("pointermove", move);
    window.addEventListener("pointerup", end, { once: true });
  };
  around.addEventListener("pointerdown", start, { capture: true });
  // suppresses the click at the end of a drag
  around.addEventListener("click", (event) => event.timeStamp - ended < SAME_PRESS && event.stopPropagation(), { capture: true });
}
