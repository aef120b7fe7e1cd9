// The outline of the scanned field: the box of the volume more than what is in it, so it is folded away at the end of the page.
import { html } from "../shared/dom";

export interface ScannedField {
  element: HTMLElement;
  /** alone: there is nothing else to look at */
  show(cards: HTMLElement[], alone: boolean): void;
}

export function scannedField(): ScannedField {
  const list = html("ol", { class: "cards" });
  const element = html(
    "details",
    { class: "panel field" },
    html("summary", {}, "Outline of the scanned field"),
    html("p", { class: "note" }, "More than two thirds of the volume: the box that was scanned, or what is around everything."),
    list,
  );
  const show = (cards: HTMLElement[], alone: boolean): void => {
    list.replaceChildren(...cards);
    element.hidden = cards.length === 0;
    element.open = alone;
  };
  return { element, show };
}
