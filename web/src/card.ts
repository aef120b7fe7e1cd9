// A card for an object: how it looks, how large it is, and where its isovalues are.
import { html } from "./dom";
import { value, volume } from "./format";
import { describe, nameOf, rangeOf, shapeOf } from "./names";
import { rangeBar } from "./overview";
import type { Page } from "./page";
import { turntable } from "./turntable";

export function card(page: Page, i: number, open: (i: number) => void): HTMLElement {
  const entry = page.objects[i];
  if (!entry) throw new Error(`no object ${i}`);
  const title = html("button", { type: "button", class: "title" }, nameOf(page, i));
  title.addEventListener("click", () => open(i));
  const picture = entry.picture
    ? turntable(entry.picture, `Picture of ${describe(page, i)}`)
    : html("div", { class: "turntable missing" }, "no picture");
  picture.addEventListener("click", () => open(i));
  const facts = html(
    "dl",
    { class: "facts" },
    html("dt", {}, "best at"),
    html("dd", {}, value(entry.best)),
    html("dt", {}, "on its own"),
    html("dd", {}, rangeOf(entry)),
    html("dt", {}, "size"),
    html("dd", {}, volume(entry.measure, page.volume.unit)),
    html("dt", {}, "shape"),
    html("dd", {}, shapeOf(entry)),
  );
  const item = html("li", { class: `card ${entry.side}`, id: `object-${i + 1}` }, picture, html("h3", {}, title), entry.note ? html("p", { class: "note" }, entry.note) : null, rangeBar(page, i), facts);
  item.style.setProperty("--colour", entry.colour);
  return item;
}
