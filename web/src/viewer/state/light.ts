// Colours and light: sRGB and linear (IEC 61966-2-1).

/** Linear red, green, blue, 0 to 1. */
export type Light = [number, number, number];

/** Of #rrggbb. */
export function linearOf(colour: string): Light {
  const parts = [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16) / 255);
  return parts.map((part) => (part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4)) as Light;
}

/** #rrggbb, the nearest. */
export function colourOfLight(light: Light): string {
  const bytes = light.map((part) => Math.round(255 * (part <= 0.0031308 ? 12.92 * part : 1.055 * part ** (1 / 2.4) - 0.055)));
  return `#${bytes.map((byte) => Math.min(255, Math.max(0, byte)).toString(16).padStart(2, "0")).join("")}`;
}
