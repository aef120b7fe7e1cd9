// Names of the faces of the volume: anatomical directions if the file has them, else the axes.
import type { Triple } from "../state/grid";

export interface Face {
  /** outwards */
  normal: Triple;
  /** on the face */
  letter: string;
  name: string;
}

const OPPOSITE: Record<string, string> = { L: "R", R: "L", P: "A", A: "P", S: "I", I: "S" };
const NAMES: Record<string, string> = { L: "left", R: "right", P: "back", A: "front", S: "head", I: "feet" };
const NORMALS: Triple[] = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];

/** space: three letters, the direction of each axis, such as "LPS"; other values: unknown. */
export function facesOf(space: string): Face[] {
  const letters = /^[LR][PA][SI]$/.test(space) ? [...space] : null;
  return NORMALS.flatMap((normal, axis): Face[] => {
    const against = normal.map((n) => 0 - n) as Triple;
    const letter = letters?.[axis];
    const other = OPPOSITE[letter ?? ""];
    if (letter && other) return [face(normal, letter), face(against, other)];
    const own = "xyz"[axis] ?? "";
    return [
      { normal, letter: `+${own}`, name: `the far end of ${own}` },
      { normal: against, letter: `−${own}`, name: `the near end of ${own}` },
    ];
  });
}

function face(normal: Triple, letter: string): Face {
  return { normal, letter, name: `the ${NAMES[letter] ?? letter}` };
}
