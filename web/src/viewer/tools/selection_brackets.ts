// Marks the selected object with the corners of its bounding box, if several objects are visible. Not in exports.
import * as three from "three";
import type { ViewerContext } from "../context/viewer_context";
import { isDarkPage, onTheme } from "../context/theme";
import type { Mesh } from "../../shared/wire";

/** length of an arm, as a fraction of the edge */
const ARM = 0.16;
const [ON_LIGHT, ON_DARK] = ["#c04f00", "#ff9d4d"]; // --chosen of object_list.css

export type Corners = [low: number[], high: number[]];

/** Bounding box in physical coordinates. Cost: O(points). */
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

/** End points of the arms, three numbers each: 8 corners, 3 arms each. */
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

export function addSelectionBrackets({ viewport, history }: ViewerContext): void {
  const lines = new three.LineSegments(new three.BufferGeometry(), new three.LineBasicMaterial());
  lines.frustumCulled = false;
  let marked: Mesh | null = null;
  const applyTheme = (): void => {
    lines.material.color.set(isDarkPage() ? ON_DARK : ON_LIGHT);
    viewport.draw();
  };
  const mark = (): void => {
    const { shown, selected } = history.now;
    const { visibleSurfaces } = viewport;
    const mesh = visibleSurfaces.length > 1 ? (visibleSurfaces.find(({ key }) => key === shown[selected]?.entry)?.mesh ?? null) : null;
    if (mesh === marked) return;
    marked = mesh;
    if (mesh) lines.geometry.setAttribute("position", new three.Float32BufferAttribute(armsOf(boxOf(mesh)), 3));
    viewport.draw();
  };
  viewport.onBeforeRender((_, isStill) => (lines.visible = marked !== null && !isStill));
  viewport.onChange(mark);
  history.listen(mark);
  onTheme(applyTheme);
  viewport.add(lines);
  applyTheme();
}
