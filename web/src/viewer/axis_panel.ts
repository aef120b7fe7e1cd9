// The isovalue of what is selected: dragged, typed, stepped; and what its surface will be before it is made.
import { Axis, drawTicks, histogramPath } from "../axis";
import { html, svg } from "../dom";
import { count, plural, value } from "../format";
import type { Page } from "../page";
import type { Preview } from "./api";
import { eventsOf } from "./shown";

const WIDTH = 800;
const HEIGHT = 66;
const LINE = 42;
/** of the slider */
const STEPS = 10_000;

export class AxisPanel {
  readonly element: HTMLElement;
  private readonly axis: Axis;
  private readonly mark = svg("line", { class: "mark", y1: 0, y2: LINE });
  private readonly range = svg("rect", { class: "range", y: 24, height: 8 });
  private readonly box = html("input", { type: "text", inputmode: "decimal", "aria-label": "isovalue" });
  private readonly badge = html("output", { class: "badge" });
  private readonly slider = html("input", { type: "range", min: 0, max: STEPS, "aria-label": "isovalue" });

  /** moved(tau, transient): transient while it is dragged */
  constructor(
    private readonly page: Page,
    private readonly moved: (tau: number, transient: boolean) => void,
  ) {
    this.axis = Axis.of(page, WIDTH, 12);
    const events = svg("g", { class: "events" });
    for (const tau of eventsOf(page)) {
      const x = this.axis.x(tau);
      events.append(svg("line", { x1: x, x2: x, y1: LINE - 6, y2: LINE }));
    }
    const drawing = svg("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, preserveAspectRatio: "none", "aria-hidden": "true" });
    drawing.append(svg("path", { class: "histogram", d: histogramPath(page.histogram, this.axis, 2, LINE) }), this.range, events, drawTicks(this.axis, LINE, 8), this.mark);
    this.slider.addEventListener("input", () => this.moved(this.tauOf(Number(this.slider.value)), true));
    this.slider.addEventListener("change", () => this.moved(this.tauOf(Number(this.slider.value)), false));
    this.box.addEventListener("change", () => this.commit());
    const label = html("label", {}, "isovalue ", this.box, page.volume.valueUnit ? ` ${page.volume.valueUnit}` : "");
    this.element = html("section", { class: "axis", "aria-label": "isovalue" }, html("div", { class: "line" }, label, this.badge), html("div", { class: "drawn" }, drawing, this.slider));
  }

  /** low, high: between these the object is on its own. */
  show(tau: number, [low, high]: [number, number]): void {
    const x = this.axis.x(tau);
    this.mark.setAttribute("x1", String(x));
    this.mark.setAttribute("x2", String(x));
    this.range.setAttribute("x", String(this.axis.x(low)));
    this.range.setAttribute("width", String(Math.max(1, this.axis.x(high) - this.axis.x(low))));
    this.box.value = String(Number(tau.toPrecision(7)));
    this.slider.value = String(Math.round(((x - 12) / (WIDTH - 24)) * STEPS));
    this.slider.setAttribute("aria-valuetext", value(tau));
  }

  tell(preview: Preview): void {
    const [least, most] = preview.triangles;
    const triangles = least === most ? count(most) : `${count(least)} to ${count(most)}`;
    this.badge.textContent = `${plural(preview.objects, "object")}, ${plural(preview.cavities, "cavity", "cavities")}, ${plural(preview.tunnels, "tunnel")}, ${triangles} triangles in all at ${value(preview.tau)}`;
  }

  private tauOf(step: number): number {
    return Number(this.axis.tau(12 + (step / STEPS) * (WIDTH - 24)).toPrecision(7));
  }

  private commit(): void {
    const tau = Number(this.box.value);
    if (this.box.value.trim() !== "" && Number.isFinite(tau)) this.moved(Math.min(Math.max(tau, this.page.axis.low), this.page.axis.high), false);
  }
}
