// Which values are black and white in slices.
import { Axis } from "../../axis";
import { html } from "../../dom";
import { value } from "../../format";
import type { Desk } from "../desk/desk";
import { follow } from "../desk/follow";
import { GREY, greyRange } from "../state/slice_state";

/** of a slider */
const STEPS = 1000;

export function greyBar({ page, history }: Desk): HTMLElement {
  const axis = Axis.of(page, STEPS, 0);
  const first = greyRange(page);
  const slider = (label: string): HTMLInputElement => html("input", { type: "range", min: 0, max: STEPS, "aria-label": label });
  const [black, white] = [slider("value that is black"), slider("value that is white")];
  const text = html("span", { class: "soft" });
  const now = (): [number, number] => (GREY.of(history.now) as [number, number] | null) ?? first;
  const put = (transient: boolean): void => {
    const [low, high] = [axis.tau(Number(black.value)), axis.tau(Number(white.value))];
    if (low < high) history.go(GREY.in(history.now, [low, high]), transient);
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
  follow(history, GREY, show);
  const reset = html(
    "button",
    { type: "button", title: "brightness as the histogram says", click: () => history.go(GREY.in(history.now, null)) },
    "reset",
  );
  return html(
    "div",
    { class: "grey", role: "group", "aria-label": "brightness" },
    html("span", { class: "soft" }, "black"),
    black,
    html("span", { class: "soft" }, "white"),
    white,
    text,
    reset,
  );
}
