// The scene as a picture of any size, with a scale bar and a legend if they are wanted.
import { value } from "../../format";
import type { Desk } from "../desk/desk";
import { roundLength } from "../draw/scale_bar";
import { noteOf } from "../inspect/scene_panel";
import { colourOfShown, titleOf } from "../ask/shown";
import type { State } from "../state/state";

export interface PictureWishes {
  width: number;
  height: number;
  scaleBar: boolean;
  legend: boolean;
  /** a colour; null: transparent */
  background: string | null;
  ink: string;
}

/** Draws what the stage shows now. */
export function drawPicture(desk: Desk, wishes: PictureWishes, state: State = desk.history.now): HTMLCanvasElement {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [wishes.width, wishes.height];
  const pen = canvas.getContext("2d") as CanvasRenderingContext2D;
  if (wishes.background) {
    pen.fillStyle = wishes.background;
    pen.fillRect(0, 0, wishes.width, wishes.height);
  }
  desk.stage.shoot(wishes.width, wishes.height, (drawn) => pen.drawImage(drawn, 0, 0));
  const letter = Math.max(11, Math.round(Math.min(wishes.width, wishes.height) / 45));
  pen.font = `${letter}px system-ui, sans-serif`;
  pen.fillStyle = pen.strokeStyle = wishes.ink;
  if (wishes.scaleBar) drawScale(pen, desk, wishes, letter);
  if (wishes.legend) drawLegend(pen, desk, state, letter);
  return canvas;
}

function drawScale(pen: CanvasRenderingContext2D, { stage, page }: Desk, { width, height }: PictureWishes, letter: number): void {
  const length = roundLength(stage.eye.height / 4);
  const pixels = (height * length) / stage.eye.height;
  const [left, bottom] = [width - pixels - letter, height - 1.8 * letter];
  pen.lineWidth = Math.max(1, letter / 6);
  pen.beginPath();
  pen.moveTo(left, bottom - letter / 2);
  pen.lineTo(left, bottom);
  pen.lineTo(left + pixels, bottom);
  pen.lineTo(left + pixels, bottom - letter / 2);
  pen.stroke();
  pen.textAlign = "center";
  pen.fillText(`${value(length)} ${page.volume.unit ?? (length === 1 ? "voxel" : "voxels")}`, left + pixels / 2, height - letter / 2);
  pen.textAlign = "left";
}

function drawLegend(pen: CanvasRenderingContext2D, { page, scene }: Desk, state: State, letter: number): void {
  const ink = pen.fillStyle;
  state.shown
    .filter(({ visible }) => visible)
    .forEach((shown, i) => {
      const y = letter * (1.4 + 1.5 * i);
      pen.fillStyle = colourOfShown(page, shown);
      pen.fillRect(letter, y - letter * 0.8, letter * 0.9, letter * 0.9);
      pen.fillStyle = ink;
      const [where] = noteOf(shown, scene.arrivalOf(shown.entry)).split(",");
      pen.fillText(
        `${titleOf(page, shown.entry)} ${where ?? ""}${page.volume.valueUnit ? ` ${page.volume.valueUnit}` : ""}`,
        letter * 2.3,
        y,
      );
    });
}

export async function pngOf(canvas: HTMLCanvasElement): Promise<Blob> {
  const blob = await new Promise<Blob | null>((resolve) => canvas.toBlob(resolve, "image/png"));
  if (!blob) throw new Error("The browser cannot make a picture of this size.");
  return blob;
}
