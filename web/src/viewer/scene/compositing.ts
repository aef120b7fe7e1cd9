// Emission-absorption model along a ray, front to back (Max, 1995). volume_shader.ts computes the same per pixel.
import { meanBetween, type Medium } from "../api/transfer_function";

/** Accumulated linear red, green, blue (premultiplied); opacity. */
export type Composite = [number, number, number, number];

export const TRANSPARENT: Composite = [0, 0, 0, 0];

/** Composites a segment of the medium behind what is accumulated. */
export function compositeBehind(light: Composite, [red, green, blue, extinction]: Medium, length: number): Composite {
  if (extinction <= 0) return light;
  const more = (1 - light[3]) * (1 - Math.exp(-extinction * length));
  return [
    light[0] + (more * red) / extinction,
    light[1] + (more * green) / extinction,
    light[2] + (more * blue) / extinction,
    light[3] + more,
  ];
}

/** Marches a ray from begin to end; placeAt: place of the value at t in the table of api/transfer_function.ts. */
export function march(table: Float32Array, placeAt: (t: number) => number, begin: number, end: number, step: number): Composite {
  let light = TRANSPARENT;
  let before = placeAt(begin);
  for (let t = begin; t < end; t += step) {
    const next = Math.min(t + step, end);
    const place = placeAt(next);
    light = compositeBehind(light, meanBetween(table, before, place), next - t);
    before = place;
  }
  return light;
}
