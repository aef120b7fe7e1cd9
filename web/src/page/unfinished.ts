// What a page says that was opened while isoatlas was still drawing.
import { html } from "../shared/dom";

export function unfinished(): HTMLElement {
  const reload = html("button", { type: "button", click: () => location.reload() }, "Reload");
  return html("p", { class: "assumed" }, "Still pictures only: isoatlas was drawing the rest when this page was opened. ", reload);
}
