// Dialog of one object: containment, merges, topology over its range of isovalues, and commands.
import { Axis, drawTicks } from "../shared/axis";
import { drawCounts, Scale, type Line } from "./columns";
import { commandList } from "../shared/commands";
import { html, svg } from "../shared/dom";
import { count, plural, value, volume } from "../shared/format";
import {
  anchorOf,
  branchName,
  contentsOf,
  describe,
  entriesOf,
  inOrderOfMerges,
  isCavity,
  nameOf,
  placeOf,
  rangeOf,
  referenceOf,
  shapeOf,
  valuesOf,
  voxelWord,
} from "../shared/names";
import { rangeBar } from "../shared/overview";
import { branchOf, entryOf, isOfLowValues, type Advice, type Page } from "../shared/page";
import { legend } from "./spectrum";
import { thumbnail, turntable } from "../shared/turntable";
import { turnable, type Turnable } from "./turnable";

const maxMerges = 12;

export class Detail {
  readonly dialog = html("dialog", { class: "detail", "aria-labelledby": "detail-title" });
  private shown = 0;
  private solid: Turnable | null = null;

  constructor(private readonly page: Page) {
    this.dialog.addEventListener("click", (event) => {
      if (event.target === this.dialog) this.dialog.close();
    });
    this.dialog.addEventListener("keydown", (event) => {
      const onPicture = event.target instanceof Element && (event.target.closest(".turntable") ?? event.target.closest(".solid")) !== null;
      if (onPicture) return;
      if (event.key === "ArrowRight") this.open(this.shown + 1);
      if (event.key === "ArrowLeft") this.open(this.shown - 1);
    });
    this.dialog.addEventListener("close", () => this.solid?.dispose());
    this.dialog.addEventListener("close", () => history.replaceState(null, "", location.pathname + location.search));
  }

  open(i: number): void {
    const n = this.page.entries.length;
    if (n === 0) return;
    this.shown = ((i % n) + n) % n;
    this.solid?.dispose();
    this.dialog.replaceChildren(...this.content(this.shown));
    if (!this.dialog.open) this.dialog.showModal();
    this.dialog.scrollTop = 0;
    this.dialog.querySelector("h2")?.focus(); // the focused element may have been removed; keys must keep working
    history.replaceState(null, "", `#${anchorOf(this.page, this.shown)}`);
  }

  /** By its address, "#object-3" or "#cavity-1", or its reference, "#low2"; "#dark-1" in pages before version 0.2. */
  openAt(hash: string): void {
    const { page } = this;
    const isMeant = (k: number): boolean => [anchorOf(page, k), referenceOf(page, k)].includes(hash.slice(1).replace(/^dark-/, "cavity-"));
    const i = page.entries.findIndex((_, k) => isMeant(k));
    if (i >= 0) this.open(i);
  }

  private content(i: number): (Node | string)[] {
    const { page } = this;
    const entry = entryOf(page, i);
    const close = html("button", { type: "button", class: "close", "aria-label": "Close" }, "×");
    close.addEventListener("click", () => this.dialog.close());
    const step = (by: number, label: string): HTMLElement => {
      const button = html("button", { type: "button", "aria-label": label }, by < 0 ? "‹" : "›");
      button.addEventListener("click", () => this.open(i + by));
      return button;
    };
    return [
      html(
        "header",
        {},
        step(-1, "Previous object"),
        html("h2", { id: "detail-title", tabindex: -1 }, nameOf(page, i)),
        step(1, "Next object"),
        close,
      ),
      this.picture(i),
      html("p", {}, this.sentence(i)),
      rangeBar(page, i),
      html("dl", { class: "facts" }, ...this.facts(i).flatMap(([name, what]) => [html("dt", {}, name), html("dd", {}, ...what)])),
      this.shape(i) ?? "",
      this.tunnels(i) ?? "",
      this.merges(i) ?? "",
      html("h3", {}, "Commands"),
      commandList(entry.commands),
    ];
  }

  /** A surface that turns, else a picture. */
  private picture(i: number): HTMLElement {
    const { picture, mesh, colour } = entryOf(this.page, i);
    const label = `Picture of ${describe(this.page, i)}`;
    const still = picture ? turntable(picture, label) : html("p", {}, "no picture");
    this.solid = mesh ? turnable(still, mesh, label, colour, `${this.page.volume.name}-${anchorOf(this.page, i)}`) : null;
    return this.solid?.element ?? still;
  }

  private sentence(i: number): string {
    const { page } = this;
    const entry = entryOf(page, i);
    const branch = branchOf(page, entry.branch);
    const into =
      branch.parent >= 0
        ? branchName(page, branch.parent)
        : branch.side === "cavity"
          ? "the outside or another cavity"
          : "a larger object";
    const [low, high] = [value(entry.low), value(entry.high)];
    const shape =
      low === high
        ? `At ${value(entry.tau)} it has ${shapeOf(page, i)}.`
        : `Between ${low} and ${high} its topology is constant: ${shapeOf(page, i)}.`;
    const appears = `It appears at ${value(branch.appears)}`;
    const grows = branch.side === "cavity" ? " and grows with the isovalue" : "";
    const end =
      branch.merges === null
        ? `${appears} and never merges: it exists at every ${isOfLowValues(page, branch) ? "higher" : "lower"} isovalue.`
        : `${appears}${grows}. At ${value(branch.merges)} it merges into ${into}.`;
    return `${end} ${shape}`;
  }

  private link(i: number): HTMLElement {
    const { picture } = entryOf(this.page, i);
    const button = html("button", { type: "button", class: "link" }, picture ? thumbnail(picture) : null, nameOf(this.page, i));
    button.addEventListener("click", () => this.open(i));
    return button;
  }

  /** Link to the first entry of a branch. */
  private branchLink(b: number): Node {
    const [first] = entriesOf(this.page, b);
    return first === undefined ? document.createTextNode(branchName(this.page, b)) : this.link(first);
  }

  private links(all: number[], words: (i: number) => string = () => ""): Node[] {
    return all.map((k) => html("span", { class: "relative" }, this.link(k), words(k)));
  }

  private facts(i: number): [string, (Node | string)[]][] {
    const { page } = this;
    const entry = entryOf(page, i);
    const branch = branchOf(page, entry.branch);
    const inside = contentsOf(page, i);
    const same = entriesOf(page, entry.branch).filter((k) => k !== i);
    const siblings = page.branches.flatMap((other, b) =>
      branch.parent >= 0 && other.parent === branch.parent && b !== entry.branch ? entriesOf(page, b).slice(0, 1) : [],
    );
    const name = page.polarity === "both" ? "values" : "isovalue";
    const facts: [string, (Node | string)[]][] = [[name, [valuesOf(page, i), entry.why ? `: ${entry.why}` : ""]]];
    if (same.length > 0) facts.push(["same object at", this.links(same, (k) => ` at ${value(entryOf(page, k).tau)}`)]);
    const more = branch.isovalues ?? [];
    if (more.length > 0) facts.push(["other good isovalues", more.map((advice) => this.advice(advice))]);
    facts.push(
      ["exists", [rangeOf(branch, page)]],
      ["size", [volume(entry.measure, page.volume.unit), page.volume.unit === null ? "" : `, ${count(entry.voxels)} voxels`]],
      ["contrast × size", [value(branch.hypervolume)]],
      ["id", [voxelWord(entry.id)]],
    );
    if (entry.inside >= 0) facts.push(["inside", this.links([entry.inside])]);
    if (entry.around >= 0) facts.push(["a cavity of", this.links([entry.around])]);
    else if (entry.enclosed) facts.push(["place", [placeOf(page, i)]]);
    if (entry.border) facts.push(["border", [entry.border]]);
    if (inside.length > 0) facts.push(["contains", this.links(inside)]);
    if (branch.parent >= 0) facts.push(["merges into", [this.branchLink(branch.parent)]]);
    if (siblings.length > 0) facts.push(["merges with", this.links(siblings)]);
    return facts;
  }

  private advice({ tau, why, cavity }: Advice): HTMLElement {
    return html("div", {}, `${value(tau)}: ${why}`, ...(cavity === undefined ? [] : [": ", this.link(cavity)]));
  }

  /** Tunnels and cavities between its first isovalue and its merge. */
  private shape(i: number): HTMLElement | null {
    const { page } = this;
    const entry = entryOf(page, i);
    const shape = branchOf(page, entry.branch).shape;
    if (!shape || shape.edges.length < 2) return null;
    const lines: Line[] = [
      { name: "tunnels", one: "tunnel", count: shape.tunnels },
      { name: "cavities", one: "cavity", count: shape.cavities },
    ];
    const max = Math.max(...lines.flatMap((line) => line.count.max));
    if (max === 0) return html("p", { class: "note" }, "It has no tunnels and no cavities at any of its isovalues.");
    const [width, height, bottom] = [640, 140, 112];
    const axis = new Axis(shape.edges[0] ?? 0, shape.edges.at(-1) ?? 1, width, 10, page.axis.bend);
    const [tunnels, cavities] = [Math.max(...shape.tunnels.max), Math.max(...shape.cavities.max)];
    const label = `At most ${plural(tunnels, "tunnel")} and ${plural(cavities, "cavity", "cavities")}`;
    const drawing = svg("svg", { viewBox: `0 0 ${width} ${height}`, class: "spectrum", role: "img", "aria-label": label });
    const x = axis.x(entry.tau);
    drawing.append(
      drawTicks(axis, bottom, 7),
      drawCounts(shape.edges, lines, axis, new Scale(lines, 14, bottom)),
      svg("line", { class: "needle", x1: x, x2: x, y1: 4, y2: bottom }),
    );
    return html("section", {}, html("h3", {}, "Tunnels and cavities over the isovalue"), drawing, legend(lines));
  }

  /** Isovalues between which its longest tunnels are open. */
  private tunnels(i: number): HTMLElement | null {
    const tunnels = branchOf(this.page, entryOf(this.page, i).branch).tunnels;
    if (!tunnels) return null;
    const rest = tunnels.significant - tunnels.longest.length;
    const others = rest > 0 ? `and ${plural(rest, "shorter one")}. ` : "";
    const pairs = tunnels.exact ? "Exact." : "Approximate: pairs by the elder rule.";
    return html(
      "section",
      { class: "tunnels" },
      html("h3", {}, "Tunnels above noise level"),
      html(
        "ul",
        { class: "merges" },
        ...tunnels.longest.map(({ opens, closes }) => html("li", {}, `opens at ${value(opens)}, closes at ${value(closes)}`)),
      ),
      html("p", { class: "note" }, `${others}${pairs} Some tunnels outlive the object.`),
    );
  }

  /** Branches that merge into this object, in that order. */
  private merges(i: number): HTMLElement | null {
    const { page } = this;
    const own = entryOf(page, i).branch;
    const arriving = page.branches.map((_, b) => b).filter((b) => branchOf(page, b).parent === own);
    const shown = inOrderOfMerges(
      page,
      arriving.filter((b) => entriesOf(page, b).length > 0),
    );
    const joined = Math.max(branchOf(page, own).joined, shown.length);
    if (joined === 0) return null;
    const items = shown.slice(0, maxMerges).map((b) => html("li", {}, `at ${value(branchOf(page, b).merges ?? 0)}: `, this.branchLink(b)));
    const rest = joined - items.length;
    const [one, many] = isCavity(page, i) ? ["cavity", "cavities"] : ["object", "objects"];
    return html(
      "section",
      {},
      html("h3", {}, "Merged objects"),
      html("ul", { class: "merges" }, ...items),
      rest > 0
        ? html(
            "p",
            { class: "note" },
            `${items.length > 0 ? `and ${plural(rest, `more ${one}`, `more ${many}`)}` : plural(rest, one, many)} without a picture`,
          )
        : null,
    );
  }
}
