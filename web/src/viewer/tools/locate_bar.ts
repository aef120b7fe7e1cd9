// Lists and selects the objects that contain the sample at the crosshair.
import { html } from "../../shared/dom";
import { isSuperseded } from "../api/api";
import type { ViewerContext } from "../context/viewer_context";
import type { Triple } from "../state/grid";
import { locate, type Located } from "../api/locate";
import { colourOf, titleOf } from "../api/entries";

/** milliseconds after the last move of the crosshair */
const DELAY = 200;
const MAX_LISTED = 6;

export class LocateBar {
  readonly element = html("span", { class: "located" });
  private timer = 0;

  constructor(private readonly context: ViewerContext) {}

  /** Lists the objects, after a delay. */
  update(voxel: Triple): void {
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => void this.locateNow(voxel), DELAY);
  }

  /** Selects the innermost visible object that contains the sample; if there is none, shows the innermost of the page. */
  async pick(voxel: Triple): Promise<void> {
    clearTimeout(this.timer);
    const located = await this.locateNow(voxel);
    if (!located) return;
    const [first] = [...located.shown, ...located.entries];
    if (first === undefined) this.context.notify("no listed object contains this sample");
    else this.select(first);
  }

  private select(entry: number): void {
    this.context.editor.add(entry);
    this.context.notify("");
  }

  private async locateNow(voxel: Triple): Promise<Located | null> {
    const { api, page, history } = this.context;
    try {
      const located = await locate(api, page, history.now, voxel);
      this.list([...new Set([...located.shown, ...located.entries])], new Set(located.shown));
      return located;
    } catch (error) {
      if (!isSuperseded(error)) this.context.reportError(error);
      return null;
    }
  }

  private list(entries: number[], shown: Set<number>): void {
    const { page } = this.context;
    const chips = entries.slice(0, MAX_LISTED).map((entry) => {
      const title = titleOf(page, entry);
      const swatch = html("span", { class: "swatch", style: `background:${colourOf(page, entry)}` });
      const hint = shown.has(entry) ? `select ${title}` : `show ${title}`;
      return html(
        "button",
        { type: "button", class: shown.has(entry) ? "chip on" : "chip", title: hint, click: () => this.select(entry) },
        swatch,
        title,
      );
    });
    const more = entries.length - MAX_LISTED;
    this.element.replaceChildren(
      entries.length > 0 ? "in " : "in no listed object",
      ...chips,
      ...(more > 0 ? [`and ${more} more`] : []),
    );
  }
}
