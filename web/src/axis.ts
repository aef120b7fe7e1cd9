// The isovalue axis that everything on the page shares, low on the left.
import { svg } from "./dom";
import { value } from "./format";
import type { Histogram } from "./page";

export class Axis {
  constructor(
    readonly low: number,
    readonly high: number,
    readonly width: number,
    readonly margin = 0,
  ) {}

  x(tau: number): number {
    const range = this.high - this.low;
    const at = range > 0 ? (Math.min(Math.max(tau, this.low), this.high) - this.low) / range : 0.5;
    return this.margin + at * (this.width - 2 * this.margin);
  }

  tau(x: number): number {
    return this.low + ((x - this.margin) / (this.width - 2 * this.margin)) * (this.high - this.low);
  }

  /** Round values, about `most` of them. */
  ticks(most: number): number[] {
    const range = this.high - this.low;
    if (!(range > 0)) return [this.low];
    const rough = range / Math.max(1, most);
    const power = 10 ** Math.floor(Math.log10(rough));
    const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= rough) ?? 10 * power;
    const first = Math.ceil(this.low / step - 1e-9);
    const last = Math.floor(this.high / step + 1e-9);
    return Array.from({ length: Math.max(0, last - first + 1) }, (_, i) => Number(((first + i) * step).toPrecision(12)));
  }
}

/** The outline of a histogram between y = bottom and y = top; heights are logarithmic, because the background outweighs all else. */
export function histogramPath(histogram: Histogram, axis: Axis, top: number, bottom: number): string {
  const most = Math.log1p(Math.max(1, ...histogram.counts));
  const step = (histogram.high - histogram.low) / histogram.counts.length;
  let path = `M${axis.x(histogram.low).toFixed(1)} ${bottom}`;
  histogram.counts.forEach((n, i) => {
    const y = (bottom - (Math.log1p(n) / most) * (bottom - top)).toFixed(1);
    path += `L${axis.x(histogram.low + i * step).toFixed(1)} ${y}L${axis.x(histogram.low + (i + 1) * step).toFixed(1)} ${y}`;
  });
  return `${path}L${axis.x(histogram.high).toFixed(1)} ${bottom}Z`;
}

export function drawTicks(axis: Axis, y: number, most: number): SVGGElement {
  const group = svg("g", { class: "ticks" });
  for (const tau of axis.ticks(most)) {
    const x = axis.x(tau);
    group.append(
      svg("line", { x1: x, x2: x, y1: y, y2: y + 4 }),
      svg("text", { x, y: y + 16, "text-anchor": "middle" }, value(tau)),
    );
  }
  return group;
}
