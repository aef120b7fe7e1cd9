// The selected object: its measures, its range of isovalues, and its relations to other objects, as links.
import { html } from "../../shared/dom";
import { count, plural, value, volume } from "../../shared/format";
import { contentsOf, entriesOf, inOrderOfMerges, placeOf, rangeOf, shapeOf } from "../../shared/names";
import { branchOf, entryOf } from "../../shared/page";
import { countsVoxels } from "../../shared/units";
import type { ViewerContext } from "../context/viewer_context";
import { Latest } from "../api/latest";
import { measuredFacts, isMeasuredAtEntry } from "./object_measures";
import { branchOfShown, EVERYTHING, titleOf } from "../api/entries";
import type { Shown, State } from "../state/state";
import { UNIT } from "../state/unit";
import { TitleEditor } from "./title_editor";

type Fact = [name: string, what: (Node | string)[]];

const MAX_LINKS = 8;

export class ObjectPanel {
  readonly element: HTMLElement;
  private readonly title: TitleEditor;
  private readonly facts = html("dl", {});
  private readonly here = html("dl", { class: "here" });
  private readonly measured: Latest<Shown>;
  private entry = NaN;
  private isMeasured = false;

  constructor(private readonly context: ViewerContext) {
    this.measured = new Latest((shown) => this.measure(shown));
    this.title = new TitleEditor(context);
    const parts = [this.title.element, this.here, this.facts];
    this.element = html("section", { class: "object", "aria-label": "selected object", hidden: true }, ...parts);
  }

  /** Titles have changed. */
  renew(state: State): void {
    const shown = state.shown[state.selected];
    if (shown) this.describe(shown.entry, this.isMeasured);
  }

  show(state: State, dragging: boolean): void {
    const shown = state.shown[state.selected];
    this.element.hidden = !shown;
    if (!shown) return;
    const isMeasured = isMeasuredAtEntry(this.context.page, shown);
    if (shown.entry !== this.entry) this.here.replaceChildren();
    if (shown.entry !== this.entry || isMeasured !== this.isMeasured) this.describe(shown.entry, isMeasured);
    this.entry = shown.entry;
    this.isMeasured = isMeasured;
    if (dragging) return;
    this.measured.request(shown, `${shown.entry} ${shown.tau} ${UNIT.of(state)} ${this.context.api.connection.count}`);
  }

  /** isMeasured: the measures already show the object at its recommended isovalue. */
  private describe(i: number, isMeasured: boolean): void {
    this.title.show(i);
    fill(
      this.facts,
      i === EVERYTHING
        ? [["what", ["values ≥ isovalue"]]]
        : [...this.isovalueFacts(i), ...(isMeasured ? [] : this.bestFacts(i)), ...this.relations(i)],
    );
  }

  private async measure(shown: Shown): Promise<void> {
    const facts = await measuredFacts(this.context, shown);
    if (shown.entry === this.entry)
      fill(
        this.here,
        facts.map(([name, text]) => [name, [text]]),
      );
  }

  private isovalueFacts(i: number): Fact[] {
    const { page } = this.context;
    const entry = entryOf(page, i);
    const branch = branchOfShown(page, i);
    const more = (branch?.isovalues ?? []).slice(0, MAX_LINKS);
    const facts: Fact[] = [
      ["exists", branch ? [`${rangeOf(branch, page)}${unitOf(page.volume.valueUnit)}`] : []],
      ["best isovalue", [this.place(entry.tau, entry.why), entry.why ? `: ${entry.why}` : ""]],
      ["other good isovalues", more.flatMap(({ tau, why }, n) => [n > 0 ? ", " : "", this.place(tau, why)])],
    ];
    return facts.filter(([, what]) => what.length > 0);
  }

  /** Measures at its recommended isovalue. */
  private bestFacts(i: number): Fact[] {
    const { page } = this.context;
    const { measure, voxels } = entryOf(page, i);
    const { unit } = page.volume;
    return [
      ["size at best isovalue", [`${volume(measure, unit)}${countsVoxels(unit) ? "" : `, ${plural(voxels, "voxel")}`}`]],
      ["topology at best isovalue", [shapeOf(page, i)]],
    ];
  }

  /** A link to an isovalue. */
  private place(tau: number, why: string): HTMLElement {
    const { editor } = this.context;
    return html(
      "button",
      { type: "button", class: "link", title: why, "aria-label": `Go to isovalue ${value(tau)}`, click: () => editor.setIsovalue(tau) },
      value(tau),
    );
  }

  /** Related objects; links where they have an entry. */
  private relations(i: number): Fact[] {
    const { page } = this.context;
    const entry = entryOf(page, i);
    const { parent, merges } = branchOf(page, entry.branch);
    const facts: Fact[] = [];
    if (entry.inside >= 0) facts.push(["inside", [this.link(entry.inside)]]);
    if (entry.around >= 0) facts.push(["a cavity of", [this.link(entry.around)]]);
    if (entry.inside < 0 && entry.around < 0 && placeOf(page, i)) facts.push(["place", [placeOf(page, i)]]);
    facts.push(["contains", this.links(contentsOf(page, i))]);
    if (merges !== null) facts.push(["merges", [`at ${value(merges)} into `, this.branchLink(parent)]]);
    const arriving = page.branches
      .flatMap((other, b) => (other.parent === entry.branch ? [b] : []))
      .filter((b) => entriesOf(page, b).length > 0);
    inOrderOfMerges(page, arriving);
    facts.push([
      "merged objects",
      this.links(
        arriving.flatMap((b) => entriesOf(page, b).slice(0, 1)),
        (k) => ` at ${value(branchOfShown(page, k)?.merges ?? 0)}`,
      ),
    ]);
    facts.push([
      "same object at",
      this.links(
        entriesOf(page, entry.branch).filter((k) => k !== i),
        (k) => ` at ${value(entryOf(page, k).tau)}`,
      ),
    ]);
    return facts.filter(([, what]) => what.length > 0);
  }

  private branchLink(b: number): Node | string {
    const number = this.context.catalogue.numberOfBranch(b);
    return number === undefined ? "an unlisted object" : this.link(number);
  }

  private links(entries: number[], words: (k: number) => string = () => ""): (Node | string)[] {
    const shown = entries.slice(0, MAX_LINKS).flatMap((k, n) => [n > 0 ? ", " : "", this.link(k), words(k)]);
    const rest = entries.length - MAX_LINKS;
    return rest > 0 ? [...shown, ` and ${count(rest)} more`] : shown;
  }

  /** A link that adds an object to the scene and selects it. */
  private link(k: number): HTMLElement {
    const { page, editor } = this.context;
    const go = (event: Event): void => ((event as MouseEvent).shiftKey ? editor.isolate(k) : editor.add(k));
    return html(
      "button",
      {
        type: "button",
        class: "link",
        "aria-label": `Go to ${titleOf(page, k)}`,
        title: "add to the scene and select; shift-click: isolate",
        click: go,
      },
      titleOf(page, k),
    );
  }
}

function unitOf(unit: string | null): string {
  return unit ? ` ${unit}` : "";
}

function fill(list: HTMLElement, facts: Fact[]): void {
  list.replaceChildren(...facts.flatMap(([name, what]) => [html("dt", {}, name), html("dd", {}, ...what)]));
}
