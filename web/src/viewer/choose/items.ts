// An object in a list: as a row, or as a card with its picture. A click shows it alone; with shift, or by its box, it is added.
import { html } from "../../dom";
import { value, volume } from "../../format";
import { placeOf, rangeOf, reasonOf, shapeOf } from "../../names";
import { rangeBar } from "../../overview";
import { entryOf, type Page } from "../../page";
import type { Pictures } from "../ask/pictures";
import { branchOfShown, colourOf, EVERYTHING, titleOf } from "../ask/shown";

export interface Item {
  element: HTMLElement;
  /** is it in the scene? */
  box: HTMLInputElement;
  button: HTMLButtonElement;
}

export interface Chooser {
  isolate(number: number): void;
  /** adds it, or takes it out */
  toggle(number: number): void;
}

export function row(page: Page, i: number, chooser: Chooser): Item {
  const swatch = html("span", { class: "swatch", style: `background:${colourOf(page, i)}` });
  const words = html("span", {}, html("b", {}, titleOf(page, i)), ` ${about(page, i).join(", ")}`);
  const { box, button } = controls(page, i, chooser, swatch, words);
  return { element: html("li", {}, box, button), box, button };
}

export function card(page: Page, i: number, chooser: Chooser, pictures: Pictures): Item {
  const lines = cardLines(page, i).map((line) => html("span", { class: "about" }, ` ${line}`));
  const { box, button } = controls(page, i, chooser, html("b", {}, titleOf(page, i)), ...lines);
  const picture = pictures.placeOf(i);
  picture.addEventListener("click", (event) => choose(event, i, chooser));
  const branch = branchOfShown(page, i);
  const bar = branch ? html("div", { class: "bar", title: `on its own: ${rangeOf(branch)}` }, rangeBar(page, i)) : null;
  const add = html("label", { class: "add" }, box);
  const element = html("li", { class: "card", style: `--colour:${colourOf(page, i)}` }, picture, bar, add, button);
  return { element, box, button };
}

function controls(page: Page, i: number, chooser: Chooser, ...words: Node[]): { box: HTMLInputElement; button: HTMLButtonElement } {
  const box = html("input", { type: "checkbox", "aria-label": `show ${titleOf(page, i).toLowerCase()}`, change: () => chooser.toggle(i) });
  return { box, button: html("button", { type: "button", click: (event) => choose(event, i, chooser) }, ...words) };
}

function choose(event: Event, i: number, chooser: Chooser): void {
  if ((event as MouseEvent).shiftKey) chooser.toggle(i);
  else chooser.isolate(i);
}

/** What is said of an object in a line, the most telling first. */
function about(page: Page, i: number): string[] {
  if (i === EVERYTHING) return ["at one isovalue"];
  const entry = entryOf(page, i);
  const parts = [`at ${value(entry.tau)}`, volume(entry.measure, page.volume.unit), shapeOf(page, i), reasonOf(page, i), placeOf(page, i)];
  return parts.filter((part) => part !== "");
}

/** The same for a card, shorter: it has tunnels and cavities only where it says so. */
function cardLines(page: Page, i: number): string[] {
  if (i === EVERYTHING) return about(page, i);
  const entry = entryOf(page, i);
  const reason = reasonOf(page, i);
  const shape = entry.tunnels + entry.cavities > 0 ? shapeOf(page, i) : "";
  const parts = [volume(entry.measure, page.volume.unit), `at ${value(entry.tau)}${reason ? `: ${reason}` : ""}`, shape, placeOf(page, i)];
  return parts.filter((part) => part !== "");
}
