// How a slice lies on the screen. Anatomical volumes as radiologists see them: the patient's right on the left, anterior
// above or on the left, superior above. Others: along z: x to the right, y down; along y: x to the right, z up; along x: y
// to the right, z up; the last two turned by half where -z is up (as `isoatlas render --slice --flat`).
import { anatomicalAxes, isOblique, nearestDirections, opposite, type Direction } from "./directions";
import { acrossAndDown, type AxisNumber, type Grid } from "./grid";

/** An axis of the volume on the screen: its direction to the right or downwards is positive or negative. */
export interface ScreenAxis {
  axis: AxisNumber;
  sign: 1 | -1;
}

export interface SliceLayout {
  right: ScreenAxis;
  down: ScreenAxis;
  /** where the four sides look */
  sides: Record<"left" | "right" | "top" | "bottom", Direction>;
  /** "axial", "oblique coronal", ...; empty: not anatomical */
  plane: string;
}

/** By the letters of the axis across the slice: its name, and what is to the right and below. */
const PLANES: [normal: string, plane: string, right: string, down: string][] = [
  ["SI", "axial", "L", "P"],
  ["PA", "coronal", "L", "I"],
  ["LR", "sagittal", "P", "I"],
];

/** up: of the view; only the sign of z counts, and not for anatomical volumes. */
export function sliceLayout(axis: AxisNumber, grid: Grid, space: string, up: readonly number[]): SliceLayout {
  const directions = nearestDirections(space, grid.directions);
  const plane = anatomicalAxes(space) && PLANES.find(([normal]) => normal.includes(directions[axis]!.letter));
  const [first, second] = acrossAndDown(axis);
  const isTurned = axis !== 2 && (up[2] ?? 1) < 0;
  let [right, down]: [ScreenAxis, ScreenAxis] = [
    { axis: first, sign: isTurned ? -1 : 1 },
    { axis: second, sign: axis === 2 || isTurned ? 1 : -1 },
  ];
  if (plane) {
    const towards = (letter: string): ScreenAxis => {
      const found = pairOf(letter).includes(directions[first]!.letter) ? first : second;
      return { axis: found, sign: directions[found]!.letter === letter ? 1 : -1 };
    };
    [right, down] = [towards(plane[2]), towards(plane[3])];
  }
  const seen = ({ axis: own, sign }: ScreenAxis): Direction => (sign > 0 ? directions[own]! : opposite(space, directions[own]!));
  const [toRight, toBottom] = [seen(right), seen(down)];
  const isTilted = isOblique(grid.directions[first], grid.directions[second]);
  return {
    right,
    down,
    sides: { left: opposite(space, toRight), right: toRight, top: opposite(space, toBottom), bottom: toBottom },
    plane: plane ? `${isTilted ? "oblique " : ""}${plane[1]}` : "",
  };
}

/** The letters of both ends of its axis. */
function pairOf(letter: string): string {
  return PLANES.find(([normal]) => normal.includes(letter))?.[0] ?? "";
}

/** "left is the patient's right, top is anterior": for screen readers. */
export function sidesInWords({ sides }: SliceLayout): string {
  return `left side is ${sides.left.words}, top is ${sides.top.words}`;
}
