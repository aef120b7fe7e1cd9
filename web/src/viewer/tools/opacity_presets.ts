// Opacity curves that do not come from the tree. Where they end at the end of the axis, everything beyond is as there.
import { value } from "../../shared/format";
import type { Page } from "../../shared/page";
import { isOfLowValues, branchOf, entryOf } from "../../shared/page";
import { colourOfShown, EVERYTHING } from "../api/entries";
import { isHounsfield } from "../state/hounsfield";
import { cutOff, type CurvePoint, type Layer } from "../state/opacity_curve";
import { GREY, greyRange } from "../state/slice_state";
import type { State } from "../state/state";

export interface Preset {
  name: string;
  title: string;
  layers: Layer[];
}

type Stop = [value: number, opacity: number, colour: string];

/** opacity of a voxel where a preset is at its densest, unless it says otherwise */
const DENSE = 0.4;
/** opacity of a voxel at the bright end of a ramp: what is behind it stays visible */
const RAMP_END = 0.15;
/** of the axis: width of the edge at an isovalue, as a jump would show the steps of the samples */
const EDGE = 0.01;

/**
 * Named ranges of Hounsfield units: what is denser than soft tissue is bone (from 150; compact bone from 700); soft tissue
 * is between fat (-100) and what a contrast agent does (240); lung is mostly air, -950 to -600, its vessels' walls pass -600
 * to -400 on the way to soft tissue.
 */
const CT: [name: string, title: string, stops: Stop[]][] = [
  [
    "CT bone",
    "150 HU and more; compact bone from 700 HU",
    [
      [150, 0, "#b5764d"],
      [300, 0.12, "#e0b98a"],
      [700, 0.4, "#f5ead2"],
      [Infinity, 0.6, "#ffffff"],
    ],
  ],
  [
    "CT soft tissue",
    "-100 to 240 HU, from fat to contrast agent",
    [
      [-120, 0, "#e8c07a"],
      [-60, 0.006, "#e8c07a"],
      [0, 0.015, "#d98c6a"],
      [60, 0.06, "#b5483c"],
      [200, 0.1, "#e8a090"],
      [240, 0, "#e8a090"],
    ],
  ],
  [
    "CT lung",
    "-950 to -400 HU: air in lungs and the surface of vessels and airways",
    [
      [-950, 0, "#56b4e9"],
      [-850, 0.003, "#56b4e9"],
      [-700, 0.02, "#7fb2cc"],
      [-550, 0.3, "#b8503c"],
      [-400, 0, "#b8503c"],
    ],
  ],
];

export function presetsOf(page: Page, state: State): Preset[] {
  const { low, high } = page.axis;
  if (!(low < high)) return [];
  return [rampOverWindow(page, state), ...beyondIsovalue(page, state), ...ctPresets(page)];
}

function rampOverWindow(page: Page, state: State): Preset {
  const [black, white] = (GREY.of(state) as [number, number] | null) ?? greyRange(page);
  const stops: Stop[] = [
    [black, 0, "#202020"],
    [white, RAMP_END, "#ffffff"],
    [page.axis.high, RAMP_END, "#ffffff"],
  ];
  return preset(page, "Ramp over window", `from ${value(black)}, black and clear, to ${value(white)}, white`, stops);
}

/** Of the selected object; none: nothing is selected. */
function beyondIsovalue(page: Page, state: State): Preset[] {
  const shown = state.shown[state.selected];
  if (!shown) return [];
  const isLow =
    shown.entry === EVERYTHING ? page.polarity === "low" : isOfLowValues(page, branchOf(page, entryOf(page, shown.entry).branch));
  const { low, high } = page.axis;
  const edge = EDGE * (high - low);
  const colour = colourOfShown(page, shown);
  const sign = isLow ? "≤" : "≥";
  const stops: Stop[] = isLow
    ? [
        [low, DENSE, colour],
        [shown.tau, DENSE, colour],
        [shown.tau + edge, 0, colour],
      ]
    : [
        [shown.tau - edge, 0, colour],
        [shown.tau, DENSE, colour],
        [high, DENSE, colour],
      ];
  return [
    preset(page, `Only ${sign} ${value(shown.tau)}`, "only values beyond the isovalue of the selected object", stops, shown.tau),
  ];
}

/** Those whose values the volume has. */
function ctPresets(page: Page): Preset[] {
  const isHu = isHounsfield(page);
  if (isHu === false) return [];
  const { low, high } = page.axis;
  const known = CT.filter(([, , stops]) => stops.some(([at, opacity]) => opacity > 0 && at > low && at < high));
  const doubt = isHu ? "" : "; if the values are Hounsfield units, which the file does not say";
  return known.map(([name, title, stops]) => preset(page, name, title + doubt, stops));
}

/** Cut off at the ends of the axis. */
function preset(page: Page, name: string, title: string, stops: Stop[], tau: number | null = null): Preset {
  const { low, high } = page.axis;
  const points = stops.map(([at, opacity, colour]): CurvePoint => ({ value: at === Infinity ? high : at, opacity, colour }));
  return { name, title, layers: [{ points: cutOff(points, low, high), visible: true, tau }] };
}
