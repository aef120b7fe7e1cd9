// Emission and absorption along a ray, front to back (Max, 1995). matter_shader.ts does the same for every pixel.
import { meanBetween, type Matter } from "../ask/transfer";

/** Light that has come together so far: linear red, green, blue; opacity. */
export type Light = [number, number, number, number];

export const DARK: Light = [0, 0, 0, 0];

/** After a piece of matter of some length behind what is there already. */
export function behind(light: Light, [red, green, blue, extinction]: Matter, length: number): Light {
  if (extinction <= 0) return light;
  const more = (1 - light[3]) * (1 - Math.exp(-extinction * length));
  return [
    light[0] + (more * red) / extinction,
    light[1] + (more * green) / extinction,
    light[2] + (more * blue) / extinction,
    light[3] + more,
  ];
}

/** What a ray gathers from begin to end in steps; placeAt: the place of the value there in the table of transfer.ts. */
export function march(table: Float32Array, placeAt: (t: number) => number, begin: number, end: number, step: number): Light {
  let light = DARK;
  let before = placeAt(begin);
  for (let t = begin; t < end; t += step) {
    const next = Math.min(t + step, end);
    const place = placeAt(next);
    light = behind(light, meanBetween(table, before, place), next - t);
    before = place;
  }
  return light;
}
