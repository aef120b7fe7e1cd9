// Plays along the isovalue of what is selected: step by step, each when the one before it is seen.
import type { Desk } from "../desk/desk";
import { deltaOf } from "./stepping";
import { ownRange } from "../ask/shown";

export const SPEEDS = [1, 2, 5, 10, 20];

export class Player {
  /** steps in a second, at most */
  speed = 5;
  /** 0: it stands */
  private direction = 0;
  private run = 0;

  constructor(
    private readonly desk: Desk,
    private readonly changed: () => void,
  ) {}

  get way(): number {
    return this.direction;
  }

  toggle(direction: 1 | -1): void {
    if (this.direction === direction) this.stop();
    else void this.play(direction);
  }

  stop(): void {
    if (this.direction === 0) return;
    this.direction = 0;
    ++this.run;
    const { editor } = this.desk;
    if (editor.selected) editor.move(editor.selected.tau); // whole again
    this.changed();
  }

  /** Ends where its own range ends; beyond it, where the axis does. */
  private async play(direction: 1 | -1): Promise<void> {
    const run = ++this.run;
    const { editor, history, page, scene } = this.desk;
    const shown = editor.selected;
    if (!shown) return;
    this.direction = direction;
    this.changed();
    const [low, high] = ownRange(page, shown.entry);
    const inside = shown.tau >= low && shown.tau <= high;
    const [first, last] = inside ? [low, high] : [page.axis.low, page.axis.high];
    for (
      let tau = shown.tau + direction * deltaOf(page, history.now);
      tau >= first && tau <= last;
      tau += direction * deltaOf(page, history.now)
    ) {
      const frame = new Promise((resolve) => setTimeout(resolve, 1000 / this.speed));
      editor.move(tau, true);
      await scene.settled();
      await frame;
      if (this.run !== run) return;
      if (editor.selected?.entry !== shown.entry || Math.abs(editor.selected.tau - tau) > 1e-9 * Math.abs(tau)) break;
    }
    this.stop();
  }
}
