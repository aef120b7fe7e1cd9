// A part of the viewer that does what the state says of it.
import type { Desk } from "./desk";
import type { History } from "../state/history";
import type { Part } from "../state/part";
import type { State } from "../state/state";

/** Calls with the value of a part now, and whenever it is another one. */
export function follow<T>(history: History, part: Part<T>, apply: (value: T) => void): void {
  let text: string | undefined;
  history.listen((state) => {
    if (state.parts[part.key] === text) return;
    text = state.parts[part.key];
    apply(part.of(state));
  });
  text = history.now.parts[part.key];
  apply(part.of(history.now));
}

/** milliseconds without another change: then it is done */
const SETTLED = 400;

/** For keys and wheels: changes that come quickly one after the other are one step of history. */
export function quickly(history: History): (state: State) => void {
  let timer: ReturnType<typeof setTimeout> | undefined;
  return (state) => {
    clearTimeout(timer);
    history.go(state, true);
    timer = setTimeout(() => history.go(history.now), SETTLED);
  };
}

/** Of an action that turns a part on and off. */
export function switching({ history }: Pick<Desk, "history">, part: Part<boolean>): { run: () => void; isOn: () => boolean } {
  return {
    run: () => history.go(part.in(history.now, !part.of(history.now))),
    isOn: () => part.of(history.now),
  };
}
