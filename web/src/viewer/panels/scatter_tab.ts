// Filter by contrast and size: a box in the scatter plot, or four limits as numbers.
import { html } from "../../shared/dom";
import { count, value, volume } from "../../shared/format";
import { branchOf, entryOf, type Page } from "../../shared/page";
import type { Catalogue } from "../api/catalogue";
import { ANY, CHOICE, type Choice, type Limits } from "../state/selection";
import type { ObjectSelector } from "./items";
import { ScatterPlot } from "./scatter_plot";
import { titleOf } from "../api/entries";
import type { State } from "../state/state";

const HOW_TO_USE = "Circles: significant objects. Drag a box to filter; click a dot to isolate its object.";

export class ScatterTab {
  readonly panel: HTMLElement;
  private readonly plot: ScatterPlot;
  private readonly limits: HTMLInputElement[];
  private readonly keep = numberInput("number of most important objects", 1);
  private readonly significant = html("input", { type: "checkbox" });
  private readonly words = html("p", { class: "small" }, "Loading the objects.");
  private choice: Choice | null = null;

  /** choose(choice, transient): transient during a drag */
  constructor(
    private readonly page: Page,
    private readonly catalogue: Catalogue,
    selector: ObjectSelector,
    private readonly choose: (choice: Choice | null, transient: boolean) => void,
  ) {
    const { unit, valueUnit } = page.volume;
    const sizeUnit = unit === null ? "voxels" : `${unit}³`;
    this.plot = new ScatterPlot(
      { across: `contrast${valueUnit ? `, ${valueUnit}` : ""} →`, up: `size, ${sizeUnit} →` },
      {
        box: (contrast, size, transient) => this.choose({ ...(this.choice ?? ANY), contrast, size }, transient),
        click: (rank, add) => catalogue.numbersOfRank(rank).slice(0, 1).forEach((i) => (add ? selector.toggle(i) : selector.isolate(i))),
        nameOf: (rank) => this.nameOf(rank),
      },
    );
    this.limits = ["contrast, at least", "contrast, at most", "size, at least", "size, at most"].map((name) => numberInput(name, 0));
    for (const input of [...this.limits, this.keep, this.significant]) input.addEventListener("change", () => this.commit());
    this.panel = html(
      "div",
      { class: "scatter-tab" },
      this.plot.element,
      this.words,
      this.form(sizeUnit),
    );
  }

  /** All objects are loaded. */
  onCatalogueLoaded(): void {
    this.words.textContent = this.about();
    this.plot.setData(this.catalogue.sizes);
  }

  mark(state: State, chosen: number[]): void {
    this.choice = CHOICE.of(state);
    const rankOf = (i: number): number => (i < 0 ? -1 : this.rankOf(i));
    const shown = state.shown.map(({ entry }) => rankOf(entry));
    const ranks = new Set(chosen.map(rankOf));
    const label = `contrast and size of ${count(this.catalogue.sizes.length)} objects, ${count(ranks.size)} of them chosen`;
    const selected = shown[state.selected] ?? -1;
    this.plot.show({ choice: this.choice, chosen: ranks, shown: new Set(shown), selected }, label);
    const { contrast, size, keep, significant } = this.choice ?? ANY;
    [...contrast, ...size].forEach((limit, i) => put(this.limits[i], limit));
    put(this.keep, keep);
    this.significant.checked = significant;
  }

  private form(sizeUnit: string): HTMLElement {
    const [a, b, c, d] = this.limits as [HTMLInputElement, HTMLInputElement, HTMLInputElement, HTMLInputElement];
    const buttons = html(
      "div",
      { class: "line" },
      html("button", { type: "button", click: () => this.choose(null, false) }, "Automatic choice"),
      html("button", { type: "button", click: () => this.choose(ANY, false) }, "All objects"),
    );
    return html(
      "form",
      { class: "limits", "aria-label": "filter", submit: (event) => event.preventDefault() },
      html("span", {}, `contrast ${this.page.volume.valueUnit ?? ""}`), a, html("span", {}, "to"), b,
      html("span", {}, `size ${sizeUnit}`), c, html("span", {}, "to"), d,
      html("span", {}, "most important"), this.keep,
      html("label", { class: "wide" }, this.significant, " significant objects only"),
      buttons,
    );
  }

  private about(): string {
    const { sizes, all } = this.catalogue;
    const which = sizes.length < all ? `The ${count(sizes.length)} most important of ${count(all)} objects` : `${count(all)} objects`;
    return `${which}, a dot each: its contrast (persistence) and its size just before merging. ${HOW_TO_USE}`;
  }

  private nameOf(rank: number): string {
    const [i] = this.catalogue.numbersOfRank(rank);
    const sizes = this.catalogue.sizes[rank];
    if (i === undefined || !sizes) return "";
    return `${titleOf(this.page, i)}: contrast ${value(sizes.contrast)}, ${volume(sizes.size, this.page.volume.unit)}`;
  }

  private rankOf(i: number): number {
    const branch = branchOf(this.page, entryOf(this.page, i).branch);
    return branch.side === "object" ? branch.rank : -1;
  }

  private commit(): void {
    for (const input of [...this.limits, this.keep]) if (read(input) === null) input.value = ""; // clear invalid limits
    const [a, b, c, d] = this.limits.map(read);
    const keep = read(this.keep);
    const contrast: Limits = [a ?? null, b ?? null];
    const size: Limits = [c ?? null, d ?? null];
    const rank = keep === null ? null : Math.max(1, Math.round(keep));
    this.choose({ significant: this.significant.checked, keep: rank, contrast, size }, false);
  }
}

function numberInput(label: string, min: number): HTMLInputElement {
  return html("input", { type: "number", min: min, step: "any", placeholder: "any", "aria-label": label });
}

function read(input: HTMLInputElement): number | null {
  const number = Number(input.value);
  return input.value.trim() === "" || !Number.isFinite(number) || number < 0 ? null : number;
}

/** Shows the value of the state if it has changed; keeps text that is being typed. */
function put(input: HTMLInputElement | undefined, number: number | null): void {
  const text = number === null ? "" : String(number);
  if (!input || input.dataset.put === text) return;
  input.dataset.put = text;
  input.value = text;
}
