// One slice: samples in grey, contours over them, and the crosshair. Seen along z: x to the right, y down; along y: x to the right, z up;
// along x: y to the right, z up (as `isoatlas render --slice`).
import { html } from "../../dom";
import type { Contour } from "./contours";
import { acrossAndDown, AXIS_NAMES, type AxisNumber, type Grid, type Triple } from "../state/grid";
import { greyOf, type Slice } from "../ask/wire_samples";

/** a press that moves less is a click */
const CLICK_PIXELS = 4;
const CROSSHAIR = "#ffd400";

export interface Wishes {
  /** the crosshair to a sample; dragging: more will come */
  move(voxel: Triple, dragging: boolean): void;
  step(axis: AxisNumber, by: number): void;
  /** what holds this sample */
  choose(voxel: Triple): void;
}

/** In pixels of the canvas: where sample 0, 0 is, and how long steps along columns and rows are. */
interface Frame {
  left: number;
  top: number;
  column: number;
  row: number;
}

export class SliceView {
  readonly element: HTMLElement;
  private readonly canvas = html("canvas", { tabindex: 0, role: "application" });
  private readonly caption = html("figcaption", {});
  private readonly grey = document.createElement("canvas");
  private painted: { slice: Slice; black: number; white: number } | null = null;
  private cross: Triple = [0, 0, 0];
  private readonly across: AxisNumber;
  private readonly down: AxisNumber;

  constructor(
    readonly axis: AxisNumber,
    private readonly grid: Grid,
    private readonly wishes: Wishes,
  ) {
    [this.across, this.down] = acrossAndDown(axis);
    this.element = html("figure", {}, this.canvas, this.caption);
    this.listen();
  }

  /** Grey values of the slice that is painted, for others to show. */
  get picture(): HTMLCanvasElement {
    return this.grey;
  }

  /** slice: null: it has still to come, the one before stays. Returns whether the grey picture is another one. */
  draw(slice: Slice | null, contours: Contour[], cross: Triple, [black, white]: readonly [number, number]): boolean {
    this.cross = cross;
    const fresh = slice !== null && (this.painted?.slice !== slice || this.painted.black !== black || this.painted.white !== white);
    if (slice && fresh) this.paint(slice, black, white);
    const size = this.grid.size[this.axis];
    const name = AXIS_NAMES[this.axis];
    const coarse = slice && slice.step > 1 ? `, every ${slice.step}th sample` : "";
    this.caption.textContent = `${name} ${cross[this.axis]} of ${size}${coarse}`;
    this.canvas.setAttribute(
      "aria-label",
      `slice ${cross[this.axis]} of ${size} along ${name}; arrows move the crosshair, page up and page down step, Enter selects what is there`,
    );
    this.compose(contours);
    return fresh;
  }

  private paint(slice: Slice, black: number, white: number): void {
    if (this.grey.width !== slice.columns || this.grey.height !== slice.rows) [this.grey.width, this.grey.height] = [slice.columns, slice.rows];
    this.grey.getContext("2d")?.putImageData(new ImageData(greyOf(slice, black, white), slice.columns, slice.rows), 0, 0);
    this.painted = { slice, black, white };
  }

  /** The slice in the middle of the canvas, in its true proportions. */
  private get frame(): Frame {
    const { width, height } = this.canvas;
    const [columns, rows] = [this.grid.size[this.across], this.grid.size[this.down]];
    const [wide, high] = [this.grid.spacing(this.across), this.grid.spacing(this.down)];
    const scale = Math.min(width / (columns * wide), height / (rows * high));
    const [column, row] = [scale * wide, scale * high];
    const left = (width - columns * column) / 2 + column / 2;
    if (this.axis === 2) return { left, top: (height - rows * row) / 2 + row / 2, column, row };
    return { left, top: (height + rows * row) / 2 - row / 2, column, row: -row };
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
    if (this.painted) this.drawGrey(pen, frame, this.painted.slice);
    for (const { colour, pieces } of contours) this.drawContour(pen, frame, pieces, colour, ratio);
    this.drawCrosshair(pen, frame, ratio);
  }

  private drawGrey(pen: CanvasRenderingContext2D, { left, top, column, row }: Frame, { step, columns, rows }: Slice): void {
    pen.imageSmoothingEnabled = Math.abs(column) < 3; // large samples are seen as what they are
    pen.setTransform(column * step, 0, 0, row * step, left - (column * step) / 2, top - (row * step) / 2);
    pen.drawImage(this.grey, 0, 0, columns, rows);
    pen.setTransform(1, 0, 0, 1, 0, 0);
  }

  /** Light and dark around it, so that it is seen on any grey. */
  private drawContour(pen: CanvasRenderingContext2D, { left, top, column, row }: Frame, pieces: Float32Array, colour: string, ratio: number): void {
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
    const x = left + column * this.cross[this.across];
    const y = top + row * this.cross[this.down];
    const gap = 6 * ratio;
    const right = left + column * (this.grid.size[this.across] - 1);
    const [high, low] = [top, top + row * (this.grid.size[this.down] - 1)].sort((p, q) => p - q) as [number, number];
    const path = new Path2D();
    for (const [x0, y0, x1, y1] of [[left, y, x - gap, y], [x + gap, y, right, y], [x, high, x, y - gap], [x, y + gap, x, low]] as const) {
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
    voxel[this.across] = ((event.clientX - box.left) * ratio - left) / column;
    voxel[this.down] = ((event.clientY - box.top) * ratio - top) / row;
    return this.grid.inside(voxel);
  }

  private listen(): void {
    let pressed: { x: number; y: number; far: boolean } | null = null;
    this.canvas.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      this.canvas.setPointerCapture(event.pointerId);
      pressed = { x: event.clientX, y: event.clientY, far: false };
      this.wishes.move(this.voxelAt(event), true);
    });
    this.canvas.addEventListener("pointermove", (event) => {
      if (!pressed) return;
      pressed.far ||= Math.hypot(event.clientX - pressed.x, event.clientY - pressed.y) > CLICK_PIXELS;
      if (pressed.far) this.wishes.move(this.voxelAt(event), true);
    });
    this.canvas.addEventListener("pointerup", (event) => {
      if (!pressed) return;
      const voxel = this.voxelAt(event);
      this.wishes.move(voxel, false);
      if (!pressed.far) this.wishes.choose(voxel);
      pressed = null;
    });
    this.canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.wishes.step(this.axis, event.deltaY < 0 ? 1 : -1);
    }, { passive: false });
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
    if (step) this.wishes.step(step[0], event.shiftKey ? 10 * step[1] : step[1]);
    else this.wishes.choose(this.cross);
  }
}
