// Which direction is upwards in the 3D view, and how the picture is rolled: one state (state/up_direction.ts).
import type { ViewerContext } from "../context/viewer_context";
import { coalesce, observePart } from "../context/observe";
import type { Triple } from "../state/grid";
import { isSame, rolled, turnedBack, turnedUp, UP, UP_WORDS, upOf, usualFront, usualUp, vectorOf, withUp } from "../state/up_direction";

const STEP = Math.PI / 36;
const QUARTER = Math.PI / 2;

type UpContext = Pick<ViewerContext, "page" | "viewport" | "history" | "actions">;

export function addUpTool({ page, viewport, history, actions }: UpContext): void {
  const { rig } = viewport;
  const now = (): Triple => upOf(page, history.now);
  rig.firstOffset = turnedBack(usualUp(page), usualFront(page));
  observePart(history, UP, (up) => (rig.up = up ?? usualUp(page)));

  /** The camera goes along: what was seen from slightly above still is. */
  const choose = (up: Triple) => (): void => {
    const [position, target] = [rig.view.slice(0, 3), rig.view.slice(3)];
    const offset = turnedUp(up, turnedBack(now(), position.map((n, i) => n - target[i]!)));
    const view = [...target.map((n, i) => n + offset[i]!), ...target].map((n) => Number(n.toPrecision(7)));
    const isPlaced = history.now.view !== null;
    history.go({ ...withUp(page, history.now, up), view: isPlaced ? view : null });
    if (!isPlaced) rig.view = view; // the fit that comes keeps the direction
  };
  const go = coalesce(history);
  /** Turns the picture clockwise by an angle. */
  const roll = (angle: number) => (): void => go(withUp(page, history.now, rolled(now(), rig.forward, -angle)));

  for (const word of UP_WORDS) {
    const name = `${word.startsWith("-") ? "−" : "+"}${word.slice(-1).toUpperCase()}`;
    const isOn = (): boolean => isSame(now(), vectorOf(word));
    actions.add({ group: "View", name: `Up direction ${name}`, short: name, run: choose(vectorOf(word)), isOn });
  }
  actions.add(
    { group: "View", name: "Flip the up direction", keys: ["u"], run: () => choose(now().map((n) => 0 - n) as Triple)() },
    { group: "View", name: "Roll left 90°", short: "Roll left 90°", keys: ["Q"], run: roll(-QUARTER) },
    { group: "View", name: "Roll right 90°", short: "Roll right 90°", keys: ["R"], run: roll(QUARTER) },
    { group: "View", name: "Roll left 5°", keys: ["q"], run: roll(-STEP) },
    { group: "View", name: "Roll right 5°", keys: ["r"], run: roll(STEP) },
  );
}
