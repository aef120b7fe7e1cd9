// Something in the picture that is pulled along a line. Where the line points at the eye, down is along it.
import * as three from "three";
import type { Stage } from "./stage";

const NEAR_PIXELS = 16;
/** of a length seen from the side: the line points at the eye if less of it is seen */
const SEEN = 0.25;

/** milliseconds between the end of a press and its click */
const SAME_PRESS = 50;

export interface Handle {
  place: three.Vector3;
  /** unit vector */
  direction: three.Vector3;
}

/** Where a place is in the picture, in pixels from its left and its top. */
export function pixelOf(stage: Stage, place: three.Vector3): three.Vector2 {
  const { clientWidth, clientHeight } = stage.canvas;
  const seen = place.clone().project(stage.eye.camera);
  return new three.Vector2(((seen.x + 1) / 2) * clientWidth, ((1 - seen.y) / 2) * clientHeight);
}

/** How far one pulls, for a way of the pointer in pixels. */
function pulled(stage: Stage, { place, direction }: Handle, way: three.Vector2): number {
  const perPixel = stage.eye.height / stage.canvas.clientHeight;
  const length = 20 * perPixel;
  const seen = pixelOf(stage, place.clone().addScaledVector(direction, length)).sub(pixelOf(stage, place));
  if (seen.length() < SEEN * 20) return way.y * perPixel;
  return (way.dot(seen) / seen.lengthSq()) * length;
}

/** around: an element around the picture, which hears of presses first. pull(by, done): since the last call, physical. */
export function dragging(stage: Stage, around: HTMLElement, handle: () => Handle | null, pull: (by: number, done: boolean) => void): void {
  const at = (event: PointerEvent): three.Vector2 => {
    const frame = stage.canvas.getBoundingClientRect();
    return new three.Vector2(event.clientX - frame.left, event.clientY - frame.top);
  };
  const isNear = (event: PointerEvent): boolean => {
    const held = handle();
    return event.target === stage.canvas && held !== null && pixelOf(stage, held.place).distanceTo(at(event)) < NEAR_PIXELS;
  };
  around.addEventListener("pointermove", (event) => {
    if (event.buttons === 0) stage.canvas.style.cursor = isNear(event) ? "grab" : "";
  });
  let ended = -1;
  const start = (event: PointerEvent): void => {
    if (event.button !== 0 || !isNear(event)) return;
    event.stopPropagation();
    let last = at(event);
    const follow = (done: boolean) => (next: PointerEvent): void => {
      const held = handle();
      if (held) pull(pulled(stage, held, at(next).sub(last)), done);
      last = at(next);
    };
    const move = follow(false);
    const end = (next: PointerEvent): void => {
      window.removeEventListener("pointermove", move);
      follow(true)(next);
      ended = next.timeStamp;
    };
    window.addEventListener("pointermove", move);
    window.addEventListener("pointerup", end, { once: true });
  };
  around.addEventListener("pointerdown", start, { capture: true });
  // the click that ends it means nothing else
  around.addEventListener("click", (event) => event.timeStamp - ended < SAME_PRESS && event.stopPropagation(), { capture: true });
}
