// Cards, or a list, of the objects that are chosen; long ones in pieces.
import { html } from "../../dom";
import { count } from "../../format";
import type { Found } from "./found";
import type { Item } from "./items";
import { EVERYTHING } from "../ask/shown";
import type { State } from "../state/state";

const PIECE = 60;
/** pixels around what is revealed */
const MARGIN = 10;

export class ItemsTab {
  readonly panel = html("div", { class: "items" });
  private readonly items = new Map<number, Item>();
  private state: State | null = null;

  /** kind: how its lists are laid out */
  constructor(
    private readonly kind: "cards" | "rows",
    private readonly make: (number: number) => Item,
  ) {}

  fill({ bright, dark, also }: Found): void {
    this.panel.replaceChildren(
      this.listOf([...bright, EVERYTHING]),
      ...(also.length > 0 ? [html("h2", {}, "Shown, but not among these"), this.listOf(also)] : []),
      ...(dark.length > 0 ? [html("h2", {}, "Dark objects"), this.listOf(dark)] : []),
    );
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

  /** Scrolls the panel alone: where the whole page scrolls, on a phone, the picture must stay where it is. */
  private reveal(element: HTMLElement): void {
    const [own, panel] = [element.getBoundingClientRect(), this.panel.getBoundingClientRect()];
    if (getComputedStyle(this.panel).overflowY !== "auto") return;
    if (own.top < panel.top) this.panel.scrollTop -= panel.top - own.top + MARGIN;
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
      if (more.hidden && first !== undefined) this.items.get(first)?.button.focus(); // what had it is gone
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
