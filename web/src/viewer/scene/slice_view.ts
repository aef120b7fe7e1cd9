// A slice: samples in grey, contours, the crosshair, and where its sides look. state/slice_layout.ts says how it lies.
import { html } from "../../shared/dom";
import type { Contour } from "./contours";
import { acrossAndDown, AXIS_NAMES, type AxisNumber, type Grid, type Triple } from "../state/grid";
import type { Ruler, Texels } from "../state/ruler";
import { sidesInWords, type SliceLayout } from "../state/slice_layout";
import { greyOf, type Slice } from "../api/wire_samples";

/** a press that moves less is a click */
const CLICK_PIXELS = 4;
const CROSSHAIR = "#ffd400";
const SIDES = ["left", "right", "top", "bottom"] as const;

export interface SliceViewEvents {
  /** moves the crosshair; dragging: during a drag */
  move(voxel: Triple, dragging: boolean): void;
  step(axis: AxisNumber, by: number): void;
  /** selects the object that contains this sample */
  pick(voxel: Triple): void;
  /** drags the window of grey values, in CSS pixels since the press, to the right and down; done: released */
  dragWindow(right: number, down: number, done: boolean): void;
}

/**
 * Maps lengths along columns and rows to pixels of the canvas: x = a u + c v + e, y = b u + d v + f. Each of x and y
 * depends on one of them.
 */
type Frame = Record<"a" | "b" | "c" | "d" | "e" | "f", number>;

/** Grey values of a slice, and their extent along columns and rows. */
export interface Picture {
  canvas: HTMLCanvasElement;
  across: Texels;
  down: Texels;
}

/** From the outer side of the first sample to that of the last one. */
function endsOf(ruler: Ruler): { low: number; high: number } {
  return { low: ruler.length(-0.5), high: ruler.length(ruler.size - 0.5) };
}

export class SliceView {
  readonly element: HTMLElement;
  /** the letters at the sides; their words are in the label of the canvas */
  private readonly letters = SIDES.map((side) => html("span", { class: `side-letter ${side}`, "aria-hidden": "true" }));
  private readonly canvas = html("canvas", { tabindex: 0, role: "application" });
  private readonly caption = html("figcaption", {});
  private readonly grey = document.createElement("canvas");
  private painted: { slice: Slice; black: number; white: number; picture: Picture } | null = null;
  private cross: Triple = [0, 0, 0];
  private readonly across: AxisNumber;
  private readonly down: AxisNumber;
  private readonly columns: Ruler;
  private readonly rows: Ruler;

  constructor(
    readonly axis: AxisNumber,
    private readonly grid: Grid,
    private layout: SliceLayout,
    private readonly events: SliceViewEvents,
  ) {
    [this.across, this.down] = acrossAndDown(axis);
    [this.columns, this.rows] = [grid.rulers[this.across], grid.rulers[this.down]];
    this.element = html("figure", {}, this.canvas, ...this.letters, this.caption);
    this.listen();
  }

  /** The current grey image; null: none yet. */
  get picture(): Picture | null {
    return this.painted?.picture ?? null;
  }

  /** slice: null: not loaded, the previous one stays. Returns whether the grey image has changed. */
  draw(
    slice: Slice | null,
    contours: Contour[],
    cross: Triple,
    [black, white]: readonly [number, number],
    layout: SliceLayout,
  ): boolean {
    this.cross = cross;
    this.layout = layout;
    const changed = slice !== null && (this.painted?.slice !== slice || this.painted.black !== black || this.painted.white !== white);
    if (slice && changed) this.paint(slice, black, white);
    this.describe(slice);
    this.compose(contours);
    return changed;
  }

  private describe(slice: Slice | null): void {
    const { plane, sides } = this.layout;
    const [index, size, name] = [this.cross[this.axis], this.grid.size[this.axis], AXIS_NAMES[this.axis]];
    const coarse = slice && slice.step > 1 ? `, every ${slice.step}th sample` : "";
    this.caption.replaceChildren(`${plane && `${plane}, `}${name} ${index}`, html("span", {}, ` of ${size}${coarse}`));
    SIDES.forEach((side, i) => (this.letters[i]!.textContent = sides[side].letter));
    const keys = "arrows move the crosshair, page up and page down change the slice, Enter picks the object";
    const what = `${plane || "slice"} ${plane && "slice "}${index} of ${size} along ${name}`;
    this.canvas.setAttribute("aria-label", `${what}; ${sidesInWords(this.layout)}; ${keys}`);
  }

  private paint(slice: Slice, black: number, white: number): void {
    const [across, down] = [this.columns.texels(slice.step), this.rows.texels(slice.step)];
    const [width, height] = [across.samples.length, down.samples.length];
    if (this.grey.width !== width || this.grey.height !== height) [this.grey.width, this.grey.height] = [width, height];
    const pixels = greyOf(slice, across.samples, down.samples, black, white);
    this.grey.getContext("2d")?.putImageData(new ImageData(pixels, width, height), 0, 0);
    this.painted = { slice, black, white, picture: { canvas: this.grey, across, down } };
  }

  /** Centres the slice on the canvas, with correct proportions. */
  private get frame(): Frame {
    const { width, height } = this.canvas;
    const { right, down } = this.layout;
    const [across, along] = [endsOf(this.grid.rulers[right.axis]), endsOf(this.grid.rulers[down.axis])];
    const scale = Math.min(width / (across.high - across.low), height / (along.high - along.low));
    const [x, y] = [right.sign * scale, down.sign * scale];
    const e = (width - x * (across.low + across.high)) / 2;
    const f = (height - y * (along.low + along.high)) / 2;
    return right.axis === this.across ? { a: x, b: 0, c: 0, d: y, e, f } : { a: 0, b: y, c: x, d: 0, e, f };
  }

  private compose(contours: Contour[]): void {
    const pen = this.canvas.getContext("2d");
    const ratio = Math.min(devicePixelRatio, 2);
    const [width, height] = [Math.round(this.canvas.clientWidth * ratio), Math.round(this.canvas.clientHeight * ratio)];
    if (!pen || width === 0 || height === 0) return;
    if (this.canvas.width !== width || this.canvas.height !== height) [this.canvas.width, this.canvas.height] = [width, height];
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.clearRect(0, 0, width, height);
    const frame = this.frame;
    if (this.painted) this.drawGrey(pen, frame, this.painted.picture);
    for (const { colour, pieces } of contours) this.drawContour(pen, frame, pieces, colour, ratio);
    this.drawCrosshair(pen, frame, ratio);
  }

  private drawGrey(pen: CanvasRenderingContext2D, { a, b, c, d, e, f }: Frame, { canvas, across, down }: Picture): void {
    const wide = (across.high - across.low) / canvas.width;
    const high = (down.high - down.low) / canvas.height;
    pen.imageSmoothingEnabled = Math.abs((a + b) * wide) < 3; // large pixels stay sharp
    const corner = [a * across.low + c * down.low + e, b * across.low + d * down.low + f] as const;
    pen.setTransform(a * wide, b * wide, c * high, d * high, ...corner);
    pen.drawImage(canvas, 0, 0);
    pen.setTransform(1, 0, 0, 1, 0, 0);
  }

  /** With a dark outline, for contrast on any grey. */
  private drawContour(
    pen: CanvasRenderingContext2D,
    { a, b, c, d, e, f }: Frame,
    pieces: Float32Array,
    colour: string,
    ratio: number,
  ): void {
    const path = new Path2D();
    const at = (i: number): [number, number] => {
      const [u, v] = [pieces[i]!, pieces[i + 1]!];
      return [a * u + c * v + e, b * u + d * v + f];
    };
    for (let i = 0; i < pieces.length; i += 4) {
      path.moveTo(...at(i));
      path.lineTo(...at(i + 2));
    }
    pen.lineCap = "round";
    [pen.lineWidth, pen.strokeStyle] = [3.5 * ratio, "#0008"];
    pen.stroke(path);
    [pen.lineWidth, pen.strokeStyle] = [1.8 * ratio, colour];
    pen.stroke(path);
  }

  private drawCrosshair(pen: CanvasRenderingContext2D, { a, b, c, d, e, f }: Frame, ratio: number): void {
    const at = (u: number, v: number): [number, number] => [a * u + c * v + e, b * u + d * v + f];
    const [x, y] = at(this.columns.length(this.cross[this.across]), this.rows.length(this.cross[this.down]));
    const gap = 6 * ratio;
    const ends = [at(0, 0), at(this.columns.length(this.columns.size - 1), this.rows.length(this.rows.size - 1))] as const;
    const [left, right] = [ends[0][0], ends[1][0]].sort((p, q) => p - q) as [number, number];
    const [high, low] = [ends[0][1], ends[1][1]].sort((p, q) => p - q) as [number, number];
    const path = new Path2D();
    for (const [x0, y0, x1, y1] of [
      [left, y, x - gap, y],
      [x + gap, y, right, y],
      [x, high, x, y - gap],
      [x, y + gap, x, low],
    ] as const) {
      path.moveTo(x0, y0);
      path.lineTo(x1, y1);
    }
    [pen.lineWidth, pen.strokeStyle] = [2.6 * ratio, "#0006"];
    pen.stroke(path);
    [pen.lineWidth, pen.strokeStyle] = [1 * ratio, CROSSHAIR];
    pen.stroke(path);
  }

  private voxelAt(event: MouseEvent): Triple {
    const box = this.canvas.getBoundingClientRect();
    const ratio = this.canvas.width / box.width;
    const { a, b, c, d, e, f } = this.frame;
    const [x, y] = [(event.clientX - box.left) * ratio - e, (event.clientY - box.top) * ratio - f];
    const [u, v] = a !== 0 ? [x / a, y / d] : [y / b, x / c];
    const voxel: Triple = [...this.cross];
    voxel[this.across] = this.columns.sample(u);
    voxel[this.down] = this.rows.sample(v);
    return this.grid.inside(voxel);
  }

  private listen(): void {
    let pressed: { x: number; y: number; voxel: Triple; far: boolean } | null = null;
    this.canvas.addEventListener("pointerdown", (event) => {
      if (pressesWindow(event)) return this.followWindow(event);
      if (event.button !== 0) return;
      this.canvas.setPointerCapture(event.pointerId);
      pressed = { x: event.clientX, y: event.clientY, voxel: this.voxelAt(event), far: false };
      this.events.move(pressed.voxel, true);
    });
    this.canvas.addEventListener("pointermove", (event) => {
      if (!pressed) return;
      pressed.far ||= Math.hypot(event.clientX - pressed.x, event.clientY - pressed.y) > CLICK_PIXELS;
      if (pressed.far) this.events.move(this.voxelAt(event), true);
    });
    this.canvas.addEventListener("pointerup", (event) => {
      if (!pressed) return;
      const voxel = pressed.far ? this.voxelAt(event) : pressed.voxel;
      this.events.move(voxel, false);
      if (!pressed.far) this.events.pick(voxel);
      pressed = null;
    });
    this.canvas.addEventListener("contextmenu", (event) => event.preventDefault()); // the right button drags the window
    this.canvas.addEventListener(
      "wheel",
      (event) => {
        event.preventDefault();
        this.events.step(this.axis, event.deltaY < 0 ? 1 : -1);
      },
      { passive: false },
    );
    this.canvas.addEventListener("keydown", (event) => this.press(event));
  }

  /** Drags the window of grey values until the button is released. */
  private followWindow(start: PointerEvent): void {
    start.preventDefault(); // no scrolling with the middle button
    this.canvas.setPointerCapture(start.pointerId);
    const drag = (event: PointerEvent): void =>
      this.events.dragWindow(event.clientX - start.clientX, event.clientY - start.clientY, event.type !== "pointermove");
    const end = (event: PointerEvent): void => {
      this.canvas.removeEventListener("pointermove", drag);
      for (const type of ENDS) this.canvas.removeEventListener(type, end);
      drag(event);
    };
    this.canvas.addEventListener("pointermove", drag);
    for (const type of ENDS) this.canvas.addEventListener(type, end);
  }

  private press(event: KeyboardEvent): void {
    const { right, down } = this.layout;
    const steps: Record<string, [AxisNumber, number]> = {
      ArrowLeft: [right.axis, -right.sign],
      ArrowRight: [right.axis, right.sign],
      ArrowUp: [down.axis, -down.sign],
      ArrowDown: [down.axis, down.sign],
      PageUp: [this.axis, 1],
      PageDown: [this.axis, -1],
    };
    const step = steps[event.key];
    if (event.ctrlKey || event.metaKey || event.altKey || (!step && event.key !== "Enter")) return;
    event.preventDefault();
    event.stopPropagation();
    if (step) this.events.step(step[0], event.shiftKey ? 10 * step[1] : step[1]);
    else this.events.pick(this.cross);
  }
}

const ENDS = ["pointerup", "pointercancel"] as const;

/** The right or the middle button, or the left one with Ctrl or Alt. */
function pressesWindow({ button, ctrlKey, altKey }: PointerEvent): boolean {
  return button === 1 || button === 2 || (button === 0 && (ctrlKey || altKey));
}
