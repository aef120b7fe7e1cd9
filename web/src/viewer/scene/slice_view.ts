// A slice: samples in grey, contours, and the crosshair. Along z: x to the right, y down; along y: x to the right, z up;
// along x: y to the right, z up (as `isoatlas render --slice`).
import { html } from "../../shared/dom";
import type { Contour } from "./contours";
import { acrossAndDown, AXIS_NAMES, type AxisNumber, type Grid, type Triple } from "../state/grid";
import type { Ruler, Texels } from "../state/ruler";
import { greyOf, type Slice } from "../api/wire_samples";

/** a press that moves less is a click */
const CLICK_PIXELS = 4;
const CROSSHAIR = "#ffd400";

export interface SliceViewEvents {
  /** moves the crosshair; dragging: during a drag */
  move(voxel: Triple, dragging: boolean): void;
  step(axis: AxisNumber, by: number): void;
  /** selects the object that contains this sample */
  pick(voxel: Triple): void;
}

/** In pixels of the canvas: position of sample 0, 0, and pixels per length along columns and rows; row: negative: upwards. */
interface Frame {
  left: number;
  top: number;
  column: number;
  row: number;
}

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
    private readonly events: SliceViewEvents,
  ) {
    [this.across, this.down] = acrossAndDown(axis);
    [this.columns, this.rows] = [grid.rulers[this.across], grid.rulers[this.down]];
    this.element = html("figure", {}, this.canvas, this.caption);
    this.listen();
  }

  /** The current grey image; null: none yet. */
  get picture(): Picture | null {
    return this.painted?.picture ?? null;
  }

  /** slice: null: not loaded, the previous one stays. Returns whether the grey image has changed. */
  draw(slice: Slice | null, contours: Contour[], cross: Triple, [black, white]: readonly [number, number]): boolean {
    this.cross = cross;
    const changed = slice !== null && (this.painted?.slice !== slice || this.painted.black !== black || this.painted.white !== white);
    if (slice && changed) this.paint(slice, black, white);
    const size = this.grid.size[this.axis];
    const name = AXIS_NAMES[this.axis];
    const coarse = slice && slice.step > 1 ? `, every ${slice.step}th sample` : "";
    this.caption.textContent = `${name} ${cross[this.axis]} of ${size}${coarse}`;
    const keys = "arrows move the crosshair, page up and page down change the slice, Enter picks the object";
    this.canvas.setAttribute("aria-label", `slice ${cross[this.axis]} of ${size} along ${name}; ${keys}`);
    this.compose(contours);
    return changed;
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
    const [across, down] = [endsOf(this.columns), endsOf(this.rows)];
    const scale = Math.min(width / (across.high - across.low), height / (down.high - down.low));
    const left = (width - scale * (across.low + across.high)) / 2;
    const row = this.axis === 2 ? scale : -scale;
    return { left, top: (height - row * (down.low + down.high)) / 2, column: scale, row };
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

  private drawGrey(pen: CanvasRenderingContext2D, { left, top, column, row }: Frame, { canvas, across, down }: Picture): void {
    const wide = (column * (across.high - across.low)) / canvas.width;
    const high = (row * (down.high - down.low)) / canvas.height;
    pen.imageSmoothingEnabled = wide < 3; // large pixels stay sharp
    pen.setTransform(wide, 0, 0, high, left + column * across.low, top + row * down.low);
    pen.drawImage(canvas, 0, 0);
    pen.setTransform(1, 0, 0, 1, 0, 0);
  }

  /** With a dark outline, for contrast on any grey. */
  private drawContour(
    pen: CanvasRenderingContext2D,
    { left, top, column, row }: Frame,
    pieces: Float32Array,
    colour: string,
    ratio: number,
  ): void {
    const path = new Path2D();
    for (let i = 0; i < pieces.length; i += 4) {
      path.moveTo(left + column * (pieces[i] as number), top + row * (pieces[i + 1] as number));
      path.lineTo(left + column * (pieces[i + 2] as number), top + row * (pieces[i + 3] as number));
    }
    pen.lineCap = "round";
    [pen.lineWidth, pen.strokeStyle] = [3.5 * ratio, "#0008"];
    pen.stroke(path);
    [pen.lineWidth, pen.strokeStyle] = [1.8 * ratio, colour];
    pen.stroke(path);
  }

  private drawCrosshair(pen: CanvasRenderingContext2D, { left, top, column, row }: Frame, ratio: number): void {
    const x = left + column * this.columns.length(this.cross[this.across]);
    const y = top + row * this.rows.length(this.cross[this.down]);
    const gap = 6 * ratio;
    const right = left + column * this.columns.length(this.columns.size - 1);
    const [high, low] = [top, top + row * this.rows.length(this.rows.size - 1)].sort((p, q) => p - q) as [number, number];
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
    const { left, top, column, row } = this.frame;
    const voxel: Triple = [...this.cross];
    voxel[this.across] = this.columns.sample(((event.clientX - box.left) * ratio - left) / column);
    voxel[this.down] = this.rows.sample(((event.clientY - box.top) * ratio - top) / row);
    return this.grid.inside(voxel);
  }

  private listen(): void {
    let pressed: { x: number; y: number; voxel: Triple; far: boolean } | null = null;
    this.canvas.addEventListener("pointerdown", (event) => {
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

  private press(event: KeyboardEvent): void {
    const upwards = this.axis === 2 ? -1 : 1;
    const steps: Record<string, [AxisNumber, number]> = {
      ArrowLeft: [this.across, -1],
      ArrowRight: [this.across, 1],
      ArrowUp: [this.down, upwards],
      ArrowDown: [this.down, -upwards],
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
