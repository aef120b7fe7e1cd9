// All objects as dots on a plane of contrast and size, both logarithmic; those that stand out and those that are chosen are marked. A box
// is dragged open on it; a click chooses the dot next to it.
import { html } from "../../dom";
import { value } from "../../format";
import type { Choice, Limits, Sizes } from "../state/choosing";
import { Logarithmic, spanOf, type Frame } from "./plane";
import { onTheme } from "../desk/theme";

/** Pixels from a dot at which a click still means it; a press that moves less than a drag is a click. */
const NEAR = 12;
const DRAG = 5;
const TURN = 2 * Math.PI;

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
  readonly element: HTMLCanvasElement;
  private marks: Marks = { choice: null, chosen: new Set(), shown: new Set(), selected: -1 };
  private frame: Frame = { left: 46, right: 0, top: 8, bottom: 0 };
  private across = new Logarithmic(1, 1, 0, 1);
  private up = new Logarithmic(1, 1, 1, 0);
  private sizes: Sizes[] = [];
  private pressed: { x: number; y: number } | null = null;
  /** where the plot was when it was pressed: words above it may change what room they take while a box is dragged */
  private held: DOMRect | null = null;

  constructor(
    private readonly names: { across: string; up: string },
    private readonly hand: Hand,
  ) {
    this.element = html("canvas", { class: "scatter", role: "img" });
    new ResizeObserver(() => this.resize()).observe(this.element);
    onTheme(() => this.draw());
    this.listen();
  }

  /** One dot for each. */
  take(sizes: Sizes[]): void {
    this.sizes = sizes;
    this.resize();
  }

  show(marks: Marks, label: string): void {
    this.marks = marks;
    this.element.setAttribute("aria-label", label);
    this.draw();
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.element;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.element.width = clientWidth * devicePixelRatio;
    this.element.height = clientHeight * devicePixelRatio;
    this.frame = { left: 46, right: clientWidth - 8, top: 8, bottom: clientHeight - 36 };
    const { left, right, top, bottom } = this.frame;
    this.across = new Logarithmic(...spanOf(this.sizes.map(({ contrast }) => contrast)), left, right);
    this.up = new Logarithmic(...spanOf(this.sizes.map(({ size }) => size)), bottom, top);
    this.draw();
  }

  private draw(): void {
    const context = this.element.getContext("2d");
    if (!context || this.frame.right === 0) return;
    const ink = inkOf(this.element);
    context.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
    context.clearRect(0, 0, this.element.clientWidth, this.element.clientHeight);
    this.drawAxes(context, ink);
    this.drawDots(context, ink);
    this.drawBox(context, ink);
  }

  private drawAxes(context: CanvasRenderingContext2D, ink: Ink): void {
    const { left, right, top, bottom } = this.frame;
    context.font = "11px system-ui, sans-serif";
    context.fillStyle = ink.soft;
    context.strokeStyle = ink.line;
    context.lineWidth = 1;
    context.beginPath();
    context.textAlign = "center";
    for (const ten of this.across.tens(44)) {
      const x = this.across.pixel(ten);
      context.moveTo(x, top);
      context.lineTo(x, bottom);
      context.fillText(value(ten), x, bottom + 14);
    }
    context.textAlign = "right";
    for (const ten of this.up.tens(24)) {
      const y = this.up.pixel(ten);
      context.moveTo(left, y);
      context.lineTo(right, y);
      context.fillText(value(ten), left - 5, y + 4);
    }
    context.stroke();
    context.fillText(this.names.across, right, bottom + 30);
    context.textAlign = "left";
    context.fillText(this.names.up, left + 5, top + 10);
  }

  private drawDots(context: CanvasRenderingContext2D, ink: Ink): void {
    const { chosen, shown, selected } = this.marks;
    const dot = (sizes: Sizes, radius: number): void => {
      context.beginPath();
      context.arc(this.across.pixel(sizes.contrast), this.up.pixel(sizes.size), radius, 0, TURN);
    };
    context.fillStyle = ink.soft;
    context.globalAlpha = 0.4;
    for (const sizes of this.sizes) if (!chosen.has(sizes.rank)) dot(sizes, 1.6), context.fill();
    context.globalAlpha = 1;
    context.fillStyle = ink.mark;
    for (const sizes of this.sizes) if (chosen.has(sizes.rank)) dot(sizes, 2.6), context.fill();
    context.strokeStyle = ink.ink;
    context.lineWidth = 1.2;
    for (const sizes of this.sizes) if (sizes.standsOut) dot(sizes, 4.5), context.stroke();
    context.fillStyle = ink.chosen;
    for (const sizes of this.sizes) if (shown.has(sizes.rank)) dot(sizes, 5), context.fill(), context.stroke();
    context.lineWidth = 2.5;
    context.strokeStyle = ink.chosen;
    const own = this.sizes[selected];
    if (own) dot(own, 9), context.stroke();
  }

  private drawBox(context: CanvasRenderingContext2D, ink: Ink): void {
    const { choice } = this.marks;
    if (!choice || [...choice.contrast, ...choice.size].every((limit) => limit === null)) return;
    const { left, right, top, bottom } = this.frame;
    const at = (scale: Logarithmic, limit: number | null, none: number): number => (limit === null ? none : scale.pixel(limit));
    const [x0, x1] = [at(this.across, choice.contrast[0], left), at(this.across, choice.contrast[1], right)];
    const [y0, y1] = [at(this.up, choice.size[0], bottom), at(this.up, choice.size[1], top)];
    context.globalAlpha = 0.12;
    context.fillStyle = ink.mark;
    context.fillRect(x0, y1, x1 - x0, y0 - y1);
    context.globalAlpha = 1;
    context.strokeStyle = ink.mark;
    context.lineWidth = 2;
    context.strokeRect(x0, y1, x1 - x0, y0 - y1);
  }

  private listen(): void {
    const { element } = this;
    element.addEventListener("pointerdown", (event) => {
      if (this.sizes.length === 0) return;
      this.held = element.getBoundingClientRect();
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

  private placeOf(event: PointerEvent): { x: number; y: number } {
    const box = this.held ?? this.element.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  private isDrag(event: PointerEvent): boolean {
    const { x, y } = this.placeOf(event);
    return this.pressed !== null && Math.hypot(x - this.pressed.x, y - this.pressed.y) > DRAG;
  }

  private drag(event: PointerEvent, transient: boolean): void {
    const [from, to] = [this.pressed ?? { x: 0, y: 0 }, this.placeOf(event)];
    const [left, right] = [from.x, to.x].sort((p, q) => p - q) as [number, number];
    const [top, bottom] = [from.y, to.y].sort((p, q) => p - q) as [number, number];
    this.hand.box([this.across.value(left), this.across.value(right)], [this.up.value(bottom), this.up.value(top)], transient);
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
      const d = Math.hypot(this.across.pixel(contrast) - x, this.up.pixel(size) - y);
      if (d < distance) [best, distance] = [rank, d];
    }
    return best;
  }
}

interface Ink {
  ink: string;
  soft: string;
  line: string;
  mark: string;
  chosen: string;
}

/** Colours that differ by theme, as the borders that choose.css gives the canvas: a canvas knows no variables. */
function inkOf(element: HTMLElement): Ink {
  const style = getComputedStyle(element);
  const { color, borderTopColor, borderRightColor, borderBottomColor, borderLeftColor } = style;
  return { ink: color, soft: borderTopColor, line: borderRightColor, mark: borderBottomColor, chosen: borderLeftColor };
}
