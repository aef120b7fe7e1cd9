// Plays along the isovalue of the selected object: each step waits until the previous surface is shown.
import type { ViewerContext } from "../context/viewer_context";
import { deltaOf } from "./isovalue_steps";
import { ownRange } from "../api/entries";

export const SPEEDS = [1, 2, 5, 10, 20];

export class Player {
  /** steps per second, at most */
  speed = 5;
  /** 0: paused */
  private playing: -1 | 0 | 1 = 0;
  private run = 0;

  constructor(
    private readonly context: ViewerContext,
    private readonly changed: () => void,
  ) {}

  get direction(): number {
    return this.playing;
  }

  toggle(direction: 1 | -1): void {
    if (this.playing === direction) this.stop();
    else void this.play(direction);
  }

  stop(): void {
    if (this.playing === 0) return;
    this.playing = 0;
    ++this.run;
    const { editor } = this.context;
    if (editor.selected) editor.setIsovalue(editor.selected.tau); // loads the full surface
    this.changed();
  }

  /** Stops at the end of the object's range; outside of it, at the end of the axis. */
  private async play(direction: 1 | -1): Promise<void> {
    const run = ++this.run;
    const { editor, history, page, scene } = this.context;
    const shown = editor.selected;
    if (!shown) return;
    this.playing = direction;
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
      editor.setIsovalue(tau, true);
      await scene.settled();
      await frame;
      if (this.run !== run) return;
      if (editor.selected?.entry !== shown.entry || Math.abs(editor.selected.tau - tau) > 1e-9 * Math.abs(tau)) break;
    }
    this.stop();
  }
}
