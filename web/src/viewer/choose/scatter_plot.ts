// All objects as dots on a plane of contrast and size, both logarithmic; those that stand out and those that are chosen are marked. A box
// is dragged open on it; a click chooses the dot next to it.
import type uPlot from "uplot";
import { html } from "../../dom";
import { value } from "../../format";
import type { Choice, Limits, Sizes } from "../state/choosing";
import { plotAxis, plotIn } from "../desk/plot";
import { ink } from "../desk/theme";

/** Pixels from a dot at which a click still means it; a press that moves less than a drag is a click. */
const NEAR = 12;
const DRAG = 5;
const TURN = 2 * Math.PI;

/** pixels for the numbers below and on the left, and for what they are of */
const [UNDER, LEFT, NAME] = [20, 48, 16];

export interface Marks {
  choice: Choice | null;
  /** ranks */
  chosen: Set<number>;
  shown: Set<number>;
  selected: number;
}

export interface Hand {
  /** transient: while the box is being dragged */
  box(contrast: Limits, size: Limits, transient: boolean): void;
  click(rank: number, add: boolean): void;
  /** what a dot is called */
  nameOf(rank: number): string;
}

export class ScatterPlot {
  readonly element = html("div", { class: "scatter", role: "img" });
  private readonly plot: uPlot;
  private marks: Marks = { choice: null, chosen: new Set(), shown: new Set(), selected: -1 };
  private sizes: Sizes[] = [];
  private pressed: { x: number; y: number } | null = null;
  /** where the plot was when it was pressed: words above it may change what room they take while a box is dragged */
  private held: DOMRect | null = null;

  constructor(
    names: { across: string; up: string },
    private readonly hand: Hand,
  ) {
    // what is not positive lies at the low end
    const range: uPlot.Range.Function = (_, least, most) => [least, most];
    const scale: uPlot.Scale = { time: false, distr: 3, range, clamp: (_plot, _value, least) => least };
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
  take(sizes: Sizes[]): void {
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
    filled(ink("soft"));
    pen.globalAlpha = 1;
    dots(2.6, ({ rank }) => chosen.has(rank));
    filled(ink("mark"));
    dots(4.5, ({ standsOut }) => standsOut);
    drawn(ink("ink"), 1.2);
    dots(5, ({ rank }) => shown.has(rank));
    filled(ink("chosen"));
    drawn(ink("ink"), 1.2);
    dots(9, ({ rank }) => rank === selected);
    drawn(ink("chosen"), 2.5);
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
    pen.fillStyle = ink("mark");
    pen.fillRect(x0, y1, x1 - x0, y0 - y1);
    pen.globalAlpha = 1;
    [pen.strokeStyle, pen.lineWidth] = [ink("mark"), 2 * pixel];
    pen.strokeRect(x0, y1, x1 - x0, y0 - y1);
  }

  private listen(): void {
    const { element } = this;
    element.addEventListener("pointerdown", (event) => {
      if (this.sizes.length === 0) return;
      this.held = this.plot.over.getBoundingClientRect();
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
      this.pressed = this.held = null;
    });
    element.addEventListener("pointercancel", () => (this.pressed = this.held = null));
  }

  /** In pixels from the left and the top of what lies between the axes. */
  private placeOf(event: PointerEvent): { x: number; y: number } {
    const box = this.held ?? this.plot.over.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  /** null: beyond the end, where there is no limit. Three digits. */
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
    this.hand.box([this.limit("x", left), this.limit("x", right)], [this.limit("y", bottom), this.limit("y", top)], transient);
  }

  private click(event: PointerEvent): void {
    const near = this.nearest(event);
    if (near !== null) this.hand.click(near, event.shiftKey);
  }

  private hover(event: PointerEvent): void {
    const near = this.nearest(event);
    this.element.title = near === null ? "" : this.hand.nameOf(near);
    this.element.style.cursor = near === null ? "crosshair" : "pointer";
  }

  /** The dot next to a place; of those at one distance the most important one. */
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

/** From the least that is positive to the most, with a little room on a logarithmic axis. */
export function spanOf(numbers: readonly number[]): { min: number; max: number } {
  const positive = numbers.filter((number) => number > 0);
  if (positive.length === 0) return { min: 0.5, max: 2 };
  const [least, most] = [positive.reduce((a, b) => Math.min(a, b)), positive.reduce((a, b) => Math.max(a, b))];
  const room = Math.max(10, most / least) ** 0.04;
  return { min: least / room, max: most * room };
}

/** Nothing where an axis ends between two ticks. */
function roundValue(tick: number | null): string {
  return tick !== null && Number(tick.toPrecision(1)) === tick ? value(tick) : "";
}
