// Where one looks from, the edges of the volume, and the cut: actions and what stands over the picture for them.
import { html } from "../dom";
import type { Page } from "../page";
import type { Desk } from "./desk";
import { VIEWS } from "./eye";
import { ScaleBar } from "./scale_bar";

const ANGLE = Math.PI / 24;

export function look({ page, stage, actions, overlay }: Desk): void {
  const bar = new ScaleBar(page.volume.unit);
  stage.onDraw(() => bar.show(stage.eye.height, stage.canvas.clientHeight));
  const cut = html("input", { class: "cut", type: "range", min: 0, max: 1, step: 0.01, hidden: true, "aria-label": "where it is cut open" });
  cut.addEventListener("input", () => stage.slide(Number(cut.value)));
  overlay.append(bar.element, cut);
  const open = (): void => {
    stage.open(!stage.isOpen);
    cut.hidden = !stage.isOpen;
    cut.value = "0.5";
  };
  let framed = false;
  const frame = (): void => {
    framed = !framed;
    stage.frame(framed ? cornersOf(page) : null);
  };
  const turn = (name: string, key: string, around: number, up: number): void =>
    actions.add({ group: "Look", name, keys: [key], run: () => stage.eye.turn(around, up) });
  actions.add({ group: "Look", name: "all that is shown in the middle", keys: ["f"], run: () => stage.fit() });
  turn("turn left", "ArrowLeft", -ANGLE, 0);
  turn("turn right", "ArrowRight", ANGLE, 0);
  turn("turn up", "ArrowUp", 0, ANGLE);
  turn("turn down", "ArrowDown", 0, -ANGLE);
  for (const [key, direction] of Object.entries(VIEWS)) {
    const way = key === key.toLowerCase() ? "along" : "against";
    actions.add({ group: "Look", name: `look ${way} ${key.toLowerCase()}`, keys: [key], run: () => stage.eye.along(direction) });
  }
  actions.add(
    { group: "Look", name: "without perspective", keys: ["o"], run: () => stage.eye.toggleFlat(), isOn: () => stage.eye.isFlat },
    { group: "Look", name: "edges of the volume", keys: ["b"], run: frame, isOn: () => framed },
    { group: "Look", name: "cut everything open, from where you look", keys: ["c"], run: open, isOn: () => stage.isOpen },
  );
}

/** Of the box of samples, physical; bit a of a corner's number: the far end of axis a. */
function cornersOf({ volume }: Page): [number, number, number][] {
  return [0, 1, 2, 3, 4, 5, 6, 7].map((corner) => {
    const steps = [0, 1, 2].map((axis) => (corner & (1 << axis) ? (volume.size[axis] ?? 1) - 1 : 0) * (volume.spacing?.[axis] ?? 1));
    const at = (row: number): number => (volume.origin[row] ?? 0) + steps.reduce((sum, step, axis) => sum + (volume.direction[row]?.[axis] ?? 0) * step, 0);
    return [at(0), at(1), at(2)];
  });
}
