// Clicks on elements that can also be dragged: presses that end where they began.

/** a press that moves less is a click */
const CLICK_PIXELS = 4;

/** early: in the capture phase, before the listeners of elements inside. */
export function onClick(element: HTMLElement, listener: (event: MouseEvent) => void, early = false): void {
  let pressed = { x: 0, y: 0 };
  element.addEventListener("pointerdown", (event) => (pressed = { x: event.clientX, y: event.clientY }), { capture: true });
  const click = (event: MouseEvent): void => {
    if (Math.hypot(event.clientX - pressed.x, event.clientY - pressed.y) <= CLICK_PIXELS) listener(event);
  };
  element.addEventListener("click", click, { capture: early });
}

/** Position of an event, in pixels from the left and the top of an element. */
export function placeOn(element: HTMLElement, event: MouseEvent): [number, number] {
  const frame = element.getBoundingClientRect();
  return [event.clientX - frame.left, event.clientY - frame.top];
}
