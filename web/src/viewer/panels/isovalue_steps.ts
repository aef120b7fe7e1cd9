// Steps of the isovalue of the selected object: by a fixed step, or to the next event.
import type { Page } from "../../shared/page";
import type { ViewerContext } from "../context/viewer_context";
import { eventsOf } from "../state/events";
import { number } from "../state/part";
import { nextEvent, type State } from "../state/state";

/** default step, as a fraction of the axis */
const SHARE = 0.005;
export const DELTA = number("step", "step", (n) => n > 0);

export function deltaOf(page: Page, state: State): number {
  return DELTA.of(state) ?? Number((SHARE * (page.axis.high - page.axis.low)).toPrecision(3));
}

export function addIsovalueSteps(context: ViewerContext): void {
  const { page, actions, editor, history } = context;
  const events = eventsOf(page);
  const step = (by: number) => (): void => {
    if (editor.selected) editor.setIsovalue(editor.selected.tau + by * deltaOf(page, history.now));
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
    editor.setIsovalue(tau);
    context.notify(events.find((event) => event.tau === tau)?.text ?? "");
  };
  actions.add(
    { group: "Isovalue", name: "Down by a step", keys: ["["], run: step(-1) },
    { group: "Isovalue", name: "Up by a step", keys: ["]"], run: step(1) },
    { group: "Isovalue", name: "Down to the next event (appearance or merge)", keys: ["{"], run: toEvent(false) },
    { group: "Isovalue", name: "Up to the next event (appearance or merge)", keys: ["}"], run: toEvent(true) },
    { group: "Isovalue", name: "Set all objects to the isovalue of the selected one", run: () => editor.setAllIsovalues() },
  );
}
