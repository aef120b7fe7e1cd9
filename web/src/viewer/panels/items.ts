// An object in a list, as a row or a card with a picture. A click isolates it; shift-click or its checkbox adds it.
import { alsoAt } from "../../shared/cards";
import { html } from "../../shared/dom";
import { value, volume } from "../../shared/format";
import { placeOf, rangeOf, reasonOf, shapeOf, valuesOf } from "../../shared/names";
import { rangeBar } from "../../shared/overview";
import { entryOf, type Page } from "../../shared/page";
import type { Pictures } from "../api/pictures";
import { branchOfShown, colourOf, EVERYTHING, titleOf } from "../api/entries";

export interface Item {
  element: HTMLElement;
  /** checked: in the scene */
  box: HTMLInputElement;
  button: HTMLButtonElement;
}

export interface ObjectSelector {
  isolate(number: number): void;
  /** adds or removes it */
  toggle(number: number): void;
}

export function row(page: Page, i: number, selector: ObjectSelector): Item {
  const swatch = html("span", { class: "swatch", style: `background:${colourOf(page, i)}` });
  const words = html("span", {}, html("b", {}, titleOf(page, i)), ` ${about(page, i).join(", ")}`);
  const { box, button } = controls(page, i, selector, swatch, words);
  return { element: html("li", {}, box, button), box, button };
}

export function card(page: Page, i: number, selector: ObjectSelector, pictures: Pictures): Item {
  const lines = cardLines(page, i).map((line) => html("span", { class: "about" }, ` ${line}`));
  const { box, button } = controls(page, i, selector, html("b", {}, titleOf(page, i)), ...lines);
  const picture = pictures.placeOf(i);
  picture.addEventListener("click", (event) => choose(event, i, selector));
  const branch = branchOfShown(page, i);
  const bar = branch ? html("div", { class: "bar", title: `exists: ${rangeOf(branch, page)}` }, rangeBar(page, i)) : null;
  const also = html("span", { class: "also" }, ...alsoLines(page, i, selector));
  const add = html("label", { class: "add" }, box);
  const element = html("li", { class: "card", style: `--colour:${colourOf(page, i)}` }, picture, bar, add, button, also);
  return { element, box, button };
}

/** Its lines at other isovalues, where it looks much the same: a click isolates one. */
function alsoLines(page: Page, i: number, selector: ObjectSelector): HTMLElement[] {
  if (i === EVERYTHING || i >= page.entries.length) return [];
  return alsoAt(page, i).flatMap(({ tau, why, entry }) => {
    if (entry === undefined) return [];
    const click = (event: Event): void => choose(event, entry, selector);
    return [html("button", { type: "button", title: why, click }, `also at ${value(tau)}: ${titleOf(page, entry).toLowerCase()}`)];
  });
}

function controls(page: Page, i: number, selector: ObjectSelector, ...words: Node[]): { box: HTMLInputElement; button: HTMLButtonElement } {
  const box = html("input", { type: "checkbox", "aria-label": `show ${titleOf(page, i).toLowerCase()}`, change: () => selector.toggle(i) });
  return { box, button: html("button", { type: "button", click: (event) => choose(event, i, selector) }, ...words) };
}

function choose(event: Event, i: number, selector: ObjectSelector): void {
  if ((event as MouseEvent).shiftKey) selector.toggle(i);
  else selector.isolate(i);
}

/** "at 300"; of a page of both "values at most 300". */
function isovalueOf(page: Page, i: number): string {
  return `${page.polarity === "both" ? "values" : "at"} ${valuesOf(page, i)}`;
}

/** Facts of a row, most important first. */
function about(page: Page, i: number): string[] {
  if (i === EVERYTHING) return ["at one isovalue"];
  const entry = entryOf(page, i);
  const parts = [isovalueOf(page, i), volume(entry.measure, page.volume.unit), shapeOf(page, i), reasonOf(page, i), placeOf(page, i)];
  return parts.filter((part) => part !== "");
}

/** Facts of a card; tunnels and cavities only if there are any. */
function cardLines(page: Page, i: number): string[] {
  if (i === EVERYTHING) return about(page, i);
  const entry = entryOf(page, i);
  const reason = reasonOf(page, i);
  const shape = entry.tunnels + entry.cavities > 0 ? shapeOf(page, i) : "";
  const isovalue = `${isovalueOf(page, i)}${reason ? ` (${reason})` : ""}`;
  const parts = [volume(entry.measure, page.volume.unit), isovalue, shape, placeOf(page, i), entry.border ?? ""];
  return parts.filter((part) => part !== "");
}
