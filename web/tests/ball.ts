// A volume that is a ball of any radius, depending on the isovalue, and what a browser shows in the middle of it.
import { writeFileSync } from "node:fs";
import type { Page as Tab } from "playwright-core";

export const SIDE = 41;
export const SPACING = 0.5;
export const RADIUS = 7;
export const MIDDLE = (SIDE - 1) / 2;

/** 100 - 10 times the distance to the middle in mm: a ball of radius r at 100 - 10 r. */
export function ballFile(path: string): void {
  const samples = new Float32Array(SIDE ** 3);
  for (let i = 0; i < samples.length; ++i) {
    const [x, y, z] = [i % SIDE, Math.floor(i / SIDE) % SIDE, Math.floor(i / SIDE / SIDE)];
    samples[i] = 100 - 10 * SPACING * Math.hypot(x - MIDDLE, y - MIDDLE, z - MIDDLE);
  }
  const header = [
    "NRRD0004",
    "type: float",
    "dimension: 3",
    `sizes: ${SIDE} ${SIDE} ${SIDE}`,
    "encoding: raw",
    "endian: little",
    "space: left-posterior-superior",
    `space directions: (${SPACING},0,0) (0,${SPACING},0) (0,0,${SPACING})`,
    'space units: "mm" "mm" "mm"',
  ];
  writeFileSync(path, Buffer.concat([Buffer.from(`${header.join("\n")}\n\n`), Buffer.from(samples.buffer)]));
}

/** RGBA in the middle of the viewport, 0 to 255. */
export function middlePixel(tab: Tab): Promise<number[]> {
  return tab.evaluate(() => {
    const canvas = document.querySelector<HTMLCanvasElement>(".viewport > canvas")!;
    const copy = document.createElement("canvas");
    [copy.width, copy.height] = [1, 1];
    const pen = copy.getContext("2d")!;
    pen.drawImage(canvas, canvas.width / 2, canvas.height / 2, 1, 1, 0, 0, 1, 1);
    return [...pen.getImageData(0, 0, 1, 1).data];
  });
}
