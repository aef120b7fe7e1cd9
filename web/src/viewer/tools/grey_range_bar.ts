// Values shown as black and white in slices.
import { Axis } from "../../shared/axis";
import { html } from "../../shared/dom";
import { value } from "../../shared/format";
import type { ViewerContext } from "../context/viewer_context";
import { observePart } from "../context/observe";
import { GREY, greyRange } from "../state/slice_state";

/** of a slider */
const STEPS = 1000;

export function greyBar({ page, history }: ViewerContext): HTMLElement {
  const axis = Axis.of(page, STEPS, 0);
  const first = greyRange(page);
  const slider = (label: string): HTMLInputElement => html("input", { type: "range", min: 0, max: STEPS, "aria-label": label });
  const [black, white] = [slider("black value"), slider("white value")];
  const text = html("span", { class: "soft" });
  const now = (): [number, number] => (GREY.of(history.now) as [number, number] | null) ?? first;
  const put = (transient: boolean): void => {
    const [low, high] = [axis.tau(Number(black.value)), axis.tau(Number(white.value))];
    if (low < high) history.go(GREY.with(history.now, [low, high]), transient);
    else show();
  };
  const show = (): void => {
    const [low, high] = now();
    black.value = String(Math.round(axis.x(low)));
    white.value = String(Math.round(axis.x(high)));
    black.setAttribute("aria-valuetext", value(low));
    white.setAttribute("aria-valuetext", value(high));
    text.textContent = `${value(low)} to ${value(high)}`;
  };
  for (const input of [black, white]) {
    input.addEventListener("input", () => put(true));
    input.addEventListener("change", () => put(false));
  }
  observePart(history, GREY, show);
  const reset = html(
    "button",
    { type: "button", title: "grey range from the histogram", click: () => history.go(GREY.with(history.now, null)) },
    "reset",
  );
  return html(
    "div",
    { class: "grey", role: "group", "aria-label": "grey range" },
    html("span", { class: "soft" }, "black"),
    black,
    html("span", { class: "soft" }, "white"),
    white,
    text,
    reset,
  );
}
