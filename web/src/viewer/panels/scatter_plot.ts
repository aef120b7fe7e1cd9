// Scatter plot of contrast and size of all objects, both logarithmic; significant and chosen ones are marked.
// Dragging selects a box, a click selects the nearest dot.
import type uPlot from "uplot";
import { html } from "../../shared/dom";
import { value } from "../../shared/format";
import type { Choice, Limits, Sizes } from "../state/selection";
import { plotAxis, plotIn } from "../context/plot";
import { themeColor } from "../context/theme";

/** Maximal distance of a click from a dot, and minimal movement of a drag, in pixels. */
const NEAR = 12;
const DRAG = 5;
const TURN = 2 * Math.PI;

/** pixels for labels below and on the left, and for the names of the axes */
const [UNDER, LEFT, NAME] = [20, 48, 16];

export interface Marks {
  choice: Choice | null;
  /** ranks */
  chosen: Set<number>;
  shown: Set<number>;
  selected: number;
}

export interface ScatterPlotEvents {
  /** transient: during the drag */
  box(contrast: Limits, size: Limits, transient: boolean): void;
  click(rank: number, add: boolean): void;
  /** tooltip of a dot */
  nameOf(rank: number): string;
}

export class ScatterPlot {
  readonly element = html("div", { class: "scatter", role: "img" });
  private readonly plot: uPlot;
  private marks: Marks = { choice: null, chosen: new Set(), shown: new Set(), selected: -1 };
  private sizes: Sizes[] = [];
  private pressed: { x: number; y: number } | null = null;
  /** bounds of the plot at pointerdown: text above it may change its height during a drag */
  private bounds: DOMRect | null = null;

  constructor(
    names: { across: string; up: string },
    private readonly events: ScatterPlotEvents,
  ) {
    // values that are not positive lie at the low end
    const range: uPlot.Range.Function = (_, min, max) => [min, max];
    const scale: uPlot.Scale = { time: false, distr: 3, range, clamp: (_plot, _value, min) => min };
    const tens: uPlot.Axis.Filter = (_, ticks) => ticks.map((tick) => (Number.isInteger(Math.log10(tick)) ? tick : null));
    const axis = (label: string, size: number): uPlot.Axis =>
      plotAxis({ label, size, labelSize: NAME, labelGap: 0, grid: { filter: tens }, values: (_, ticks) => ticks.map(roundValue) });
    this.plot = plotIn(
      this.element,
      {
        padding: [8, 8, 0, 0],
        scales: { x: { ...scale }, y: { ...scale } },
        axes: [axis(names.across, UNDER), axis(names.up, LEFT)],
        series: [{}],
      },
      [[]],
      (pen, pixel) => this.draw(pen, pixel),
    );
    this.listen();
  }

  /** One dot for each. */
  setData(sizes: Sizes[]): void {
    this.sizes = sizes;
    this.plot.batch(() => {
      this.plot.setScale("x", spanOf(sizes.map(({ contrast }) => contrast)));
      this.plot.setScale("y", spanOf(sizes.map(({ size }) => size)));
    });
  }

  show(marks: Marks, label: string): void {
    this.marks = marks;
    this.element.setAttribute("aria-label", label);
    this.plot.redraw(false);
  }

  private draw(pen: CanvasRenderingContext2D, pixel: number): void {
    if (this.sizes.length === 0) return;
    const { chosen, shown, selected } = this.marks;
    const x = ({ contrast }: Sizes): number => this.plot.valToPos(contrast, "x", true);
    const y = ({ size }: Sizes): number => this.plot.valToPos(size, "y", true);
    const dots = (radius: number, isMeant: (sizes: Sizes) => boolean): void => {
      pen.beginPath();
      for (const sizes of this.sizes.filter(isMeant)) {
        pen.moveTo(x(sizes) + radius * pixel, y(sizes));
        pen.arc(x(sizes), y(sizes), radius * pixel, 0, TURN);
      }
    };
    const filled = (colour: string): void => void ((pen.fillStyle = colour), pen.fill());
    const drawn = (colour: string, width: number): void =>
      void (([pen.strokeStyle, pen.lineWidth] = [colour, width * pixel]), pen.stroke());
    pen.globalAlpha = 0.4;
    dots(1.6, ({ rank }) => !chosen.has(rank));
    filled(themeColor("soft"));
    pen.globalAlpha = 1;
    dots(2.6, ({ rank }) => chosen.has(rank));
    filled(themeColor("mark"));
    dots(4.5, ({ significant }) => significant);
    drawn(themeColor("ink"), 1.2);
    dots(5, ({ rank }) => shown.has(rank));
    filled(themeColor("chosen"));
    drawn(themeColor("ink"), 1.2);
    dots(9, ({ rank }) => rank === selected);
    drawn(themeColor("chosen"), 2.5);
    this.drawBox(pen, pixel);
  }

  private drawBox(pen: CanvasRenderingContext2D, pixel: number): void {
    const { choice } = this.marks;
    if (!choice || [...choice.contrast, ...choice.size].every((limit) => limit === null)) return;
    const { left, top, width, height } = this.plot.bbox;
    const at = (axis: "x" | "y", limit: number | null, none: number): number =>
      limit === null ? none : this.plot.valToPos(limit, axis, true);
    const [x0, x1] = [at("x", choice.contrast[0], left), at("x", choice.contrast[1], left + width)];
    const [y0, y1] = [at("y", choice.size[0], top + height), at("y", choice.size[1], top)];
    pen.globalAlpha = 0.12;
    pen.fillStyle = themeColor("mark");
    pen.fillRect(x0, y1, x1 - x0, y0 - y1);
    pen.globalAlpha = 1;
    [pen.strokeStyle, pen.lineWidth] = [themeColor("mark"), 2 * pixel];
    pen.strokeRect(x0, y1, x1 - x0, y0 - y1);
  }

  private listen(): void {
    const { element } = this;
    element.addEventListener("pointerdown", (event) => {
      if (this.sizes.length === 0) return;
      this.bounds = this.plot.over.getBoundingClientRect();
      this.pressed = this.placeOf(event);
      element.setPointerCapture(event.pointerId);
    });
    element.addEventListener("pointermove", (event) => {
      if (this.pressed && this.isDrag(event)) this.drag(event, true);
      else if (!this.pressed) this.hover(event);
    });
    element.addEventListener("pointerup", (event) => {
      if (this.pressed && this.isDrag(event)) this.drag(event, false);
      else if (this.pressed) this.click(event);
      this.pressed = this.bounds = null;
    });
    element.addEventListener("pointercancel", () => (this.pressed = this.bounds = null));
  }

  /** Pixels from the left and the top of the plot area. */
  private placeOf(event: PointerEvent): { x: number; y: number } {
    const box = this.bounds ?? this.plot.over.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  /** null: beyond the end: no limit. Three digits. */
  private limit(axis: "x" | "y", pixel: number): number | null {
    const { clientWidth, clientHeight } = this.plot.over;
    if (pixel <= 0 || pixel >= (axis === "x" ? clientWidth : clientHeight)) return null;
    return Number(this.plot.posToVal(pixel, axis).toPrecision(3));
  }

  private isDrag(event: PointerEvent): boolean {
    const { x, y } = this.placeOf(event);
    return this.pressed !== null && Math.hypot(x - this.pressed.x, y - this.pressed.y) > DRAG;
  }

  private drag(event: PointerEvent, transient: boolean): void {
    const [from, to] = [this.pressed ?? { x: 0, y: 0 }, this.placeOf(event)];
    const [left, right] = [from.x, to.x].sort((p, q) => p - q) as [number, number];
    const [top, bottom] = [from.y, to.y].sort((p, q) => p - q) as [number, number];
    this.events.box([this.limit("x", left), this.limit("x", right)], [this.limit("y", bottom), this.limit("y", top)], transient);
  }

  private click(event: PointerEvent): void {
    const near = this.nearest(event);
    if (near !== null) this.events.click(near, event.shiftKey);
  }

  private hover(event: PointerEvent): void {
    const near = this.nearest(event);
    this.element.title = near === null ? "" : this.events.nameOf(near);
    this.element.style.cursor = near === null ? "crosshair" : "pointer";
  }

  /** The nearest dot; at equal distance the one of highest rank. */
  private nearest(event: PointerEvent): number | null {
    const { x, y } = this.placeOf(event);
    let [best, distance]: [number | null, number] = [null, NEAR];
    for (const { rank, contrast, size } of this.sizes) {
      const d = Math.hypot(this.plot.valToPos(contrast, "x") - x, this.plot.valToPos(size, "y") - y);
      if (d < distance) [best, distance] = [rank, d];
    }
    return best;
  }
}

/** Range of the positive numbers, with a margin on a logarithmic axis. */
export function spanOf(numbers: readonly number[]): { min: number; max: number } {
  const positive = numbers.filter((number) => number > 0);
  if (positive.length === 0) return { min: 0.5, max: 2 };
  const [min, max] = [positive.reduce((a, b) => Math.min(a, b)), positive.reduce((a, b) => Math.max(a, b))];
  const margin = Math.max(10, max / min) ** 0.04;
  return { min: min / margin, max: max * margin };
}

/** Empty at the ends of an axis that are not ticks. */
function roundValue(tick: number | null): string {
  return tick !== null && Number(tick.toPrecision(1)) === tick ? value(tick) : "";
}
