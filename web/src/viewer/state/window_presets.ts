// Windows of grey values: level and width, as radiologists name them, and the usual ones of CT.
import type { Page } from "../../shared/page";
import { isHounsfield } from "./hounsfield";
import { greyRange } from "./slice_state";

/** black = level - width / 2, white = level + width / 2 */
export interface Window {
  level: number;
  width: number;
}

/** The values of black and white. */
export type Grey = [black: number, white: number];

export interface Preset {
  /** in the menu; unique */
  name: string;
  /** null: from the histogram */
  grey: Grey | null;
}

export interface PresetGroup {
  /** empty: without a heading */
  title: string;
  presets: Preset[];
}

export function windowOf([black, white]: readonly [number, number]): Window {
  return { level: (black + white) / 2, width: white - black };
}

export function greyOfWindow({ level, width }: Window): Grey {
  return [level - width / 2, level + width / 2];
}

/** Of radiological practice, in Hounsfield units. */
const CT: [name: string, level: number, width: number][] = [
  ["Lung", -600, 1500],
  ["Mediastinum", 50, 350],
  ["Soft tissue", 40, 400],
  ["Abdomen", 50, 400],
  ["Brain", 40, 80],
  ["Bone", 400, 1800],
];
/** tau: isovalue of the selected object; null: none is selected. */
export function presetGroups(page: Pick<Page, "volume" | "histogram" | "axis">, tau: number | null): PresetGroup[] {
  const { low, high } = page.volume;
  const automatic = greyRange(page);
  const general: Preset[] = [{ name: "Automatic (0.5 % to 99.5 %)", grey: null }];
  if (low < high) general.push({ name: "Full range", grey: [low, high] });
  if (tau !== null) {
    const { width } = windowOf(automatic);
    general.push({ name: "Around the isovalue of the selected object", grey: greyOfWindow({ level: tau, width: width / 2 }) });
  }
  const groups: PresetGroup[] = [{ title: "", presets: general }];
  const isCt = isHounsfield(page);
  if (isCt === false) return groups;
  const presets = CT.map(([name, level, width]) => ({ name, grey: greyOfWindow({ level, width }), level }))
    .filter(({ grey: [black, white], level }) => black < high && white > low && (isCt || (level >= low && level <= high)))
    .map(({ name, grey }) => ({ name, grey }));
  return presets.length > 0 ? [...groups, { title: isCt ? "CT" : "CT (HU)", presets }] : groups;
}

/** The preset with these values, up to the digits of an address; null: none. */
export function presetOf(groups: readonly PresetGroup[], grey: readonly number[] | null): Preset | null {
  const all = groups.flatMap(({ presets }) => presets);
  return all.find((preset) => (preset.grey === null || grey === null ? preset.grey === grey : isNear(preset.grey, grey))) ?? null;
}

function isNear(a: readonly number[], b: readonly number[]): boolean {
  const size = Math.max(...a.map(Math.abs), ...b.map(Math.abs));
  return a.every((n, i) => Math.abs(n - b[i]!) <= 2e-6 * size);
}

/** a drag over so many pixels multiplies the width by e, or moves the level by the width */
const DRAG_PIXELS = 200;

/** After a drag on a slice, as in viewers of DICOM: to the right: wider; down: a higher level, darker. */
export function draggedWindow({ level, width }: Window, right: number, down: number): Window {
  return { level: level + (width * down) / DRAG_PIXELS, width: width * Math.exp(right / DRAG_PIXELS) };
}

/** With a width that the digits of an address tell apart, and values not far outside those of the volume. */
export function boundedGrey({ level, width }: Window, { volume }: Pick<Page, "volume">): Grey {
  const range = volume.high - volume.low || Math.abs(volume.high) || 1;
  const inside = Math.min(Math.max(level, volume.low - range), volume.high + range);
  const smallest = Math.max(1e-4 * range, 1e-5 * Math.abs(inside));
  return greyOfWindow({ level: inside, width: Math.min(Math.max(width, smallest), 10 * range) });
}
