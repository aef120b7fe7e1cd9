// Branch decomposition of the chosen objects over the isovalue, with a limit of branches; subtrees can be folded.
import { Axis } from "../../shared/axis";
import { html, svg } from "../../shared/dom";
import { count, plural } from "../../shared/format";
import { describe, entriesOf } from "../../shared/names";
import { keptParent, overview, sideMargin } from "../../shared/overview";
import { branchOf, entryOf, type Page } from "../../shared/page";
import type { Catalogue } from "../api/catalogue";
import { NOTHING_FOUND, type SearchResult } from "./object_search";
import type { ObjectSelector } from "./items";
import { branchOfShown } from "../api/entries";
import type { State } from "../state/state";
import { foldedAway, TreeKeys } from "./tree_keys";

const FIRST = 40;
const MAX = 300;
const HOW_TO_READ = "A line is an object from its appearance (right) to its merge (left); cavities the other way round.";

export class TreeTab {
  private readonly budget = html("input", { type: "range", min: 1, max: FIRST, value: FIRST, "aria-label": "number of branches" });
  private readonly words = html("p", { class: "small", role: "status" });
  private readonly place = html("div", { class: "tree" });
  readonly panel = html("div", {}, html("label", { class: "budget" }, "branches ", this.budget), this.words, this.place);
  /** positions in page.branches whose subtrees are hidden */
  private readonly folded = new Set<number>();
  private found: SearchResult = NOTHING_FOUND;
  private state: State | null = null;
  private width = 0;
  private readonly keys: TreeKeys;

  constructor(
    private readonly page: Page,
    private readonly catalogue: Catalogue,
    private readonly selector: ObjectSelector,
  ) {
    this.keys = new TreeKeys(this.place, (number, on) => this.fold(entryOf(page, number).branch, on));
    this.budget.addEventListener("input", () => this.draw());
    new ResizeObserver(() => this.resize()).observe(this.place);
  }

  fill(found: SearchResult): void {
    this.found = found;
    const before = Number(this.budget.value) === Number(this.budget.max);
    const all = this.branches().length;
    this.budget.max = String(Math.max(1, Math.min(all, MAX)));
    if (before) this.budget.value = String(Math.min(all, FIRST));
    this.draw();
  }

  mark(state: State): void {
    this.state = state;
    const shown = state.shown[state.selected];
    const selected = shown && branchOfShown(this.page, shown.entry) ? entryOf(this.page, shown.entry).branch : -1;
    for (const line of this.place.querySelectorAll<SVGElement>("[data-branch]")) {
      line.classList.toggle("selected", Number(line.dataset.branch) === selected);
    }
    for (const mark of this.place.querySelectorAll<SVGElement>("[data-entry]")) {
      const number = Number(mark.dataset.entry);
      mark.setAttribute("aria-selected", String(number === shown?.entry));
      mark.classList.toggle("shown", state.shown.some(({ entry }) => entry === number));
    }
    this.markTau(shown?.tau ?? null);
    this.keys.setTabStop(shown?.entry ?? -1);
  }

  /** Positions in page.branches by rank; objects of the scene first. */
  private branches(): number[] {
    const { objects, cavities, others } = this.found;
    const places = (numbers: number[]): number[] => {
      const found = [...new Set(numbers.map((i) => entryOf(this.page, i).branch))];
      return found.sort((p, q) => branchOf(this.page, p).rank - branchOf(this.page, q).rank);
    };
    return [...new Set([...places(others), ...places(objects), ...places(cavities)])];
  }

  private resize(): void {
    const width = Math.floor(this.place.clientWidth);
    if (width === this.width) return;
    this.width = width;
    this.draw();
  }

  private draw(): void {
    const { width } = this;
    if (width < 50) return; // hidden
    const all = this.branches();
    const budget = Math.min(Number(this.budget.value), MAX);
    const wanted = new Set(all.slice(0, budget));
    const kept = new Set([...wanted].filter((b) => !foldedAway(this.page, wanted, this.folded, b)));
    this.showCount(all.length, wanted.size, kept.size);
    const drawing = overview(this.page, kept, (i) => this.selector.isolate(i), width);
    drawing.setAttribute("role", "tree");
    const axis = Axis.of(this.page, width, sideMargin);
    for (const b of kept) if (entriesOf(this.page, b).length === 0) this.dot(drawing, axis, b);
    const parents = new Set([...wanted].map((b) => keptParent(this.page, wanted, b)));
    for (const b of kept) if (parents.has(b)) this.foldSign(drawing, b);
    this.place.replaceChildren(drawing);
    this.keys.update(this.page, kept, wanted, this.folded);
    if (this.state) this.mark(this.state);
  }

  private showCount(all: number, wanted: number, kept: number): void {
    const drawn = all === wanted ? `${plural(all, "branch", "branches")}` : `the ${count(wanted)} most important of ${count(all)} branches`;
    const hidden = kept < wanted ? `, ${count(wanted - kept)} of them folded` : "";
    this.words.textContent = `${drawn}${hidden}. ${HOW_TO_READ}`;
    this.budget.setAttribute("aria-valuetext", drawn);
  }

  /** A branch without an entry is drawn as a dot just above its merge. */
  private dot(drawing: SVGElement, axis: Axis, b: number): void {
    const number = this.catalogue.numberOfBranch(b);
    const line = drawing.querySelector(`[data-branch="${b}"]`);
    if (number === undefined || !line) return;
    const { tau, colour } = entryOf(this.page, number);
    const y = line.getAttribute("y1") ?? 0;
    const words = describe(this.page, number);
    const choose = (): void => this.selector.isolate(number);
    const mark = svg("g", { class: "mark dot", "data-entry": number, "aria-label": words, click: choose });
    mark.append(svg("title", {}, words), svg("circle", { cx: axis.x(tau), cy: y, r: 5, fill: colour }));
    drawing.append(mark);
  }

  private foldSign(drawing: SVGElement, b: number): void {
    const y = Number(drawing.querySelector(`[data-branch="${b}"]`)?.getAttribute("y1") ?? 0);
    const on = this.folded.has(b);
    const sign = svg("g", { class: "fold", click: () => this.fold(b, !on) });
    sign.append(
      svg("title", {}, on ? "unfold" : "fold"),
      svg("rect", { x: 0, y: y - 10, width: sideMargin, height: 20 }),
      svg("path", { d: on ? `M4 ${y - 5}L11 ${y}L4 ${y + 5}Z` : `M2 ${y - 4}H12L7 ${y + 4}Z` }),
    );
    drawing.append(sign);
  }

  private fold(b: number, on: boolean): void {
    if (on) this.folded.add(b);
    else this.folded.delete(b);
    this.draw();
  }

  private markTau(tau: number | null): void {
    const drawing = this.place.querySelector("svg");
    drawing?.querySelector(".needle")?.remove();
    if (!drawing || tau === null) return;
    const { width, height } = drawing.viewBox.baseVal;
    const x = Axis.of(this.page, width, sideMargin).x(tau);
    drawing.append(svg("line", { class: "needle", x1: x, x2: x, y1: 0, y2: height - 36 }));
  }
}
