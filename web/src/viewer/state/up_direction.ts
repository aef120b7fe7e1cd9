// The direction upwards of the 3D view: orbits turn around it, standard views stand on it. `isoatlas render --up`.
import type { Page } from "../../shared/page";
import { unitAlong, unitTowards } from "./directions";
import { cross, dot, type Triple } from "./grid";
import { numbersIn, Part, textOf } from "./part";
import type { State } from "./state";

const WORDS = ["z", "-z", "y", "-y", "x", "-x"] as const;
/** An axis of space. */
export type UpWord = (typeof WORDS)[number];
export const UP_WORDS: readonly UpWord[] = WORDS;

/** unit vectors that differ less, by component, are the same direction */
const SAME = 1e-6;

export function vectorOf(word: UpWord): Triple {
  const axis = ["x", "y", "z"].indexOf(word.slice(-1)) as 0 | 1 | 2;
  return unitAlong(axis, word.startsWith("-") ? -1 : 1);
}

/** Of an axis of space its word, else three numbers: for addresses and `--up`. */
export function upText(up: readonly number[]): string {
  const word = WORDS.find((word) => isSame(vectorOf(word), up));
  return word ?? textOf(up.map((n) => (Math.abs(n) < SAME * 1e-3 ? 0 : n)));
}

/** null: the usual one of the volume. */
export const UP = new Part<Triple | null>(
  "up",
  "up direction",
  null,
  (up) => (up === null ? "" : upText(up)),
  (text) => {
    const word = WORDS.find((word) => word === text);
    if (word) return vectorOf(word);
    const list = numbersIn(text);
    return list?.length === 3 && Math.abs(Math.hypot(...list) - 1) < 1e-3 ? unit(list as Triple) : null;
  },
);

/** Superior where the space is anatomical, else +z. */
export function usualUp({ volume }: Pick<Page, "volume">): Triple {
  return unitTowards(volume.space, "S") ?? [0, 0, 1];
}

export function upOf(page: Pick<Page, "volume">, state: State): Triple {
  return UP.of(state) ?? usualUp(page);
}

export function withUp(page: Pick<Page, "volume">, state: State, up: Triple): State {
  return UP.with(state, isSame(up, usualUp(page)) ? null : up);
}

/** Towards the front where nothing else says where it is: at the patient's right and above, else at -y. */
export function usualFront({ volume }: Pick<Page, "volume">): Triple {
  const [right, front, top] = ["R", "A", "S"].map((letter) => unitTowards(volume.space, letter));
  if (!right || !front || !top) return [-0.5, -1, 0.5];
  return [0, 1, 2].map((axis) => 0.5 * right[axis]! + front[axis]! + 0.5 * top[axis]!) as Triple;
}

/**
 * The space turned the shortest way so that z becomes up; for -z half around y: view_from() of the library. What is in front
 * and what is above go with it.
 */
export function turnedUp(up: readonly number[], v: readonly number[]): Triple {
  const [x, y, z] = [up[0]!, up[1]!, up[2]!];
  if (z <= -1 + 1e-12) return [0 - v[0]!, v[1]!, 0 - v[2]!];
  const axis: Triple = [0 - y, x, 0];
  const once = cross(axis, v);
  const twice = cross(axis, once);
  return [0, 1, 2].map((i) => v[i]! + once[i]! + twice[i]! / (1 + z)) as Triple;
}

/** The inverse of turnedUp(). */
export function turnedBack(up: readonly number[], v: readonly number[]): Triple {
  const columns = [0, 1, 2].map((i) => turnedUp(up, unitAlong(i as 0 | 1 | 2, 1)));
  return columns.map((column) => dot(column, v)) as Triple;
}

/** Turned around a unit vector by an angle in radians, counterclockwise seen from its tip. */
export function rolled(up: Triple, around: readonly number[], angle: number): Triple {
  const [sine, cosine] = [Math.sin(angle), Math.cos(angle)];
  const [side, along] = [cross(around, up), dot(around, up)];
  return unit([0, 1, 2].map((i) => cosine * up[i]! + sine * side[i]! + (1 - cosine) * along * around[i]!) as Triple);
}

export function isSame(a: readonly number[], b: readonly number[]): boolean {
  return a.every((n, i) => Math.abs(n - b[i]!) < SAME);
}

function unit(v: Triple): Triple {
  const length = Math.hypot(...v);
  return v.map((n) => n / length + 0) as Triple;
}
