// The objects that matter, and which of them are shown. A click isolates, with shift or the box it adds.
import { html } from "../dom";
import { plural, value, volume } from "../format";
import type { Atlas, Entry } from "./api";
import type { State } from "./state";
import { colourOf } from "./colours";

export class ListPanel {
  readonly element: HTMLElement;
  private readonly rows: { entry: number; row: HTMLElement; box: HTMLInputElement }[] = [];

  constructor(
    atlas: Atlas,
    isolate: (entry: number) => void,
    toggle: (entry: number) => void,
  ) {
    const list = html("ol", {});
    const put = (entry: number, name: string, text: string): void => {
      const box = html("input", { type: "checkbox", "aria-label": `show ${name.toLowerCase()}`, change: () => toggle(entry) });
      const swatch = html("span", { class: "swatch", style: `background:${colourOf(entry)}` });
      const chosen = (event: Event): void => ((event as MouseEvent).shiftKey ? toggle(entry) : isolate(entry));
      const button = html("button", { type: "button", click: chosen }, swatch, html("span", {}, html("b", {}, name), ` ${text}`));
      const row = html("li", {}, box, button);
      this.rows.push({ entry, row, box });
      list.append(row);
    };
    atlas.objects.forEach((entry, i) => put(i, `Object ${i + 1}`, about(entry, atlas)));
    put(-1, "All there is", "at one isovalue");
    this.element = html("nav", { class: "objects", "aria-label": "objects" }, html("h1", {}, atlas.name), html("p", {}, `${plural(atlas.objects.length, "object")} of ${plural(atlas.branches, "object")} stand out.`), list);
  }

  show(state: State): void {
    for (const { entry, row, box } of this.rows) {
      const at = state.shown.findIndex((shown) => shown.entry === entry);
      box.checked = at >= 0;
      row.classList.toggle("selected", at >= 0 && at === state.selected);
    }
  }
}

function about(entry: Entry, atlas: Atlas): string {
  const parts = [`at ${value(entry.best)}`, volume(entry.measure, atlas.unit)];
  if (entry.tunnels > 0) parts.push(plural(entry.tunnels, "tunnel"));
  if (entry.cavities > 0) parts.push(plural(entry.cavities, "cavity", "cavities"));
  if (entry.note) parts.push(entry.note);
  return parts.join(", ");
}
