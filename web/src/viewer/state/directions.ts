// Names of directions in space: anatomical ones if the file has them, else the axes.
import { cross, dot, type Triple } from "./grid";

/** A direction along an axis of space. */
export interface Direction {
  /** of space */
  axis: 0 | 1 | 2;
  sign: 1 | -1;
  /** "L", or "+x" */
  letter: string;
  /** of the side of the volume there: "left", or "far end of x" */
  side: string;
  /** "the patient's left", "anterior", or "+x" */
  words: string;
}

export interface Face {
  /** outwards */
  normal: Triple;
  /** on the face */
  letter: string;
  name: string;
}

const OPPOSITE: Record<string, string> = { L: "R", R: "L", P: "A", A: "P", S: "I", I: "S" };
const SIDES: Record<string, string> = { L: "left", R: "right", P: "back", A: "front", S: "top", I: "bottom" };
const WORDS: Record<string, string> = {
  L: "the patient's left",
  R: "the patient's right",
  P: "posterior",
  A: "anterior",
  S: "superior",
  I: "inferior",
};
const PERMUTATIONS = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]] as const;
/** cosine of the largest angle at which an axis counts as one of space: 2.5 degrees */
const STRAIGHT = 0.999;

/** What the positive axes of space point to, such as "LPS"; null: unknown. */
export function anatomicalAxes(space: string): string[] | null {
  const letters = [...space];
  const isOnce = (pair: string): boolean => letters.filter((letter) => pair.includes(letter)).length === 1;
  return letters.length === 3 && ["LR", "PA", "SI"].every(isOnce) ? letters : null;
}

/** Of an axis of space, towards its positive or negative end. */
export function directionAlong(space: string, axis: 0 | 1 | 2, sign: 1 | -1): Direction {
  const positive = anatomicalAxes(space)?.[axis] ?? "";
  const letter = sign > 0 ? positive : (OPPOSITE[positive] ?? "");
  if (letter) return { axis, sign, letter, side: SIDES[letter] ?? letter, words: WORDS[letter] ?? letter };
  const own = `${sign > 0 ? "+" : "−"}${"xyz"[axis]}`;
  return { axis, sign, letter: own, side: `${sign > 0 ? "far" : "near"} end of ${"xyz"[axis]}`, words: own };
}

export function opposite(space: string, { axis, sign }: Direction): Direction {
  return directionAlong(space, axis, sign > 0 ? -1 : 1);
}

/**
 * The directions of the axes of the volume: of each the nearest axis of space, but none twice, where an oblique volume
 * would have two axes nearest to the same one. directions: unit vectors.
 */
export function nearestDirections(space: string, directions: readonly Triple[]): Direction[] {
  const closeness = (order: readonly number[]): number => order.reduce((sum, axis, i) => sum + Math.abs(directions[i]![axis]!), 0);
  const [best] = [...PERMUTATIONS].sort((p, q) => closeness(q) - closeness(p));
  return best!.map((axis, i) => directionAlong(space, axis, directions[i]![axis]! < 0 ? -1 : 1));
}

/** Is a plane with this normal seen at an angle to the planes of space? directions: in the plane, unit vectors. */
export function isOblique(across: Triple, down: Triple): boolean {
  const normal = cross(across, down);
  return Math.max(...normal.map(Math.abs)) < STRAIGHT * Math.sqrt(dot(normal, normal));
}

/** The six faces of a cube in space. */
export function facesOf(space: string): Face[] {
  return ([0, 1, 2] as const).flatMap((axis) =>
    ([1, -1] as const).map((sign): Face => {
      const { letter, side } = directionAlong(space, axis, sign);
      return { normal: unitAlong(axis, sign), letter, name: `the ${side}` };
    }),
  );
}

/** The unit vector of an axis of space. */
export function unitAlong(axis: 0 | 1 | 2, sign: 1 | -1): Triple {
  return [0, 1, 2].map((other) => (other === axis ? sign : 0)) as Triple;
}

/** The direction of a letter, such as "S", in an anatomical space; null: it has none. */
export function unitTowards(space: string, letter: string): Triple | null {
  for (const { normal, letter: own } of facesOf(space)) if (own === letter) return normal;
  return null;
}
