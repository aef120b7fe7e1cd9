// What is selected, marked in the picture: the corners of the box around it, while more than one object is to be seen. Not in what is kept.
import * as three from "three";
import type { Desk } from "../desk/desk";
import { isDarkPage, onTheme } from "../desk/theme";
import type { Mesh } from "../ask/wire";

/** of an edge of the box, for one arm of a corner */
const ARM = 0.16;
const [ON_LIGHT, ON_DARK] = ["#c04f00", "#ff9d4d"]; // --chosen of choose.css

export type Corners = [low: number[], high: number[]];

/** In physical coordinates. Cost: O(points). */
export function boxOf({ positions, origin, step }: Pick<Mesh, "positions" | "origin" | "step">): Corners {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < positions.length; ++i) {
    const [axis, at] = [i % 3, positions[i] ?? 0];
    if (at < (low[axis] ?? 0)) low[axis] = at;
    if (at > (high[axis] ?? 0)) high[axis] = at;
  }
  const place = (steps: number[]): number[] => steps.map((n, axis) => (origin[axis] ?? 0) + step * n);
  return [place(low), place(high)];
}

/** Ends of the arms, three numbers each: 8 corners, 3 arms each. */
export function armsOf([low, high]: Corners): number[] {
  const ends: number[] = [];
  for (let corner = 0; corner < 8; ++corner) {
    const at = [0, 1, 2].map((axis) => ((corner >> axis) & 1 ? high : low)[axis] ?? 0);
    for (const axis of [0, 1, 2]) {
      const length = ARM * ((high[axis] ?? 0) - (low[axis] ?? 0)) * ((corner >> axis) & 1 ? -1 : 1);
      ends.push(...at, ...at.map((number, other) => (other === axis ? number + length : number)));
    }
  }
  return ends;
}

export function brackets({ stage, history }: Desk): void {
  const lines = new three.LineSegments(new three.BufferGeometry(), new three.LineBasicMaterial());
  lines.frustumCulled = false;
  let marked: Mesh | null = null;
  const wear = (): void => {
    lines.material.color.set(isDarkPage() ? ON_DARK : ON_LIGHT);
    stage.draw();
  };
  const mark = (): void => {
    const { shown, selected } = history.now;
    const { standing } = stage;
    const mesh = standing.length > 1 ? (standing.find(({ key }) => key === shown[selected]?.entry)?.mesh ?? null) : null;
    if (mesh === marked) return;
    marked = mesh;
    if (mesh) lines.geometry.setAttribute("position", new three.Float32BufferAttribute(armsOf(boxOf(mesh)), 3));
    stage.draw();
  };
  stage.onPass((_, isStill) => (lines.visible = marked !== null && !isStill));
  stage.onChange(mark);
  history.listen(mark);
  onTheme(wear);
  stage.add(lines);
  wear();
}
