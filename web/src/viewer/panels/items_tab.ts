// The chosen objects as cards or rows; long lists are filled in chunks.
import { html } from "../../shared/dom";
import { count } from "../../shared/format";
import type { SearchResult } from "./object_search";
import type { Item } from "./items";
import { EVERYTHING } from "../api/entries";
import type { State } from "../state/state";

const PIECE = 60;
/** pixels around a revealed item */
const MARGIN = 10;

export class ItemsTab {
  readonly panel = html("div", { class: "items" });
  private readonly items = new Map<number, Item>();
  private state: State | null = null;

  /** kind: layout of the lists */
  constructor(
    private readonly kind: "cards" | "rows",
    private readonly make: (number: number) => Item,
  ) {}

  fill({ objects, cards, background, cavities, others, everything }: SearchResult): void {
    const isOpen = cards.length === 0 || this.panel.querySelector("details.field")?.hasAttribute("open") === true;
    const field = this.kind === "rows" || background.length === 0 ? [] : [foldedField(this.listOf(background), isOpen)];
    this.panel.replaceChildren(
      this.listOf([...(this.kind === "rows" ? objects : cards), ...(everything ? [EVERYTHING] : [])]),
      ...(others.length > 0 ? [html("h2", {}, "In the scene, but not listed"), this.listOf(others)] : []),
      ...(cavities.length > 0 ? [html("h2", {}, "Cavities"), this.listOf(cavities)] : []),
      ...field,
    );
  }

  /** Items are made anew by the next fill(). */
  forget(): void {
    this.items.clear();
  }

  mark(state: State): void {
    const selected = state.shown[state.selected]?.entry;
    const before = this.state?.shown[this.state.selected]?.entry;
    this.state = state;
    const inScene = new Set(state.shown.map(({ entry }) => entry));
    for (const [number, { element, box, button }] of this.items) {
      box.checked = inScene.has(number);
      element.classList.toggle("selected", number === selected);
      if (number === selected) button.setAttribute("aria-current", "true");
      else button.removeAttribute("aria-current");
    }
    const item = selected === before ? undefined : this.items.get(selected ?? NaN);
    if (item) this.reveal(item.element);
  }

  /** Scrolls only the panel: on phones, where the whole page scrolls, the viewport must stay. */
  private reveal(element: HTMLElement): void {
    const [own, panel] = [element.getBoundingClientRect(), this.panel.getBoundingClientRect()];
    if (getComputedStyle(this.panel).overflowY !== "auto") return;
    if (own.top < panel.top || own.height > panel.height) this.panel.scrollTop -= panel.top - own.top + MARGIN;
    else if (own.bottom > panel.bottom) this.panel.scrollTop += own.bottom - panel.bottom + MARGIN;
  }

  private listOf(numbers: number[]): HTMLElement {
    const list = html("ol", { class: this.kind });
    const more = html("button", { type: "button", class: "more" });
    let done = 0;
    const next = (): void => {
      const piece = numbers.slice(done, done + PIECE);
      done += piece.length;
      list.append(...piece.map((number) => this.itemOf(number).element));
      if (this.state) this.mark(this.state);
      more.hidden = done === numbers.length;
      more.textContent = `${count(Math.min(PIECE, numbers.length - done))} more of ${count(numbers.length - done)}`;
    };
    more.addEventListener("click", () => {
      next();
      const first = numbers[done - 1];
      if (more.hidden && first !== undefined) this.items.get(first)?.button.focus(); // the focused button is hidden now
    });
    next();
    return html("div", {}, list, more);
  }

  private itemOf(number: number): Item {
    const item = this.items.get(number) ?? this.make(number);
    this.items.set(number, item);
    return item;
  }
}

/** The box that was scanned, more than what is in it. */
function foldedField(list: HTMLElement, open: boolean): HTMLElement {
  return html("details", { class: "field", open }, html("summary", {}, "Outline of the scanned field"), list);
}
