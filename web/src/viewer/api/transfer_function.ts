// Transfer function: layers of an opacity curve, or a sum of tents proposed from the tree, as a table of integrals
// (pre-integrated classification).
import type { Entry, Page } from "../../shared/page";
import { linearOf } from "../state/light";
import { extinctionOf, opacityOf, type CurvePoint, type Layer } from "../state/opacity_curve";

export interface OpacityTent {
  /** isovalue of the object that it shows */
  tau: number;
  /** support of the tent, in units of the file */
  low: number;
  high: number;
  /** fraction of high - low over which it rises, and the same over which it falls */
  ramp: number;
  /** extinction per unit of length between the ramps */
  density: number;
  /** #rrggbb */
  colour: string;
}

/** Extinction times linear red, green, blue; extinction. */
export type Medium = [number, number, number, number];

export const PLACES = 1024;
/** smallest distance of two places for a mean */
const CLOSE = 0.5;

/** A value, and the medium there: extinction times linear light, extinction. */
interface Node {
  value: number;
  medium: Medium;
}

/** perVoxel: of lengths, the voxels in a unit. */
function nodesOf({ points }: Layer, perVoxel: number): Node[] {
  return points.map(({ value, opacity, colour }) => {
    const extinction = extinctionOf(opacity) * perVoxel;
    return { value, medium: [...(linearOf(colour).map((part) => extinction * part) as [number, number, number]), extinction] };
  });
}

/** Integrals over the values from the first node on, at ascending values. */
class Integral {
  private next = 0;
  private sum: Medium = [0, 0, 0, 0];

  constructor(private readonly nodes: readonly Node[]) {}

  to(value: number): Medium {
    for (; (this.nodes[this.next]?.value ?? Infinity) <= value; ++this.next)
      if (this.next > 0) this.sum = this.sumTo(this.nodes[this.next]?.value ?? value);
    return this.next === 0 || this.next === this.nodes.length ? this.sum : this.sumTo(value);
  }

  /** To a value between the last node and the next one. */
  private sumTo(value: number): Medium {
    const [last, next] = [this.nodes[this.next - 1]!, this.nodes[this.next]!];
    const width = value - last.value;
    const share = next.value > last.value ? width / (next.value - last.value) : 0;
    return this.sum.map((sum, i) => {
      const [first, second] = [last.medium[i]!, next.medium[i]!];
      return sum + width * (first + ((second - first) * share) / 2);
    }) as Medium;
  }
}

/**
 * Integrals of the visible layers from place 0 up to places 0 to PLACES: four numbers each, as Medium. A place is
 * (high - low) / PLACES. voxel: physical length that opacities refer to.
 */
export function transferTable(layers: readonly Layer[], low: number, high: number, voxel: number): Float32Array<ArrayBuffer> {
  const sums = new Float64Array(4 * (PLACES + 1));
  const perPlace = (high - low) / PLACES;
  if (!(perPlace > 0)) return new Float32Array(sums);
  for (const layer of layers.filter(({ visible }) => visible)) {
    const integral = new Integral(nodesOf(layer, 1 / voxel));
    const first = integral.to(low);
    for (let i = 0; i <= PLACES; ++i) {
      const sum = integral.to(low + i * perPlace);
      for (let part = 0; part < 4; ++part) sums[4 * i + part]! += (sum[part]! - first[part]!) / perPlace;
    }
  }
  return new Float32Array(sums);
}

/** Extinction of a tent at a value, approached from one side. */
function extinctionAt({ low, high, ramp, density }: OpacityTent, value: number, fromAbove: boolean): number {
  if (value < low || value > high || value === (fromAbove ? high : low)) return 0;
  const width = ramp * (high - low);
  return width > 0 ? density * Math.min(1, (value - low) / width, (high - value) / width) : density;
}

/**
 * The tents of the same object as one layer: a point at each of their corners, two where the sum jumps. The extinction is
 * exactly that of the tents between low and high, where the layer ends.
 */
export function layersOf(tents: readonly OpacityTent[], low: number, high: number, voxel: number): Layer[] {
  const taus = [...new Set(tents.map(({ tau }) => tau))];
  const layers = taus.map((tau) =>
    layerOf(
      tents.filter((tent) => tent.tau === tau),
      tau,
      low,
      high,
      voxel,
    ),
  );
  return layers.filter(({ points }) => points.length >= 2);
}

function layerOf(tents: readonly OpacityTent[], tau: number, low: number, high: number, voxel: number): Layer {
  const near = 1e-9 * (high - low);
  const corners = tents
    .flatMap((tent) => [
      tent.low,
      tent.low + tent.ramp * (tent.high - tent.low),
      tent.high - tent.ramp * (tent.high - tent.low),
      tent.high,
    ])
    .map((corner) => Math.min(Math.max(corner, low), high))
    .sort((a, b) => a - b);
  const points = corners
    .filter((corner, i) => i === 0 || corner - corners[i - 1]! > near)
    .flatMap((value): CurvePoint[] => {
      const side = (fromAbove: boolean): number =>
        tents.reduce((sum, tent) => sum + extinctionAt(tent, value, fromAbove), 0) * voxel;
      const sides = [...(value > low ? [side(false)] : []), ...(value < high ? [side(true)] : [])];
      const isJump = sides.length === 2 && Math.abs(sides[0]! - sides[1]!) > 1e-9 * Math.max(...sides);
      return (isJump ? sides : sides.slice(0, 1)).map((extinction) => ({
        value,
        opacity: opacityOf(extinction),
        colour: tents[0]?.colour ?? "#ffffff",
      }));
    });
  return { points: points.some(({ opacity }) => opacity > 0) ? points : [], visible: true, tau };
}

/** Uses the colours of the entries at the same isovalues. */
export function colouredAs(page: Page, tents: readonly OpacityTent[]): OpacityTent[] {
  return tents.map((tent) => ({ ...tent, colour: entryAt(page, tent.tau)?.colour ?? tent.colour }));
}

/** The entry with this isovalue. */
export function entryAt(page: Page, tau: number): Entry | undefined {
  const near = 1e-6 * (page.axis.high - page.axis.low);
  return page.entries.find((entry) => Math.abs(entry.tau - tau) <= near);
}

function integralTo(table: Float32Array, place: number, part: number): number {
  const i = Math.min(Math.floor(place), PLACES - 1);
  const first = table[4 * i + part]!;
  return first + (place - i) * (table[4 * i + 4 + part]! - first);
}

/** Mean of the medium between two places, for values that vary linearly between them (Engel, Kraus, Ertl, 2001). */
export function meanBetween(table: Float32Array, a: number, b: number): Medium {
  const middle = (a + b) / 2;
  const half = Math.max(Math.abs(b - a), CLOSE) / 2;
  const low = Math.min(Math.max(middle - half, 0), PLACES - CLOSE);
  const high = Math.max(Math.min(middle + half, PLACES), low + CLOSE);
  return [0, 1, 2, 3].map((part) => (integralTo(table, high, part) - integralTo(table, low, part)) / (high - low)) as Medium;
}
