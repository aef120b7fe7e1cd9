// Connected components of a mesh (union-find over the points of its triangles).

/** corners: three points a triangle. Cost: about linear. */
export function countComponents(corners: Uint32Array): number {
  const max = corners.reduce((largest, point) => Math.max(largest, point), -1);
  const leader = Uint32Array.from({ length: max + 1 }, (_, point) => point);
  const find = (point: number): number => {
    let at = point;
    while (leader[at] !== at) at = leader[at] = leader[leader[at] ?? at] ?? at;
    return at;
  };
  for (let i = 0; i < corners.length; i += 3) for (const k of [1, 2]) leader[find(corners[i + k] ?? 0)] = find(corners[i] ?? 0);
  const found = new Set<number>();
  for (const point of corners) found.add(find(point));
  return found.size;
}
