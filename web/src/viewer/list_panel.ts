// The objects that matter, and which of them are shown. A click isolates, with shift or the box it adds.
import { html } from "../dom";
import { plural, value, volume } from "../format";
import { isDark, placeOf, reasonOf, shapeOf } from "../names";
import { entryOf, type Page } from "../page";
import { colourOf, EVERYTHING, titleOf } from "./shown";
import type { State } from "./state";

export class ListPanel {
  readonly element: HTMLElement;
  private readonly rows: { entry: number; row: HTMLElement; box: HTMLInputElement }[] = [];

  constructor(
    private readonly page: Page,
    private readonly isolate: (entry: number) => void,
    private readonly toggle: (entry: number) => void,
  ) {
    const entries = page.entries.map((_, i) => i);
    const bright = entries.filter((i) => !isDark(page, i));
    const dark = entries.filter((i) => isDark(page, i));
    const { all } = page.objects.bright;
    this.element = html(
      "nav",
      { class: "objects", "aria-label": "objects" },
      html("h1", {}, page.volume.name),
      html("p", {}, `${plural(page.objects.bright.standingOut, "object")} of ${plural(all, "object")} stand out.`),
      this.listOf([...bright, EVERYTHING]),
      dark.length > 0 && html("h2", {}, "Dark objects"),
      dark.length > 0 && this.listOf(dark),
    );
  }

  show(state: State): void {
    for (const { entry, row, box } of this.rows) {
      const at = state.shown.findIndex((shown) => shown.entry === entry);
      box.checked = at >= 0;
      row.classList.toggle("selected", at >= 0 && at === state.selected);
    }
  }

  private listOf(entries: number[]): HTMLElement {
    return html("ol", {}, ...entries.map((i) => this.row(i)));
  }

  private row(i: number): HTMLElement {
    const title = titleOf(this.page, i);
    const box = html("input", { type: "checkbox", "aria-label": `show ${title.toLowerCase()}`, change: () => this.toggle(i) });
    const swatch = html("span", { class: "swatch", style: `background:${colourOf(this.page, i)}` });
    const chosen = (event: Event): void => ((event as MouseEvent).shiftKey ? this.toggle(i) : this.isolate(i));
    const button = html("button", { type: "button", click: chosen }, swatch, html("span", {}, html("b", {}, title), ` ${this.about(i)}`));
    const row = html("li", {}, box, button);
    this.rows.push({ entry: i, row, box });
    return row;
  }

  private about(i: number): string {
    if (i === EVERYTHING) return "at one isovalue";
    const entry = entryOf(this.page, i);
    const parts = [`at ${value(entry.tau)}`, volume(entry.measure, this.page.volume.unit), shapeOf(this.page, i), reasonOf(this.page, i), placeOf(this.page, i)];
    return parts.filter((part) => part !== "").join(", ");
  }
}
