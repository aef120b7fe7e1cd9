// Sorting and filtering cards.
import { html } from "./dom";
import type { Entry, Page } from "./page";

const orders: [string, (p: Entry, q: Entry) => number][] = [
  ["rank", () => 0],
  ["size", (p, q) => q.voxels - p.voxels],
  ["isovalue", (p, q) => q.best - p.best],
  ["range of isovalues", (p, q) => q.high - q.low - (p.high - p.low)],
  ["tunnels", (p, q) => q.tunnels - p.tunnels],
  ["cavities", (p, q) => q.cavities - p.cavities],
];

export type Side = "all" | "bright" | "dark";

/** Positions of the entries to show, in order. */
export function chosen(page: Page, order: string, side: Side, least: number): number[] {
  const compare = orders.find(([name]) => name === order)?.[1] ?? (() => 0);
  const kept = page.objects.flatMap((entry, i) => ((side === "all" || entry.side === side) && entry.voxels >= least ? [i] : []));
  return kept.sort((a, b) => compare(page.objects[a] as Entry, page.objects[b] as Entry) || a - b);
}

export function controls(page: Page, changed: (kept: number[]) => void): HTMLElement {
  const order = html("select", { name: "order" }, ...orders.map(([name]) => html("option", { value: name }, name)));
  const side = html("select", { name: "side" }, ...["all", "bright", "dark"].map((name) => html("option", { value: name }, name)));
  const least = html("input", { type: "number", name: "least", min: 0, step: 1, value: 0, inputmode: "numeric" });
  const update = (): void => changed(chosen(page, order.value, side.value as Side, Number(least.value) || 0));
  for (const input of [order, side, least]) input.addEventListener("input", update);
  const both = new Set(page.objects.map((entry) => entry.side)).size > 1;
  return html(
    "form",
    { class: "controls", submit: (event) => event.preventDefault() },
    html("label", {}, "Sort by ", order),
    both ? html("label", {}, "Show ", side) : null,
    html("label", {}, "At least ", least, " voxels"),
  );
}
