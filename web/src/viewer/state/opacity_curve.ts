// Opacity curves of volume rendering: layers that add up, each a list of control points. Between two points the extinction is
// linear in the value, and so is extinction times linear light (Wittenbrink, Malzbender, Goss: Opacity-weighted color
// interpolation for volume sampling, 1998). Nothing is seen before the first and behind the last point of a layer.
import { colourOfLight, linearOf, type Light } from "./light";

export interface CurvePoint {
  /** in units of the file */
  value: number;
  /** of a voxel: of matter as thick as the smallest distance of two samples; 0 to MAX_OPACITY */
  opacity: number;
  /** #rrggbb */
  colour: string;
}

export interface Layer {
  /** at least two, values not falling; two at one value: it jumps */
  points: readonly CurvePoint[];
  visible: boolean;
  /** isovalue of the object that it was proposed for; null: none */
  tau: number | null;
}

export const MAX_OPACITY = 0.999;
/** so that links stay short enough for all browsers */
const MAX_LAYERS = 16;
const MAX_POINTS = 64;

/** Extinction per voxel of an opacity. */
export function extinctionOf(opacity: number): number {
  return -Math.log1p(-opacity);
}
export function opacityOf(extinction: number): number {
  return Math.min(MAX_OPACITY, -Math.expm1(-extinction));
}

/** Extinction per voxel at a value, and linear light. At a jump: after it. */
export function matterAt(points: readonly CurvePoint[], value: number): { extinction: number; light: Light } {
  const next = points.findIndex((point) => point.value > value);
  const [p, q] = [points[next - 1], points[next]];
  if (!p || !q) {
    const last = points.at(-1);
    const end = last && value === last.value ? last : undefined;
    return { extinction: end ? extinctionOf(end.opacity) : 0, light: linearOf((end ?? p ?? q ?? last)?.colour ?? "#ffffff") };
  }
  const share = (value - p.value) / (q.value - p.value);
  const [before, after] = [(1 - share) * extinctionOf(p.opacity), share * extinctionOf(q.opacity)];
  const extinction = before + after;
  const weight = extinction > 0 ? after / extinction : share;
  const [a, b] = [linearOf(p.colour), linearOf(q.colour)];
  return { extinction, light: a.map((part, i) => part + weight * ((b[i] ?? 0) - part)) as Light };
}

/** Of the densest point; of all of them: the first one. */
export function colourOfLayer({ points }: Layer): string {
  return points.reduce((best, point) => (point.opacity > best.opacity ? point : best)).colour;
}

/** A point is moved no further than to its neighbours. */
export function movePoint(points: readonly CurvePoint[], at: number, value: number, opacity: number): CurvePoint[] {
  const low = points[at - 1]?.value ?? -Infinity;
  const high = points[at + 1]?.value ?? Infinity;
  const to = { value: Math.min(Math.max(value, low), high), opacity: Math.min(Math.max(opacity, 0), MAX_OPACITY) };
  return points.map((point, i) => (i === at ? { ...point, ...to } : point));
}

/** opacity: null: on the curve, which stays as it is. */
export function addPoint(
  points: readonly CurvePoint[],
  value: number,
  opacity: number | null = null,
): { points: CurvePoint[]; at: number } | null {
  if (points.length >= MAX_POINTS) return null;
  const { extinction, light } = matterAt(points, value);
  const found = points.findIndex((point) => point.value > value);
  const at = found < 0 ? points.length : found;
  const point = { value, opacity: Math.min(opacity ?? opacityOf(extinction), MAX_OPACITY), colour: colourOfLight(light) };
  return { points: [...points.slice(0, at), point, ...points.slice(at)], at };
}

/** The last two stay. */
export function removePoint(points: readonly CurvePoint[], at: number): readonly CurvePoint[] {
  return points.length <= 2 ? points : points.filter((_, i) => i !== at);
}

/** With extinctions times a factor. */
export function scaledBy(points: readonly CurvePoint[], factor: number): CurvePoint[] {
  return points.map((point) => ({ ...point, opacity: opacityOf(factor * extinctionOf(point.opacity)) }));
}

/** What lies between two values. */
export function cutOff(points: readonly CurvePoint[], low: number, high: number): CurvePoint[] {
  const pointAt = (value: number): CurvePoint => {
    const { extinction, light } = matterAt(points, value);
    return { value, opacity: opacityOf(extinction), colour: colourOfLight(light) };
  };
  const [first, last] = [points[0]?.value ?? low, points.at(-1)?.value ?? high];
  return [
    ...(first < low && last > low ? [pointAt(low)] : []),
    ...points.filter(({ value }) => value >= low && value <= high),
    ...(last > high && first < high ? [pointAt(high)] : []),
  ];
}

export function highestOpacity(points: readonly CurvePoint[]): number {
  return Math.max(...points.map(({ opacity }) => opacity));
}

/** Seven digits. */
export function shortNumber(n: number): string {
  return String(Number(n.toPrecision(7)));
}

/** VALUE:OPACITY:COLOUR,...; a colour that is that of the point before is omitted. */
export function pointsText(points: readonly CurvePoint[], colourText: (colour: string) => string): string {
  return points
    .map(({ value, opacity, colour }, i) => {
      const words = [shortNumber(value), shortNumber(opacity)];
      if (colour !== points[i - 1]?.colour) words.push(colourText(colour));
      return words.join(":");
    })
    .join(",");
}

/** Of the address: layers separated by ";", each [!][TAU@]VALUE:OPACITY:RRGGBB,...; "!": hidden. */
export function layersText(layers: readonly Layer[]): string {
  const layerText = ({ points, visible, tau }: Layer): string =>
    `${visible ? "" : "!"}${tau === null ? "" : `${shortNumber(tau)}@`}${pointsText(points, (colour) => colour.slice(1))}`;
  return layers.map(layerText).join(";");
}

/** null: invalid. */
export function layersIn(text: string): Layer[] | null {
  const layers = text.split(";").map(layerIn);
  return layers.length <= MAX_LAYERS && layers.every((layer) => layer !== null) ? layers : null;
}

function layerIn(text: string): Layer | null {
  const [, hidden, tau, list] = /^(!?)(?:([^@]*)@)?([^@!]*)$/.exec(text) ?? [];
  const points = pointsIn(list ?? "");
  const shownFor = tau === undefined ? null : numberIn(tau);
  return points && (tau === undefined || shownFor !== null) ? { points, visible: hidden === "", tau: shownFor } : null;
}

function pointsIn(text: string): CurvePoint[] | null {
  const points: CurvePoint[] = [];
  for (const word of text.split(",")) {
    const parts = word.split(":");
    const [value, opacity] = [numberIn(parts[0]), numberIn(parts[1])];
    const before = points.at(-1);
    const colour = parts.length === 3 ? `#${parts[2]}` : before?.colour;
    if (value === null || opacity === null || parts.length > 3 || colour === undefined) return null;
    if (!(opacity >= 0 && opacity <= MAX_OPACITY) || !/^#[0-9a-f]{6}$/.test(colour) || value < (before?.value ?? -Infinity))
      return null;
    points.push({ value, opacity, colour });
  }
  return points.length >= 2 && points.length <= MAX_POINTS ? points : null;
}

function numberIn(word: string | undefined): number | null {
  return word !== undefined && word.trim() !== "" && Number.isFinite(Number(word)) ? Number(word) : null;
}
