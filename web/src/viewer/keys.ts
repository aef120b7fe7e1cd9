// Keys that work wherever nothing is being typed.
import type { Stage } from "./stage";

export interface Actions {
  /** by a share of the range */
  step(by: number): void;
  /** to where the next object that matters begins or ends */
  event(up: boolean): void;
  undo(): void;
  redo(): void;
  fit(): void;
  /** takes what is selected out of the scene */
  hide(): void;
  help(): void;
}

const STEP = 0.005;
const ANGLE = Math.PI / 24;

export function keys(stage: Stage, actions: Actions): void {
  const bound: Record<string, () => void> = {
    "[": () => actions.step(-STEP),
    "]": () => actions.step(STEP),
    "{": () => actions.event(false),
    "}": () => actions.event(true),
    f: () => actions.fit(),
    Delete: () => actions.hide(),
    "?": () => actions.help(),
    ArrowLeft: () => stage.turn(-ANGLE, 0),
    ArrowRight: () => stage.turn(ANGLE, 0),
    ArrowUp: () => stage.turn(0, ANGLE),
    ArrowDown: () => stage.turn(0, -ANGLE),
  };
  document.addEventListener("keydown", (event) => {
    const typing = event.target instanceof HTMLInputElement && event.target.type !== "checkbox";
    if ((event.ctrlKey || event.metaKey) && event.key.toLowerCase() === "z") {
      if (event.shiftKey) actions.redo();
      else actions.undo();
      event.preventDefault();
      return;
    }
    const action = bound[event.key];
    if (!action || typing || event.ctrlKey || event.metaKey || event.altKey) return;
    action();
    event.preventDefault();
  });
}
