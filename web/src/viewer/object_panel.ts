// What is selected: what it is, how it is drawn, and what can be taken away.
import { html } from "../dom";
import { count, plural, value, volume } from "../format";
import type { Atlas } from "./api";
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
    private readonly atlas: Atlas,
    private readonly file: string,
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
    const entry = this.atlas.objects[shown.entry];
    this.title.textContent = entry ? `Object ${shown.entry + 1}` : "All there is";
    this.opacity.value = String(shown.opacity);
    const tau = Number(shown.tau.toPrecision(7));
    this.command.textContent = `isoatlas extract ${this.file}${entry ? ` --object ${entry.id}` : ""} --tau ${tau} -o object.stl`;
    const facts: [string, string][] = entry
      ? [
          ["appears at", entry.appears === null ? "the highest value" : value(entry.appears)],
          ["merges at", entry.merges === null ? "never" : value(entry.merges)],
          ["best seen at", value(entry.best)],
          ["size there", volume(entry.measure, this.atlas.unit)],
          ["voxels there", count(entry.voxels)],
          ["form there", `${plural(entry.tunnels, "tunnel")}, ${plural(entry.cavities, "cavity", "cavities")}`],
          ...(entry.inside >= 0 ? [["lies in", `object ${entry.inside + 1}`] as [string, string]] : []),
        ]
      : [];
    this.facts.replaceChildren(...facts.flatMap(([name, text]) => [html("dt", {}, name), html("dd", {}, text)]));
  }
}
