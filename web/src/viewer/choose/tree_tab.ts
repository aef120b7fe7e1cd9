// The chosen objects over the isovalue, as the branches of their tree: as many as one wants to see; what merges into one may be folded.
import { Axis } from "../../axis";
import { html, svg } from "../../dom";
import { count, plural } from "../../format";
import { describe, entriesOf } from "../../names";
import { keptParent, overview, sideMargin } from "../../overview";
import { branchOf, entryOf, type Page } from "../../page";
import type { Catalogue } from "../ask/catalogue";
import type { Found } from "./found";
import type { Chooser } from "./items";
import { branchOfShown } from "../ask/shown";
import type { State } from "../state/state";
import { foldedAway, TreeKeys } from "./tree_keys";

const FIRST = 40;
const MOST = 300;
const HOW_TO_READ = "A line is an object from where it appears (right) to where it merges (left); dark ones the other way round.";

export class TreeTab {
  private readonly budget = html("input", { type: "range", min: 1, max: FIRST, value: FIRST, "aria-label": "how many branches are drawn" });
  private readonly words = html("p", { class: "small", role: "status" });
  private readonly place = html("div", { class: "tree" });
  readonly panel = html("div", {}, html("label", { class: "budget" }, "branches ", this.budget), this.words, this.place);
  /** positions in page.branches: those that merge into them are not drawn */
  private readonly folded = new Set<number>();
  private found: Found = { bright: [], dark: [], also: [] };
  private state: State | null = null;
  private width = 0;
  private readonly keys: TreeKeys;

  constructor(
    private readonly page: Page,
    private readonly catalogue: Catalogue,
    private readonly chooser: Chooser,
  ) {
    this.keys = new TreeKeys(this.place, (number, on) => this.fold(entryOf(page, number).branch, on));
    this.budget.addEventListener("input", () => this.draw());
    new ResizeObserver(() => this.resize()).observe(this.place);
  }

  fill(found: Found): void {
    this.found = found;
    const before = Number(this.budget.value) === Number(this.budget.max);
    const all = this.branches().length;
    this.budget.max = String(Math.max(1, Math.min(all, MOST)));
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
    this.keys.rest(shown?.entry ?? -1);
  }

  /** Positions in page.branches, the most important one first; what is in the scene is among the first. */
  private branches(): number[] {
    const { bright, dark, also } = this.found;
    const places = (numbers: number[]): number[] => {
      const found = [...new Set(numbers.map((i) => entryOf(this.page, i).branch))];
      return found.sort((p, q) => branchOf(this.page, p).rank - branchOf(this.page, q).rank);
    };
    return [...new Set([...places(also), ...places(bright), ...places(dark)])];
  }

  private resize(): void {
    const width = Math.floor(this.place.clientWidth);
    if (width === this.width) return;
    this.width = width;
    this.draw();
  }

  private draw(): void {
    const { width } = this;
    if (width < 50) return; // not to be seen
    const all = this.branches();
    const budget = Math.min(Number(this.budget.value), MOST);
    const wanted = new Set(all.slice(0, budget));
    const kept = new Set([...wanted].filter((b) => !foldedAway(this.page, wanted, this.folded, b)));
    this.say(all.length, wanted.size, kept.size);
    const drawing = overview(this.page, kept, (i) => this.chooser.isolate(i), width);
    drawing.setAttribute("role", "tree");
    const axis = Axis.of(this.page, width, sideMargin);
    for (const b of kept) if (entriesOf(this.page, b).length === 0) this.dot(drawing, axis, b);
    const parents = new Set([...wanted].map((b) => keptParent(this.page, wanted, b)));
    for (const b of kept) if (parents.has(b)) this.foldSign(drawing, b);
    this.place.replaceChildren(drawing);
    this.keys.take(this.page, kept, wanted, this.folded);
    if (this.state) this.mark(this.state);
  }

  private say(all: number, wanted: number, kept: number): void {
    const drawn = all === wanted ? `${plural(all, "branch", "branches")}` : `the ${count(wanted)} most important of ${count(all)} branches`;
    const hidden = kept < wanted ? `, ${count(wanted - kept)} of them folded away` : "";
    this.words.textContent = `${drawn}${hidden}. ${HOW_TO_READ}`;
    this.budget.setAttribute("aria-valuetext", drawn);
  }

  /** A branch without an entry is chosen as large as it gets. */
  private dot(drawing: SVGElement, axis: Axis, b: number): void {
    const number = this.catalogue.numberOfBranch(b);
    const line = drawing.querySelector(`[data-branch="${b}"]`);
    if (number === undefined || !line) return;
    const { tau, colour } = entryOf(this.page, number);
    const y = line.getAttribute("y1") ?? 0;
    const words = describe(this.page, number);
    const choose = (): void => this.chooser.isolate(number);
    const mark = svg("g", { class: "mark dot", "data-entry": number, "aria-label": words, click: choose });
    mark.append(svg("title", {}, words), svg("circle", { cx: axis.x(tau), cy: y, r: 5, fill: colour }));
    drawing.append(mark);
  }

  private foldSign(drawing: SVGElement, b: number): void {
    const y = Number(drawing.querySelector(`[data-branch="${b}"]`)?.getAttribute("y1") ?? 0);
    const on = this.folded.has(b);
    const sign = svg("g", { class: "fold", click: () => this.fold(b, !on) });
    sign.append(
      svg("title", {}, on ? "unfold what merges into it" : "fold away what merges into it"),
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
