// Brings the picture to what the state says: surfaces are asked for, put on the stage and taken away.
import { isOvertaken } from "./api";
import type { Desk } from "./desk";
import { colourOf, whichOf } from "./shown";
import type { Shown, State } from "./state";

const WHOLE = 100_000_000;
const COARSE = 20_000;

export class Scene {
  /** per entry: the isovalue of what the picture shows of it, or soon will */
  private readonly drawn = new Map<number, number>();

  constructor(private readonly desk: Desk) {}

  show(state: State, before: State): void {
    for (const old of before.shown) if (!state.shown.some((shown) => shown.entry === old.entry)) this.forget(old.entry);
    for (const shown of state.shown) void this.draw(shown, state);
  }

  private forget(entry: number): void {
    this.desk.api.leave(`surface ${entry}`);
    this.drawn.delete(entry);
    this.desk.stage.remove(entry);
  }

  /** A coarse surface first where the whole one takes longer. */
  private async draw(shown: Shown, state: State): Promise<void> {
    const { page, api, stage } = this.desk;
    const { entry, tau, opacity } = shown;
    if (this.drawn.get(entry) === tau) return stage.fade(entry, opacity);
    const first = this.drawn.size === 0 && state.view === null;
    this.drawn.set(entry, tau);
    try {
      for (const most of [COARSE, WHOLE]) {
        const mesh = await api.surface(`surface ${entry}`, tau, whichOf(page, entry), most);
        if (this.drawn.get(entry) !== tau) return;
        stage.put(entry, mesh, colourOf(page, entry), opacity, tau);
        if (first && most === COARSE) stage.fit();
        this.desk.say(mesh.coarse ? "coarse preview" : "");
        if (!mesh.coarse) break;
      }
    } catch (error) {
      if (isOvertaken(error)) return;
      this.drawn.delete(entry);
      stage.remove(entry);
      this.desk.fail(error);
    }
  }
}
