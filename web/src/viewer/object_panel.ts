// What is selected: what it is, how it is drawn, and what can be taken away.
import { html } from "../dom";
import { count, value, volume } from "../format";
import { placeOf, rangeOf, shapeOf } from "../names";
import { entryOf, type Page } from "../page";
import { branchOfShown, EVERYTHING, titleOf } from "./shown";
import type { Shown } from "./state";

export interface Wishes {
  fade(opacity: number, transient: boolean): void;
  hide(): void;
  save(format: string): void;
  picture(): void;
  link(): void;
}

const FORMATS = ["stl", "ply", "obj", "glb", "vtp"];

export class ObjectPanel {
  readonly element: HTMLElement;
  private readonly title = html("h2", {});
  private readonly facts = html("dl", {});
  private readonly command = html("code", {});
  private readonly opacity: HTMLInputElement;

  constructor(
    private readonly page: Page,
    wishes: Wishes,
  ) {
    this.opacity = html("input", { type: "range", min: 0.1, max: 1, step: 0.05, "aria-label": "opacity" });
    this.opacity.addEventListener("input", () => wishes.fade(Number(this.opacity.value), true));
    this.opacity.addEventListener("change", () => wishes.fade(Number(this.opacity.value), false));
    const format = html("select", { "aria-label": "format" }, ...FORMATS.map((name) => html("option", { value: name }, name.toUpperCase())));
    this.element = html(
      "section",
      { class: "object", "aria-label": "what is selected", hidden: true },
      this.title,
      this.facts,
      html("label", {}, "opacity ", this.opacity),
      html("div", { class: "line" }, format, html("button", { type: "button", click: () => wishes.save(format.value) }, "Save the surface")),
      html(
        "div",
        { class: "line" },
        html("button", { type: "button", click: () => wishes.picture() }, "Save a picture"),
        html("button", { type: "button", click: () => wishes.link() }, "Copy the link"),
        html("button", { type: "button", click: () => wishes.hide() }, "Hide"),
      ),
      html("p", {}, "The same on the command line:"),
      html("pre", {}, this.command),
    );
  }

  show(shown: Shown | undefined): void {
    this.element.hidden = !shown;
    if (!shown) return;
    this.title.textContent = titleOf(this.page, shown.entry);
    this.opacity.value = String(shown.opacity);
    this.command.textContent = this.commandOf(shown);
    const facts: [string, string][] = shown.entry === EVERYTHING ? [] : this.factsOf(shown.entry);
    this.facts.replaceChildren(...facts.flatMap(([name, text]) => [html("dt", {}, name), html("dd", {}, text)]));
  }

  private factsOf(i: number): [string, string][] {
    const entry = entryOf(this.page, i);
    const branch = branchOfShown(this.page, i);
    const facts: [string, string][] = [
      ["on its own", branch ? rangeOf(branch) : ""],
      ["best seen at", value(entry.tau)],
      ["because", entry.why],
      ["size there", volume(entry.measure, this.page.volume.unit)],
      ["voxels there", count(entry.voxels)],
      ["shape there", shapeOf(this.page, i)],
      ["lies", placeOf(this.page, i)],
    ];
    return facts.filter(([, text]) => text !== "");
  }

  /** The command of the page that writes its surface, at the isovalue it is shown at. */
  private commandOf(shown: Shown): string {
    const tau = Number(shown.tau.toPrecision(7));
    if (shown.entry === EVERYTHING) return `isoatlas extract ${this.page.volume.name}.atlas --tau ${tau} -o surface.stl`;
    const line = entryOf(this.page, shown.entry).commands.find((command) => command.line.startsWith("isoatlas extract"))?.line ?? "";
    return line.replace(/--tau \S+/, `--tau ${tau}`);
  }
}
