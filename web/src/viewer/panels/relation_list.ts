// Related objects of the selected one, with thumbnails: the first ones, and the rest folded away.
import { html } from "../../shared/dom";
import { count } from "../../shared/format";
import type { ViewerContext } from "../context/viewer_context";
import { EVERYTHING, titleOf } from "../api/entries";
import { firstRelations, relationsOf, type Relation } from "./relations";

/** without a click */
const FIRST = 5;

export class RelationList {
  readonly element = html("div", { class: "relations" });
  private of = NaN;

  constructor(private readonly context: ViewerContext) {}

  /** Stays unfolded while it shows the same object. */
  show(i: number): void {
    const wasOpen = this.of === i && this.element.querySelector("details")?.open === true;
    this.of = i;
    const all = i === EVERYTHING ? [] : relationsOf(this.context.page, this.context.catalogue, i);
    const first = firstRelations(all, FIRST);
    const rest = all.filter((relation) => !first.includes(relation));
    this.element.hidden = all.length === 0;
    this.element.replaceChildren(html("h3", {}, "Related objects"), this.listOf(first));
    if (rest.length > 0) this.element.append(this.folded(rest, wasOpen));
  }

  /** Filled when it is opened: there may be hundreds. */
  private folded(rest: Relation[], open: boolean): HTMLElement {
    const details = html("details", { open }, html("summary", {}, `${count(rest.length)} more`));
    const fill = (): void => {
      if (details.open && details.childElementCount === 1) details.append(this.listOf(rest));
    };
    details.addEventListener("toggle", fill);
    fill();
    return details;
  }

  private listOf(relations: Relation[]): HTMLElement {
    return html("ul", {}, ...relations.map((relation) => this.item(relation)));
  }

  private item({ kind, entry, words }: Relation): HTMLElement {
    const picture = entry === undefined ? html("span", { class: "thumb" }) : this.context.pictures.thumbnailOf(entry);
    const what = entry === undefined ? "an unlisted object" : this.link(entry);
    return html("li", {}, picture, html("span", {}, html("span", { class: "kind" }, kind), " ", what, words));
  }

  /** A link that adds an object to the scene and selects it. */
  private link(k: number): HTMLElement {
    const { page, editor } = this.context;
    const title = titleOf(page, k);
    const go = (event: Event): void => ((event as MouseEvent).shiftKey ? editor.isolate(k) : editor.add(k));
    const hint = "add to the scene and select; shift-click: isolate";
    return html("button", { type: "button", class: "link", "aria-label": `Go to ${title}`, title: hint, click: go }, title);
  }
}
