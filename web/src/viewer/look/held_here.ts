// What holds the sample at the crosshair: said, and selected.
import { html } from "../../dom";
import { isOvertaken } from "../ask/api";
import type { Desk } from "../desk/desk";
import type { Triple } from "../state/grid";
import { holdersOf, type Held } from "../ask/holders";
import { colourOf, titleOf } from "../ask/shown";

/** milliseconds after the crosshair has stopped */
const RESTED = 200;
const LISTED = 6;

export class HeldHere {
  readonly element = html("span", { class: "held" });
  private timer = 0;

  constructor(private readonly desk: Desk) {}

  /** Says what holds it, once the crosshair has stopped. */
  look(voxel: Triple): void {
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => void this.ask(voxel), RESTED);
  }

  /** Selects the innermost of the shown objects that hold it; where there is none, the innermost of the atlas is shown too. */
  async choose(voxel: Triple): Promise<void> {
    clearTimeout(this.timer);
    const held = await this.ask(voxel);
    if (!held) return;
    const [first] = [...held.shown, ...held.entries];
    if (first === undefined) this.desk.say("none of the objects of the atlas holds this sample");
    else this.take(first);
  }

  private take(entry: number): void {
    this.desk.editor.add(entry);
    this.desk.say("");
  }

  private async ask(voxel: Triple): Promise<Held | null> {
    const { api, page, history } = this.desk;
    try {
      const held = await holdersOf(api, page, history.now, voxel);
      this.list([...new Set([...held.shown, ...held.entries])], new Set(held.shown));
      return held;
    } catch (error) {
      if (!isOvertaken(error)) this.desk.fail(error);
      return null;
    }
  }

  private list(entries: number[], shown: Set<number>): void {
    const { page } = this.desk;
    const chips = entries.slice(0, LISTED).map((entry) => {
      const title = titleOf(page, entry);
      const swatch = html("span", { class: "swatch", style: `background:${colourOf(page, entry)}` });
      const hint = shown.has(entry) ? `select ${title}` : `show ${title}`;
      return html(
        "button",
        { type: "button", class: shown.has(entry) ? "chip on" : "chip", title: hint, click: () => this.take(entry) },
        swatch,
        title,
      );
    });
    const more = entries.length - LISTED;
    this.element.replaceChildren(
      entries.length > 0 ? "in " : "in none of the objects",
      ...chips,
      ...(more > 0 ? [`and ${more} more`] : []),
    );
  }
}
