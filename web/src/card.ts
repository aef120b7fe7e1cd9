// A card for an object: how it looks, how large it is, and where its isovalues are.
import { html } from "./dom";
import { value, volume } from "./format";
import { anchorOf, describe, isDark, nameOf, placeOf, rangeOf, reasonOf, shapeOf } from "./names";
import { rangeBar } from "./overview";
import { branchOf, entryOf, type Page } from "./page";
import { turntable } from "./turntable";

export function card(page: Page, i: number, open: (i: number) => void): HTMLElement {
  const entry = entryOf(page, i);
  const title = html("button", { type: "button", class: "title" }, nameOf(page, i));
  title.addEventListener("click", () => open(i));
  const picture = entry.picture
    ? turntable(entry.picture, `Picture of ${describe(page, i)}`)
    : html("div", { class: "turntable missing" }, "no picture");
  picture.addEventListener("click", () => open(i));
  const trunk = branchOf(page, entry.branch).merges === null;
  const notes = [trunk ? "the largest object" : "", placeOf(page, i)].filter(Boolean).join(", ");
  const reason = reasonOf(page, i);
  const facts = html(
    "dl",
    { class: "facts" },
    html("dt", {}, "shown at"),
    html("dd", {}, value(entry.tau), reason ? html("span", { class: "why" }, `: ${reason}`) : null),
    html("dt", {}, "on its own"),
    html("dd", {}, rangeOf(branchOf(page, entry.branch))),
    html("dt", {}, "size"),
    html("dd", {}, volume(entry.measure, page.volume.unit)),
    html("dt", {}, "shape"),
    html("dd", {}, shapeOf(page, i)),
  );
  const item = html(
    "li",
    { class: `card ${isDark(page, i) ? "dark" : "bright"}`, id: anchorOf(page, i) },
    picture,
    html("h3", {}, title),
    notes ? html("p", { class: "note" }, notes) : null,
    rangeBar(page, i),
    facts,
  );
  item.style.setProperty("--colour", entry.colour);
  return item;
}
