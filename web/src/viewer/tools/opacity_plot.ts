// The plot of the opacity editor: the histogram with the curves of all layers, and the points of the selected one as sliders.
// The vertical axis is the square root of the opacity of a voxel, as thin matter matters.
import { Axis, drawTicks, histogramPath } from "../../shared/axis";
import { svg } from "../../shared/dom";
import { value } from "../../shared/format";
import type { Page } from "../../shared/page";
import { colourOfLayer, matterAt, MAX_OPACITY, opacityOf, type CurvePoint, type Layer } from "../state/opacity_curve";
import type { OpacityModel } from "./opacity_model";

/** pixels around the plot */
const SIDE = 34;
const TOP = 10;
const UNDER = 22;
/** of a curve between two points */
const PIECES = 16;
/** step of an arrow key: parts of the axis, and with shift */
const STEP = 0.005;
const LARGE_STEP = 0.05;
const OPACITIES = [0.01, 0.1, 0.5];
/** pixels of the labels of ticks */
const ROOM = 70;
/** pixels: a press that moves less is a click */
const CLICK = 2;

export class OpacityPlot {
  private readonly backdrop = svg("g", { "aria-hidden": "true" });
  private readonly curves = svg("g", {});
  private readonly points = svg("g", {});
  private readonly gradient = svg("linearGradient", { id: "opacity-colours", gradientUnits: "userSpaceOnUse" });
  readonly element = svg(
    "svg",
    {
      class: "opacity-plot",
      role: "group",
      "aria-label": "opacity of a voxel over the value",
      "aria-describedby": "opacity-hint",
    },
    svg("defs", {}, this.gradient),
    this.backdrop,
    this.curves,
    this.points,
  );
  private axis: Axis;
  private height = 120;
  private handles: SVGGElement[] = [];
  /** null: no drag; else from the pointer to the point, in pixels, where it began, and whether it has moved */
  private drag: { offset: [number, number]; from: [number, number]; moved: boolean } | null = null;

  /** tell: says why something is not done. */
  constructor(
    private readonly page: Page,
    private readonly model: OpacityModel,
    private readonly tell: (text: string) => void,
  ) {
    this.axis = Axis.of(page, 400, SIDE);
    new ResizeObserver(() => this.resize()).observe(this.element);
    model.onSelect(() => this.show());
    this.element.addEventListener("pointerdown", (event) => this.begin(event));
    this.element.addEventListener("pointermove", (event) => this.moveTo(event));
    for (const name of ["pointerup", "pointercancel"] as const) this.element.addEventListener(name, () => this.end());
    this.element.addEventListener("dblclick", (event) => this.addAt(event));
  }

  show(): void {
    this.curves.replaceChildren(...this.model.layers.map((layer, i) => this.curveOf(layer, i)));
    this.curves.append(...[...this.curves.children].filter((curve) => curve.classList.contains("selected"))); // on top
    this.showPoints(this.model.selected?.points ?? []);
  }

  focusPoint(): void {
    this.handles[this.model.pointAt]?.focus();
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.element;
    if (clientWidth === 0) return;
    this.axis = Axis.of(this.page, clientWidth, SIDE);
    this.height = clientHeight;
    this.element.setAttribute("viewBox", `0 0 ${clientWidth} ${clientHeight}`);
    const bottom = this.height - UNDER;
    const lines = OPACITIES.map((opacity) => {
      const y = this.y(opacity);
      return svg(
        "g",
        { class: "level" },
        svg("line", { x1: SIDE, x2: clientWidth - SIDE, y1: y, y2: y }),
        svg("text", { x: SIDE - 4, y: y + 4 }, String(opacity)),
      );
    });
    const ticks = drawTicks(this.axis, bottom, Math.max(2, (clientWidth - 2 * SIDE) / ROOM));
    this.backdrop.replaceChildren(
      svg("path", { class: "histogram", d: histogramPath(this.page.histogram, this.axis, TOP, bottom) }),
      ...lines,
      ticks,
    );
    this.show();
  }

  private y(opacity: number): number {
    return this.height - UNDER - Math.sqrt(opacity) * (this.height - UNDER - TOP);
  }
  private opacity(y: number): number {
    const up = (this.height - UNDER - y) / (this.height - UNDER - TOP);
    return Math.min(Math.max(up, 0) ** 2, MAX_OPACITY);
  }

  /** Opacity between two points: the extinction is linear. */
  private outline(points: readonly CurvePoint[]): string {
    const places = points.flatMap((point, i) => {
      const next = points[i + 1];
      const at = `${this.axis.x(point.value).toFixed(1)} ${this.y(point.opacity).toFixed(1)}`;
      if (!next || next.value === point.value || next.opacity === point.opacity) return [at];
      const between = Array.from({ length: PIECES - 1 }, (_, k) => point.value + ((k + 1) / PIECES) * (next.value - point.value));
      return [
        at,
        ...between.map(
          (v) => `${this.axis.x(v).toFixed(1)} ${this.y(opacityOf(matterAt([point, next], v).extinction)).toFixed(1)}`,
        ),
      ];
    });
    return places.join("L");
  }

  private curveOf(layer: Layer, i: number): SVGGElement {
    const { points, visible } = layer;
    const isSelected = i === this.model.at;
    const bottom = this.height - UNDER;
    const [first, last] = [points[0], points.at(-1)];
    const line = this.outline(points);
    const ends = (point: CurvePoint | undefined): string => `${this.axis.x(point?.value ?? 0).toFixed(1)} ${bottom}`;
    const whole = `M${ends(first)}L${line}L${ends(last)}`;
    if (isSelected) this.colourGradient(points);
    return svg(
      "g",
      { class: `layer${isSelected ? " selected" : ""}${visible ? "" : " off"}`, style: `--colour: ${colourOfLayer(layer)}` },
      svg("path", { class: "area", d: `${whole}Z`, fill: isSelected ? "url(#opacity-colours)" : "var(--colour)" }),
      svg("path", { class: "line", d: whole }),
      svg("path", { class: "hit", d: whole, "data-layer": i }),
    );
  }

  private colourGradient(points: readonly CurvePoint[]): void {
    const [from, to] = [this.axis.x(points[0]?.value ?? 0), this.axis.x(points.at(-1)?.value ?? 1)];
    this.gradient.setAttribute("x1", String(from));
    this.gradient.setAttribute("x2", String(Math.max(to, from + 1e-3)));
    const stop = ({ value: at, colour }: CurvePoint): SVGStopElement =>
      svg("stop", { offset: (this.axis.x(at) - from) / Math.max(to - from, 1e-3), "stop-color": colour });
    this.gradient.replaceChildren(...points.map(stop));
  }

  /** Handles stay the same elements, so that focus and drags go on. */
  private showPoints(points: readonly CurvePoint[]): void {
    while (this.handles.length < points.length) this.handles.push(this.handle(this.handles.length));
    this.handles.forEach((handle, i) => {
      if (i >= points.length) handle.remove();
      else if (handle.parentNode !== this.points) this.points.append(handle);
    });
    points.forEach((point, i) => {
      const handle = this.handles[i];
      if (!handle) return;
      const isSelected = i === this.model.pointAt;
      handle.setAttribute("transform", `translate(${this.axis.x(point.value).toFixed(1)} ${this.y(point.opacity).toFixed(1)})`);
      handle.style.setProperty("--colour", point.colour);
      handle.classList.toggle("selected", isSelected);
      const set = (name: string, text: string | number): void => handle.setAttribute(name, String(text));
      set("aria-label", `point ${i + 1} of ${points.length}`);
      set("aria-valuemin", this.page.axis.low);
      set("aria-valuemax", this.page.axis.high);
      set("aria-valuenow", point.value);
      set("aria-valuetext", `value ${value(point.value)}, opacity ${value(point.opacity)}`);
    });
  }

  private handle(i: number): SVGGElement {
    const handle = svg(
      "g",
      { class: "point", role: "slider", tabindex: 0, "data-point": i },
      svg("circle", { class: "reach", r: 14 }),
      svg("circle", { class: "dot", r: 6.5 }),
    );
    handle.addEventListener("focus", () => this.model.select(this.model.at, i));
    handle.addEventListener("keydown", (event) => this.key(event));
    return handle;
  }

  private key(event: KeyboardEvent): void {
    const point = this.model.selectedPoint;
    if (!point || event.ctrlKey || event.metaKey || event.altKey) return;
    const step = event.shiftKey ? LARGE_STEP : STEP;
    const along = (by: number): void =>
      this.model.move(this.axis.tau(this.axis.x(point.value) + by * (this.axis.width - 2 * SIDE)), point.opacity, "keys");
    const up = (by: number): void =>
      this.model.move(point.value, Math.min(Math.max(Math.sqrt(point.opacity) + by, 0), 1) ** 2, "keys");
    const keys: Record<string, () => void> = {
      ArrowLeft: () => along(-step),
      ArrowRight: () => along(step),
      ArrowDown: () => up(-step),
      ArrowUp: () => up(step),
      PageDown: () => up(-LARGE_STEP),
      PageUp: () => up(LARGE_STEP),
      Delete: () => this.remove(),
      Backspace: () => this.remove(),
      Insert: () => this.addBeside(),
      Enter: () => this.addBeside(),
    };
    const run = keys[event.key];
    if (!run) return;
    run();
    event.preventDefault();
    event.stopPropagation();
  }

  remove(): void {
    if (!this.model.remove()) this.tell("A curve has at least two points.");
    else this.focusPoint();
  }

  addBeside(): void {
    if (this.model.addBeside()) this.focusPoint();
    else this.tell("The curve has as many points as a link can hold.");
  }

  private pixel(event: MouseEvent): [number, number] {
    const frame = this.element.getBoundingClientRect();
    return [event.clientX - frame.left, event.clientY - frame.top];
  }
  private clamped(x: number): number {
    return Math.min(Math.max(x, SIDE), this.axis.width - SIDE);
  }
  private valueAt(event: MouseEvent): number {
    return this.axis.tau(this.clamped(this.pixel(event)[0]));
  }

  /** A point is dragged; a press on the curve adds one, on another curve selects it. */
  private begin(event: PointerEvent): void {
    if (!event.isPrimary || event.button !== 0 || !(event.target instanceof Element)) return;
    const at = event.target.closest<SVGElement>("[data-point]")?.dataset.point;
    const layer = event.target.closest<SVGElement>("[data-layer]")?.dataset.layer;
    if (at !== undefined) this.model.select(this.model.at, Number(at));
    else if (layer !== undefined && Number(layer) !== this.model.at) return this.model.select(Number(layer));
    else if (layer === undefined || !this.model.add(this.valueAt(event), null, "drag")) return;
    const point = this.model.selectedPoint;
    if (!point) return;
    const [x, y] = this.pixel(event);
    this.drag = { offset: [this.axis.x(point.value) - x, this.y(point.opacity) - y], from: [x, y], moved: false };
    this.element.setPointerCapture(event.pointerId);
    event.preventDefault();
    this.focusPoint();
  }

  private moveTo(event: PointerEvent): void {
    if (!this.drag) return;
    const { offset, from } = this.drag;
    const [x, y] = this.pixel(event);
    this.drag.moved ||= Math.hypot(x - from[0], y - from[1]) > CLICK;
    if (this.drag.moved) this.model.move(this.axis.tau(this.clamped(x + offset[0])), this.opacity(y + offset[1]), "drag");
  }

  private end(): void {
    if (!this.drag) return;
    this.drag = null;
    this.model.finish();
  }

  private addAt(event: MouseEvent): void {
    if (event.target instanceof Element && event.target.closest("[data-point], [data-layer]")) return;
    if (this.model.add(this.valueAt(event), this.opacity(this.pixel(event)[1]))) this.focusPoint();
  }
}
