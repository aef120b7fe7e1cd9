// How many objects are kept, sorting and filtering.
import { firstChoice, orders, pictured, type Choice } from "./choice";
import { html } from "./dom";
import { count } from "./format";
import type { Page } from "./page";

export interface Controls {
  /** null: there is one object */
  keep: HTMLElement | null;
  filter: HTMLElement;
}

export function controls(page: Page, changed: (choice: Choice) => void): Controls {
  const first = firstChoice(page);
  const order = html("select", { name: "order" }, ...orders.map(([name]) => html("option", { value: name }, name)));
  const side = html("select", { name: "side" }, ...["all", "bright", "dark"].map((name) => html("option", { value: name }, name)));
  const least = html("input", { type: "number", name: "least", min: 0, step: 1, value: 0, inputmode: "numeric" });
  const keep = html("input", { type: "range", name: "keep", min: 1, max: Math.max(1, page.branches.length), step: 1, value: first.keep });
  const said = html("strong", {});
  const reset = html("button", { type: "button", class: "copy" }, "Automatic");
  const update = (): void => {
    said.textContent = count(Number(keep.value));
    keep.setAttribute("aria-valuetext", `${keep.value} of ${page.branches.length} objects`);
    changed({ keep: Number(keep.value), order: order.value, side: side.value as Choice["side"], least: Number(least.value) || 0 });
  };
  for (const input of [order, side, least, keep]) input.addEventListener("input", update);
  reset.addEventListener("click", () => {
    keep.value = String(pictured(page));
    update();
  });
  said.textContent = count(first.keep);
  const both = new Set(page.branches.map((branch) => branch.side)).size > 1;
  return {
    keep:
      page.branches.length > 1
        ? html("div", { class: "keep" }, html("label", {}, html("span", {}, "Keep the ", said, " most important"), keep), reset)
        : null,
    filter: html(
      "form",
      { class: "controls", submit: (event) => event.preventDefault() },
      html("label", {}, "Sort by ", order),
      both ? html("label", {}, "Show ", side) : null,
      html("label", {}, "At least ", least, " voxels"),
    ),
  };
}
