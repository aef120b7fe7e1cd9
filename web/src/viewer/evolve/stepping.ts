// Steps along the isovalue of what is selected: by a delta of one's own, or to where something happens.
import type { Page } from "../../page";
import type { Desk } from "../desk/desk";
import { eventsOf } from "../state/events";
import { number } from "../state/part";
import { nextEvent, type State } from "../state/state";

/** of the axis, for one step where nobody has said how much */
const SHARE = 0.005;
export const DELTA = number("step", "step", (n) => n > 0);

export function deltaOf(page: Page, state: State): number {
  return DELTA.of(state) ?? Number((SHARE * (page.axis.high - page.axis.low)).toPrecision(3));
}

export function stepping(desk: Desk): void {
  const { page, actions, editor, history } = desk;
  const events = eventsOf(page);
  const step = (by: number) => (): void => {
    if (editor.selected) editor.move(editor.selected.tau + by * deltaOf(page, history.now));
  };
  const toEvent = (up: boolean) => (): void => {
    const tau =
      editor.selected &&
      nextEvent(
        events.map((event) => event.tau),
        editor.selected.tau,
        up,
      );
    if (typeof tau !== "number") return;
    editor.move(tau);
    desk.say(events.find((event) => event.tau === tau)?.text ?? "");
  };
  actions.add(
    { group: "Isovalue", name: "down by a step", keys: ["["], run: step(-1) },
    { group: "Isovalue", name: "up by a step", keys: ["]"], run: step(1) },
    { group: "Isovalue", name: "down to where the next object that matters ends or begins", keys: ["{"], run: toEvent(false) },
    { group: "Isovalue", name: "up to where the next object that matters ends or begins", keys: ["}"], run: toEvent(true) },
    { group: "Isovalue", name: "all objects to the isovalue of the selected one", run: () => editor.level() },
  );
}
