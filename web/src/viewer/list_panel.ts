// The objects that matter, and which of them are shown. A click isolates, with shift or the box it adds.
import { html } from "../dom";
import { plural, value, volume } from "../format";
import type { Atlas, Entry } from "./api";
import type { State } from "./state";
import { COLOURS } from "./colours";

export class ListPanel {
  readonly element: HTMLElement;
  private readonly rows: { row: HTMLElement; box: HTMLInputElement }[] = [];

  constructor(
    atlas: Atlas,
    isolate: (entry: number) => void,
    toggle: (entry: number) => void,
  ) {
    const list = html("ol", {});
    atlas.objects.forEach((entry, i) => {
      const box = html("input", { type: "checkbox", "aria-label": `show object ${i + 1}`, change: () => toggle(i) });
      const swatch = html("span", { class: "swatch", style: `background:${COLOURS[i % COLOURS.length]}` });
      const button = html("button", { type: "button", click: (event) => ((event as MouseEvent).shiftKey ? toggle(i) : isolate(i)) }, swatch, html("span", {}, html("b", {}, `Object ${i + 1}`), ` ${about(entry, atlas)}`));
      const row = html("li", {}, box, button);
      this.rows.push({ row, box });
      list.append(row);
    });
    this.element = html("nav", { class: "objects", "aria-label": "objects" }, html("h1", {}, atlas.name), html("p", {}, `${plural(atlas.objects.length, "object")} of ${plural(atlas.branches, "object")} stand out.`), list);
  }

  show(state: State): void {
    this.rows.forEach(({ row, box }, i) => {
      const at = state.shown.findIndex((shown) => shown.entry === i);
      box.checked = at >= 0;
      row.classList.toggle("selected", at >= 0 && at === state.selected);
    });
  }
}

function about(entry: Entry, atlas: Atlas): string {
  const parts = [`at ${value(entry.best)}`, volume(entry.measure, atlas.unit)];
  if (entry.tunnels > 0) parts.push(plural(entry.tunnels, "tunnel"));
  if (entry.cavities > 0) parts.push(plural(entry.cavities, "cavity", "cavities"));
  if (entry.note) parts.push(entry.note);
  return parts.join(", ");
}
