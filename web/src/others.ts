// Objects without a picture, when more are kept than have one.
import { commandList } from "./commands";
import { html } from "./dom";
import { count, plural, value, volume } from "./format";
import { rangeOf } from "./names";
import { branchOf, type Branch, type Page } from "./page";

const mostRows = 100;

/** An isovalue at which it is on its own and as large as it gets: shortly before it merges. */
export function largestAt(branch: Branch): number {
  const end = branch.merges ?? branch.appears;
  return end + (branch.appears - end) / 64;
}

function row(page: Page, branch: Branch): HTMLElement {
  return html(
    "tr",
    {},
    html("th", { scope: "row" }, String(branch.id)),
    html("td", {}, rangeOf(branch)),
    html("td", {}, volume(branch.measure, page.volume.unit)),
    html("td", {}, value(branch.hypervolume)),
    html("td", {}, branch.standsOut ? "stands out" : "noise, or tiny"),
    html("td", {}, value(largestAt(branch))),
  );
}

/** branches: without entries. */
export function others(page: Page, branches: number[]): HTMLElement | null {
  if (branches.length === 0) return null;
  const rows = branches.slice(0, mostRows).map((b) => row(page, branchOf(page, b)));
  const heads = ["name", "on its own", "size", "contrast × size", "judged", "largest at"].map((head) => html("th", { scope: "col" }, head));
  const line = `isoatlas extract ${page.volume.name}.atlas --object NAME --tau LARGEST -o object.ply`;
  return html(
    "details",
    { class: "panel others" },
    html("summary", {}, `${plural(branches.length, "more object")} without a picture`),
    html(
      "div",
      { class: "scroll", tabindex: 0, role: "region", "aria-label": "Objects without a picture" },
      html("table", {}, html("thead", {}, html("tr", {}, ...heads)), html("tbody", {}, ...rows)),
    ),
    branches.length > mostRows ? html("p", { class: "note" }, `and ${count(branches.length - mostRows)} more`) : null,
    commandList([{ name: "surface of one of them", line }]),
  );
}
