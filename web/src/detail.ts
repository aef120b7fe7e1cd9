// Everything about one object, in a dialog: what it lies in, what lies in it, what it merges into, and the commands.
import { commandList } from "./commands";
import { html } from "./dom";
import { count, value, volume } from "./format";
import { contentsOf, describe, nameOf, rangeOf, shapeOf } from "./names";
import { rangeBar } from "./overview";
import type { Page } from "./page";
import { turntable } from "./turntable";

export class Detail {
  readonly dialog = html("dialog", { class: "detail", "aria-labelledby": "detail-title" });
  private shown = 0;

  constructor(private readonly page: Page) {
    this.dialog.addEventListener("click", (event) => {
      if (event.target === this.dialog) this.dialog.close();
    });
    this.dialog.addEventListener("keydown", (event) => {
      const onPicture = event.target instanceof Element && event.target.classList.contains("turntable");
      if (onPicture) return;
      if (event.key === "ArrowRight") this.open(this.shown + 1);
      if (event.key === "ArrowLeft") this.open(this.shown - 1);
    });
    this.dialog.addEventListener("close", () => history.replaceState(null, "", location.pathname + location.search));
  }

  open(i: number): void {
    const n = this.page.objects.length;
    if (n === 0) return;
    this.shown = ((i % n) + n) % n;
    this.dialog.replaceChildren(...this.content(this.shown));
    if (!this.dialog.open) this.dialog.showModal();
    this.dialog.querySelector("h2")?.focus(); // what had it may be gone, and keys go on to work
    history.replaceState(null, "", `#object-${this.shown + 1}`);
  }

  private content(i: number): Node[] {
    const { page } = this;
    const entry = page.objects[i];
    if (!entry) return [];
    const close = html("button", { type: "button", class: "close", "aria-label": "Close" }, "×");
    close.addEventListener("click", () => this.dialog.close());
    const step = (by: number, label: string): HTMLElement => {
      const button = html("button", { type: "button", "aria-label": label }, by < 0 ? "‹" : "›");
      button.addEventListener("click", () => this.open(i + by));
      return button;
    };
    return [
      html("header", {}, step(-1, "Previous object"), html("h2", { id: "detail-title", tabindex: -1 }, nameOf(page, i)), step(1, "Next object"), close),
      entry.picture ? turntable(entry.picture, `Picture of ${describe(page, i)}`) : html("p", {}, "no picture"),
      html("p", {}, this.sentence(i)),
      rangeBar(page, i),
      html(
        "dl",
        { class: "facts" },
        ...this.facts(i).flatMap(([name, what]) => [html("dt", {}, name), html("dd", {}, ...what)]),
      ),
      html("h3", {}, "Get it"),
      commandList(entry),
    ];
  }

  private sentence(i: number): string {
    const entry = this.page.objects[i];
    if (!entry) return "";
    const steady = `Between ${value(entry.low)} and ${value(entry.high)} its shape stays the same: ${shapeOf(entry)}.`;
    const end =
      entry.merges === null
        ? `It appears at ${value(entry.appears)} and is there at every lower isovalue.`
        : `It appears at ${value(entry.appears)}. At ${value(entry.merges)} it merges into ${entry.into >= 0 ? nameOf(this.page, entry.into) : "a larger object"}.`;
    return `${end} ${steady}`;
  }

  private facts(i: number): [string, (Node | string)[]][] {
    const { page } = this;
    const entry = page.objects[i];
    if (!entry) return [];
    const link = (k: number): Node => {
      const button = html("button", { type: "button", class: "link" }, nameOf(page, k));
      button.addEventListener("click", () => this.open(k));
      return button;
    };
    const links = (all: number[]): (Node | string)[] => all.flatMap((k, at) => (at > 0 ? [", ", link(k)] : [link(k)]));
    const inside = contentsOf(page, i);
    const siblings = page.objects.flatMap((other, k) => (entry.into >= 0 && other.into === entry.into && k !== i ? [k] : []));
    const facts: [string, (Node | string)[]][] = [
      ["best isovalue", [value(entry.best)]],
      ["on its own", [rangeOf(entry)]],
      ["size", [volume(entry.measure, page.volume.unit), page.volume.unit === null ? "" : `, ${count(entry.voxels)} voxels`]],
      ["contrast × size", [value(entry.hypervolume)]],
      ["name", [String(entry.id)]],
    ];
    if (entry.inside >= 0) facts.push(["lies in", [link(entry.inside)]]);
    if (inside.length > 0) facts.push(["contains", links(inside)]);
    if (entry.into >= 0) facts.push(["merges into", [link(entry.into)]]);
    if (siblings.length > 0) facts.push(["siblings", links(siblings)]);
    return facts;
  }
}
