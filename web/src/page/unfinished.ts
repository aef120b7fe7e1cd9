// What a page says that was opened while isoatlas was still drawing.
import { html } from "../shared/dom";

export function unfinished(): HTMLElement {
  const reload = html("button", { type: "button", click: () => location.reload() }, "Reload");
  const words = "isoatlas was still drawing when this page was opened: pictures are missing, and none turns. ";
  return html("p", { class: "assumed" }, words, reload);
}
