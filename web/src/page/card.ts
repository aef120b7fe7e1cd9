// A card for an object: its picture, its size, and the range of its isovalues.
import { alsoAt } from "../shared/cards";
import { html } from "../shared/dom";
import { value, volume } from "../shared/format";
import { anchorOf, describe, isCavity, nameOf, placeOf, rangeOf, reasonOf, shapeOf, valuesOf } from "../shared/names";
import { rangeBar } from "../shared/overview";
import { branchOf, entryOf, type Page } from "../shared/page";
import { turntable } from "../shared/turntable";
import { missingPicture } from "./unfinished";

/** The other isovalues at which it looks much the same; those with a number open. */
function others(page: Page, i: number, open: (i: number) => void): HTMLElement[] {
  const also = alsoAt(page, i);
  if (also.length === 0) return [];
  const chips = also.map(({ tau, why, entry }) => {
    if (entry === undefined) return html("li", { title: why }, value(tau));
    const [name, click] = [nameOf(page, entry), () => open(entry)];
    const link = html("button", { type: "button", class: "link", click }, `${value(tau)} (${name.toLowerCase()})`);
    return html("li", { title: `${name}: ${why}` }, link);
  });
  return [html("dt", {}, "also at"), html("dd", {}, html("ul", { class: "chips" }, ...chips))];
}

export function card(page: Page, i: number, open: (i: number) => void): HTMLElement {
  const entry = entryOf(page, i);
  const title = html("button", { type: "button", class: "title" }, nameOf(page, i));
  title.addEventListener("click", () => open(i));
  const picture = entry.picture
    ? turntable(entry.picture, `Picture of ${describe(page, i)}`)
    : missingPicture(page);
  picture.addEventListener("click", () => open(i));
  const isMain = branchOf(page, entry.branch).merges === null;
  const isChip = entry.enclosed === true;
  const largest = page.polarity !== "both" && isMain ? "the largest object" : "";
  const notes = [largest, isChip ? "" : placeOf(page, i), entry.border ?? ""].filter(Boolean).join(", ");
  const reason = reasonOf(page, i);
  const facts = html(
    "dl",
    { class: "facts" },
    html("dt", {}, page.polarity === "both" ? "values" : "isovalue"),
    html("dd", {}, valuesOf(page, i), reason ? html("span", { class: "why" }, ` (${reason})`) : null),
    ...others(page, i, open),
    html("dt", {}, "exists"),
    html("dd", {}, rangeOf(branchOf(page, entry.branch), page)),
    html("dt", {}, "size"),
    html("dd", {}, volume(entry.measure, page.volume.unit)),
    html("dt", {}, "topology"),
    html("dd", {}, shapeOf(page, i)),
  );
  const item = html(
    "li",
    { class: isCavity(page, i) ? "card cavity" : "card", id: anchorOf(page, i) },
    picture,
    html("h3", {}, title),
    isChip ? html("ul", { class: "chips" }, html("li", {}, placeOf(page, i).replace(/^a /, ""))) : null,
    notes ? html("p", { class: "note" }, notes) : null,
    rangeBar(page, i),
    facts,
  );
  item.style.setProperty("--colour", entry.colour);
  return item;
}
