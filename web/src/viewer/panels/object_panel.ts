// The selected object: its measures, its range of isovalues, and its relations to other objects, as links.
import { html } from "../../shared/dom";
import { plural, value, volume } from "../../shared/format";
import { placeOf, rangeOf, shapeOf } from "../../shared/names";
import { entryOf } from "../../shared/page";
import { countsVoxels } from "../../shared/units";
import type { ViewerContext } from "../context/viewer_context";
import { Latest } from "../api/latest";
import { measuredFacts, isMeasuredAtEntry } from "./object_measures";
import { branchOfShown, EVERYTHING } from "../api/entries";
import { RelationList } from "./relation_list";
import type { Shown, State } from "../state/state";
import { UNIT } from "../state/unit";
import { TitleEditor } from "./title_editor";

type Fact = [name: string, what: (Node | string)[]];

const MAX_ISOVALUES = 8;

export class ObjectPanel {
  readonly element: HTMLElement;
  private readonly title: TitleEditor;
  private readonly facts = html("dl", {});
  private readonly relations: RelationList;
  private readonly here = html("dl", { class: "here" });
  private readonly measured: Latest<Shown>;
  private entry = NaN;
  private isMeasured = false;

  constructor(private readonly context: ViewerContext) {
    this.measured = new Latest((shown) => this.measure(shown));
    this.title = new TitleEditor(context);
    this.relations = new RelationList(context);
    const parts = [this.title.element, this.here, this.facts, this.relations.element];
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
        : [...this.isovalueFacts(i), ...(isMeasured ? [] : this.bestFacts(i)), ...this.placeFacts(i)],
    );
    this.relations.show(i);
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
    const more = (branch?.isovalues ?? []).slice(0, MAX_ISOVALUES);
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

  /** Where nothing of the page is around it to link to. */
  private placeFacts(i: number): Fact[] {
    const { page } = this.context;
    const entry = entryOf(page, i);
    return entry.inside < 0 && entry.around < 0 && placeOf(page, i) ? [["place", [placeOf(page, i)]]] : [];
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
}

function unitOf(unit: string | null): string {
  return unit ? ` ${unit}` : "";
}

function fill(list: HTMLElement, facts: Fact[]): void {
  list.replaceChildren(...facts.flatMap(([name, what]) => [html("dt", {}, name), html("dd", {}, ...what)]));
}
