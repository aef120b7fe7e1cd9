// Table of objects without a picture.
import { commandList } from "../shared/commands";
import { html } from "../shared/dom";
import { count, plural, value, volume } from "../shared/format";
import { rangeOf, voxelWord } from "../shared/names";
import { branchOf, isLowOfBoth, type Branch, type Page } from "../shared/page";

const maxRows = 100;

/** An isovalue next to its merge, where the object has nearly its largest size. */
export function largestAt(branch: Branch): number {
  const end = branch.merges ?? branch.appears;
  return end + (branch.appears - end) / 64;
}

function row(page: Page, branch: Branch): HTMLElement {
  return html(
    "tr",
    {},
    html("th", { scope: "row" }, (isLowOfBoth(page, branch) ? "low" : "") + (branch.number ? String(branch.number) : voxelWord(branch.id))),
    html("td", {}, rangeOf(branch, page)),
    html("td", {}, volume(branch.measure, page.volume.unit)),
    html("td", {}, value(branch.hypervolume)),
    html("td", {}, branch.significant ? "significant" : "noise level or very small"),
    html("td", {}, value(largestAt(branch))),
  );
}

/** branches: without entries. */
export function others(page: Page, branches: number[]): HTMLElement | null {
  if (branches.length === 0) return null;
  const rows = branches.slice(0, maxRows).map((b) => row(page, branchOf(page, b)));
  const heads = ["object", "exists", "size", "contrast × size", "rating", "largest at"].map((head) => html("th", { scope: "col" }, head));
  const side = page.polarity === "low" ? " --polarity low" : "";
  const line = `isoatlas extract ${page.volume.name}.atlas${side} --object OBJECT@LARGEST -o object.ply`;
  return html(
    "details",
    { class: "panel others" },
    html("summary", {}, `${plural(branches.length, "more object")} without a picture`),
    html(
      "div",
      { class: "scroll", tabindex: 0, role: "region", "aria-label": "Objects without a picture" },
      html("table", {}, html("thead", {}, html("tr", {}, ...heads)), html("tbody", {}, ...rows)),
    ),
    branches.length > maxRows ? html("p", { class: "note" }, `and ${count(branches.length - maxRows)} more`) : null,
    commandList([{ name: "surface of one of them", line }]),
  );
}
