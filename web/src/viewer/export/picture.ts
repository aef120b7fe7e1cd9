// Image of the scene in any size, optionally with a scale bar and a legend.
import { value } from "../../shared/format";
import type { ViewerContext } from "../context/viewer_context";
import { shownQuantity } from "../../shared/units";
import { roundLength } from "../scene/scale_bar";
import { noteOf } from "../panels/scene_panel";
import { colourOfShown, titleOf } from "../api/entries";
import type { State } from "../state/state";

export interface PictureOptions {
  width: number;
  height: number;
  scaleBar: boolean;
  legend: boolean;
  /** null: transparent */
  background: string | null;
  textColour: string;
}

/** Draws the current content of the viewport. */
export function drawPicture(context: ViewerContext, options: PictureOptions, state: State = context.history.now): HTMLCanvasElement {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [options.width, options.height];
  const pen = canvas.getContext("2d") as CanvasRenderingContext2D;
  if (options.background) {
    pen.fillStyle = options.background;
    pen.fillRect(0, 0, options.width, options.height);
  }
  context.viewport.renderToImage(options.width, options.height, (drawn) => pen.drawImage(drawn, 0, 0));
  const letter = Math.max(11, Math.round(Math.min(options.width, options.height) / 45));
  pen.font = `${letter}px system-ui, sans-serif`;
  pen.fillStyle = pen.strokeStyle = options.textColour;
  if (options.scaleBar) drawScale(pen, context, options, letter);
  if (options.legend) drawLegend(pen, context, state, letter);
  return canvas;
}

function drawScale(
  pen: CanvasRenderingContext2D,
  { viewport, page }: ViewerContext,
  { width, height }: PictureOptions,
  letter: number,
): void {
  const { amount, unit } = shownQuantity(viewport.rig.height, page.volume.unit, 1);
  const length = roundLength(amount / 4);
  const pixels = (height * length) / amount;
  const [left, bottom] = [width - pixels - letter, height - 1.8 * letter];
  pen.lineWidth = Math.max(1, letter / 6);
  pen.beginPath();
  pen.moveTo(left, bottom - letter / 2);
  pen.lineTo(left, bottom);
  pen.lineTo(left + pixels, bottom);
  pen.lineTo(left + pixels, bottom - letter / 2);
  pen.stroke();
  pen.textAlign = "center";
  pen.fillText(`${value(length)} ${unit ?? (length === 1 ? "voxel" : "voxels")}`, left + pixels / 2, height - letter / 2);
  pen.textAlign = "left";
}

function drawLegend(pen: CanvasRenderingContext2D, { page, scene }: ViewerContext, state: State, letter: number): void {
  const textColour = pen.fillStyle;
  state.shown
    .filter(({ visible }) => visible)
    .forEach((shown, i) => {
      const y = letter * (1.4 + 1.5 * i);
      pen.fillStyle = colourOfShown(page, shown);
      pen.fillRect(letter, y - letter * 0.8, letter * 0.9, letter * 0.9);
      pen.fillStyle = textColour;
      const [where] = noteOf(shown, scene.loadStateOf(shown.entry)).split(",");
      pen.fillText(
        `${titleOf(page, shown.entry)} ${where ?? ""}${page.volume.valueUnit ? ` ${page.volume.valueUnit}` : ""}`,
        letter * 2.3,
        y,
      );
    });
}

export async function pngOf(canvas: HTMLCanvasElement): Promise<Blob> {
  const blob = await new Promise<Blob | null>((resolve) => canvas.toBlob(resolve, "image/png"));
  if (!blob) throw new Error("The browser cannot create an image of this size.");
  return blob;
}
