// What a page says that was opened while isoatlas was still drawing.
import { html } from "../shared/dom";

/** In place of a picture. */
export function missingPicture(page: { complete?: boolean }): HTMLElement {
  return html("div", { class: "turntable missing" }, page.complete === false ? "being drawn" : "no picture");
}

export function unfinished(): HTMLElement {
  const reload = html("button", { type: "button", click: () => location.reload() }, "Reload");
  const words = "isoatlas was still drawing when this page was opened: pictures are missing, and none turns. ";
  return html("p", { class: "assumed" }, words, reload);
}
