// Keys that work wherever nothing is being typed.
import { VIEWS } from "./eye";
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
  /** shows all objects over the isovalue */
  tree(): void;
  /** cuts everything open, or closes it */
  cut(): void;
  /** shows the edges of the volume, or not */
  box(): void;
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
    o: () => stage.eye.toggleFlat(),
    b: () => actions.box(),
    c: () => actions.cut(),
    t: () => actions.tree(),
    Delete: () => actions.hide(),
    "?": () => actions.help(),
    ArrowLeft: () => stage.eye.turn(-ANGLE, 0),
    ArrowRight: () => stage.eye.turn(ANGLE, 0),
    ArrowUp: () => stage.eye.turn(0, ANGLE),
    ArrowDown: () => stage.eye.turn(0, -ANGLE),
  };
  for (const [key, direction] of Object.entries(VIEWS)) bound[key] = () => stage.eye.along(direction);
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
