// Helpers for tools that depend on a part of the state.
import type { ViewerContext } from "./viewer_context";
import type { History } from "../state/history";
import type { Part } from "../state/part";
import type { State } from "../state/state";

/** Calls with the value of a part now and after every change of it. */
export function observePart<T>(history: History, part: Part<T>, apply: (value: T) => void): void {
  let text: string | undefined;
  history.listen((state) => {
    if (state.parts[part.key] === text) return;
    text = state.parts[part.key];
    apply(part.of(state));
  });
  text = history.now.parts[part.key];
  apply(part.of(history.now));
}

/** milliseconds without a further change */
const SETTLED = 400;

/** For keys and wheels: rapid consecutive changes are one step of the history. */
export function coalesce(history: History): (state: State) => void {
  let timer: ReturnType<typeof setTimeout> | undefined;
  return (state) => {
    clearTimeout(timer);
    history.go(state, true);
    timer = setTimeout(() => history.go(history.now), SETTLED);
  };
}

/** The run and isOn of an action that toggles a part. */
export function toggleAction({ history }: Pick<ViewerContext, "history">, part: Part<boolean>): { run: () => void; isOn: () => boolean } {
  return {
    run: () => history.go(part.with(history.now, !part.of(history.now))),
    isOn: () => part.of(history.now),
  };
}
