// What is selected: what it is and where, what it lies in, what lies in it, and what becomes of it; other objects as links to them.
import { html } from "../../dom";
import { count, plural, value, volume } from "../../format";
import { contentsOf, entriesOf, placeOf, rangeOf, shapeOf } from "../../names";
import { branchOf, entryOf } from "../../page";
import type { Desk } from "../desk/desk";
import { Latest } from "../ask/latest";
import { measuredFacts, tellsOfItself } from "./measured";
import { branchOfShown, EVERYTHING, titleOf } from "../ask/shown";
import type { Shown, State } from "../state/state";

type Fact = [name: string, what: (Node | string)[]];

const MOST_LINKS = 8;

export class ObjectPanel {
  readonly element: HTMLElement;
  private readonly title = html("h2", {});
  private readonly facts = html("dl", {});
  private readonly here = html("dl", { class: "here" });
  private readonly measured: Latest<Shown>;
  private entry = NaN;
  private isMeasured = false;

  constructor(private readonly desk: Desk) {
    this.measured = new Latest((shown) => this.measure(shown));
    this.element = html("section", { class: "object", "aria-label": "what is selected", hidden: true }, this.title, this.here, this.facts);
  }

  show(state: State, dragging: boolean): void {
    const shown = state.shown[state.selected];
    this.element.hidden = !shown;
    if (!shown) return;
    const isMeasured = tellsOfItself(this.desk.page, shown);
    if (shown.entry !== this.entry) this.here.replaceChildren();
    if (shown.entry !== this.entry || isMeasured !== this.isMeasured) this.describe(shown.entry, isMeasured);
    this.entry = shown.entry;
    this.isMeasured = isMeasured;
    if (!dragging) this.measured.want(shown, `${shown.entry} ${shown.tau}`);
  }

  /** isMeasured: what it is where it is best seen is already told as what it is at the isovalue it is shown at. */
  private describe(i: number, isMeasured: boolean): void {
    this.title.textContent = titleOf(this.desk.page, i);
    fill(
      this.facts,
      i === EVERYTHING
        ? [["what", ["everything at least as bright as its isovalue"]]]
        : [...this.known(i), ...(isMeasured ? [] : this.there(i)), ...this.relations(i)],
    );
  }

  private async measure(shown: Shown): Promise<void> {
    const facts = await measuredFacts(this.desk, shown);
    if (shown.entry === this.entry)
      fill(
        this.here,
        facts.map(([name, text]) => [name, [text]]),
      );
  }

  private known(i: number): Fact[] {
    const { page } = this.desk;
    const entry = entryOf(page, i);
    const branch = branchOfShown(page, i);
    const more = (branch?.isovalues ?? []).slice(0, MOST_LINKS);
    const facts: Fact[] = [
      ["on its own", branch ? [`${rangeOf(branch)}${unitOf(page.volume.valueUnit)}`] : []],
      ["best seen at", [this.place(entry.tau, entry.why), entry.why ? `: ${entry.why}` : ""]],
      ["look also at", more.flatMap(({ tau, why }, n) => [n > 0 ? ", " : "", this.place(tau, why)])],
    ];
    return facts.filter(([, what]) => what.length > 0);
  }

  /** What it is where it is best seen. */
  private there(i: number): Fact[] {
    const { page } = this.desk;
    const { measure, voxels } = entryOf(page, i);
    return [
      ["size there", [`${volume(measure, page.volume.unit)}${page.volume.unit === null ? "" : `, ${plural(voxels, "voxel")}`}`]],
      ["shape there", [shapeOf(page, i)]],
    ];
  }

  /** An isovalue that what is selected goes to. */
  private place(tau: number, why: string): HTMLElement {
    return html(
      "button",
      { type: "button", class: "link", title: why, "aria-label": `Go to isovalue ${value(tau)}`, click: () => this.desk.editor.move(tau) },
      value(tau),
    );
  }

  /** Each as links, where the other one has an entry. */
  private relations(i: number): Fact[] {
    const { page } = this.desk;
    const entry = entryOf(page, i);
    const { parent, merges } = branchOf(page, entry.branch);
    const facts: Fact[] = [];
    if (entry.inside >= 0) facts.push(["lies in", [this.link(entry.inside)]]);
    if (entry.around >= 0) facts.push(["is a cavity of", [this.link(entry.around)]]);
    if (entry.inside < 0 && entry.around < 0 && placeOf(page, i)) facts.push(["lies", [placeOf(page, i)]]);
    facts.push(["contains", this.links(contentsOf(page, i))]);
    if (merges !== null) facts.push(["merges", [`at ${value(merges)} into `, this.branchLink(parent)]]);
    const arriving = page.branches
      .flatMap((other, b) => (other.parent === entry.branch ? [b] : []))
      .filter((b) => entriesOf(page, b).length > 0);
    arriving.sort((p, q) => (branchOf(page, q).merges ?? 0) - (branchOf(page, p).merges ?? 0));
    facts.push([
      "takes in",
      this.links(
        arriving.flatMap((b) => entriesOf(page, b).slice(0, 1)),
        (k) => ` at ${value(branchOfShown(page, k)?.merges ?? 0)}`,
      ),
    ]);
    facts.push([
      "the same object",
      this.links(
        entriesOf(page, entry.branch).filter((k) => k !== i),
        (k) => ` at ${value(entryOf(page, k).tau)}`,
      ),
    ]);
    return facts.filter(([, what]) => what.length > 0);
  }

  private branchLink(b: number): Node | string {
    const number = this.desk.catalogue.numberOfBranch(b);
    return number === undefined ? "one that is not listed" : this.link(number);
  }

  private links(entries: number[], words: (k: number) => string = () => ""): (Node | string)[] {
    const shown = entries.slice(0, MOST_LINKS).flatMap((k, n) => [n > 0 ? ", " : "", this.link(k), words(k)]);
    const rest = entries.length - MOST_LINKS;
    return rest > 0 ? [...shown, ` and ${count(rest)} more`] : shown;
  }

  /** Adds it to the scene and selects it. */
  private link(k: number): HTMLElement {
    const { page, editor } = this.desk;
    const go = (event: Event): void => ((event as MouseEvent).shiftKey ? editor.isolate(k) : editor.add(k));
    return html(
      "button",
      {
        type: "button",
        class: "link",
        "aria-label": `Go to ${titleOf(page, k)}`,
        title: "add it to the scene and select it; with shift: alone",
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
