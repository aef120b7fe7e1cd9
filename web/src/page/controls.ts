// Controls for the number of objects, their order and filters.
import { firstChoice, pictured, type Choice } from "./choice";
import { html } from "../shared/dom";
import { count } from "../shared/format";
import { orders } from "../shared/orders";
import type { Page } from "../shared/page";

const SIDES: [Choice["side"], string][] = [["all", "all"], ["object", "objects"], ["cavity", "cavities"]];
const POLARITIES: [Choice["side"], string][] = [["all", "all"], ["high", "high values"], ["low", "low values"]];

export interface Controls {
  /** null: there is only one object */
  keep: HTMLElement | null;
  filter: HTMLElement;
}

export function controls(page: Page, changed: (choice: Choice) => void): Controls {
  const first = firstChoice(page);
  const order = html("select", { name: "order" }, ...orders.map(([name]) => html("option", { value: name }, name)));
  const sides = page.polarity === "both" ? POLARITIES : SIDES;
  const side = html("select", { name: "side" }, ...sides.map(([name, text]) => html("option", { value: name }, text)));
  const minVoxels = html("input", { type: "number", name: "min-voxels", min: 0, step: 1, value: 0, inputmode: "numeric" });
  const keep = html("input", { type: "range", name: "keep", min: 1, max: Math.max(1, page.branches.length), step: 1, value: first.keep });
  const shown = html("strong", {});
  const reset = html("button", { type: "button", class: "copy" }, "Automatic");
  const update = (): void => {
    shown.textContent = count(Number(keep.value));
    keep.setAttribute("aria-valuetext", `${keep.value} of ${page.branches.length} objects`);
    changed({ keep: Number(keep.value), order: order.value, side: side.value as Choice["side"], minVoxels: Number(minVoxels.value) || 0 });
  };
  for (const input of [order, side, minVoxels, keep]) input.addEventListener("input", update);
  reset.addEventListener("click", () => {
    keep.value = String(pictured(page));
    update();
  });
  shown.textContent = count(first.keep);
  const both = new Set(page.branches.map((branch) => `${branch.side} ${branch.polarity ?? ""}`)).size > 1;
  return {
    keep:
      page.branches.length > 1
        ? html("div", { class: "keep" }, html("label", {}, html("span", {}, "Show the ", shown, " most important"), keep), reset)
        : null,
    filter: html(
      "form",
      { class: "controls", submit: (event) => event.preventDefault() },
      html("label", {}, "Sort by ", order),
      both ? html("label", {}, "Show ", side) : null,
      html("label", {}, "At least ", minVoxels, " voxels"),
    ),
  };
}
