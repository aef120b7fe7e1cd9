// The isovalue of what is selected: dragged, typed, stepped; and what its surface will be before it is made.
import { Axis, drawTicks } from "../axis";
import { html, svg } from "../dom";
import { count, plural, value } from "../format";
import type { Atlas, Preview } from "./api";

const WIDTH = 800;
const HEIGHT = 54;

/** The values at which an object that matters begins, or ends in another one. */
export function eventsOf(atlas: Atlas): number[] {
  const values = atlas.objects.flatMap((entry) => [entry.appears, entry.merges]);
  return [...new Set(values.filter((value): value is number => value !== null))].sort((a, b) => a - b);
}

export class AxisPanel {
  readonly element: HTMLElement;
  private readonly axis: Axis;
  private readonly mark = svg("line", { class: "mark", y1: 0, y2: 30 });
  private readonly range = svg("rect", { class: "range", y: 12, height: 8 });
  private readonly box = html("input", { type: "text", inputmode: "decimal", "aria-label": "isovalue" });
  private readonly badge = html("output", { class: "badge" });
  private readonly slider: HTMLInputElement;

  /** moved(tau, transient): transient while it is dragged */
  constructor(
    private readonly atlas: Atlas,
    private readonly moved: (tau: number, transient: boolean) => void,
  ) {
    this.axis = new Axis(atlas.low, atlas.high, WIDTH, 12);
    const events = svg("g", { class: "events" });
    for (const tau of eventsOf(atlas)) {
      const x = this.axis.x(tau);
      events.append(svg("line", { x1: x, x2: x, y1: 24, y2: 30 }));
    }
    const drawing = svg("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, "aria-hidden": "true" }, this.range, events, drawTicks(this.axis, 30, 8), this.mark);
    this.slider = html("input", { type: "range", min: atlas.low, max: atlas.high, step: "any", "aria-label": "isovalue" });
    this.slider.addEventListener("input", () => this.moved(Number(this.slider.value), true));
    this.slider.addEventListener("change", () => this.moved(Number(this.slider.value), false));
    this.box.addEventListener("change", () => this.commit());
    const label = html("label", {}, "isovalue ", this.box, atlas.valueUnit ? ` ${atlas.valueUnit}` : "");
    this.element = html("section", { class: "axis", "aria-label": "isovalue" }, html("div", { class: "line" }, label, this.badge), html("div", { class: "drawn" }, drawing, this.slider));
  }

  /** low, high: between these the object keeps its form. */
  show(tau: number, low: number, high: number): void {
    const x = this.axis.x(tau);
    this.mark.setAttribute("x1", String(x));
    this.mark.setAttribute("x2", String(x));
    this.range.setAttribute("x", String(this.axis.x(low)));
    this.range.setAttribute("width", String(Math.max(1, this.axis.x(high) - this.axis.x(low))));
    this.box.value = String(Number(tau.toPrecision(7)));
    this.slider.value = String(tau);
  }

  tell(preview: Preview): void {
    const [least, most] = preview.triangles;
    const triangles = least === most ? count(most) : `${count(least)} to ${count(most)}`;
    this.badge.textContent = `${plural(preview.objects, "object")}, ${plural(preview.cavities, "cavity", "cavities")}, ${plural(preview.tunnels, "tunnel")}, ${triangles} triangles in all at ${value(preview.tau)}`;
  }

  private commit(): void {
    const tau = Number(this.box.value);
    if (this.box.value.trim() !== "" && Number.isFinite(tau)) this.moved(Math.min(Math.max(tau, this.atlas.low), this.atlas.high), false);
  }
}
