// The isovalue axis of all drawings, low values on the left.
import { svg } from "./dom";
import { value } from "./format";
import type { Histogram, Page } from "./page";

export class Axis {
  constructor(
    readonly low: number,
    readonly high: number,
    readonly width: number,
    readonly margin = 0,
    /** null: linear */
    readonly bend: number | null = null,
  ) {}

  static of(page: Page, width: number, margin: number): Axis {
    return new Axis(page.axis.low, page.axis.high, width, margin, page.axis.bend);
  }

  private bent(distance: number): number {
    return this.bend === null ? distance : Math.asinh(distance / this.bend);
  }

  x(tau: number): number {
    const range = this.bent(this.high - this.low);
    const inside = Math.min(Math.max(tau, this.low), this.high);
    const at = range > 0 ? this.bent(inside - this.low) / range : 0.5;
    return this.margin + at * (this.width - 2 * this.margin);
  }

  tau(x: number): number {
    const at = ((x - this.margin) / (this.width - 2 * this.margin)) * this.bent(this.high - this.low);
    return this.low + (this.bend === null ? at : this.bend * Math.sinh(at));
  }

  /** Round values, about `max` of them. */
  ticks(max: number): number[] {
    const range = this.high - this.low;
    if (!(range > 0)) return [this.low];
    if (this.bend !== null) return this.bentTicks(max);
    const rough = range / Math.max(1, max);
    const power = 10 ** Math.floor(Math.log10(rough));
    const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= rough) ?? 10 * power;
    const first = Math.ceil(this.low / step - 1e-9);
    const last = Math.floor(this.high / step + 1e-9);
    return Array.from({ length: Math.max(0, last - first + 1) }, (_, i) => Number(((first + i) * step).toPrecision(12)));
  }

  /** 1, 2 and 5 times powers of ten, no two of them closer than width / max. */
  private bentTicks(max: number): number[] {
    const gap = (this.width - 2 * this.margin) / Math.max(1, max);
    const kept = [this.low];
    for (let power = 10 ** Math.floor(Math.log10((this.bend ?? 1) / 10)); power <= this.high; power *= 10) {
      for (const tau of [power, 2 * power, 5 * power]) {
        if (tau < this.high && this.x(tau) - this.x(kept.at(-1) ?? this.low) >= gap) kept.push(Number(tau.toPrecision(12)));
      }
    }
    return kept;
  }
}

/** Outline of a histogram between y = bottom and y = top; heights are logarithmic, as most samples are background. */
export function histogramPath(histogram: Histogram, axis: Axis, top: number, bottom: number): string {
  const max = Math.log1p(Math.max(1, ...histogram.counts));
  const x = histogram.edges.map((edge) => axis.x(edge).toFixed(1));
  const path = histogram.counts.map((n, i) => `V${(bottom - (Math.log1p(n) / max) * (bottom - top)).toFixed(1)}H${x[i + 1]}`);
  return `M${x[0]} ${bottom}${path.join("")}V${bottom}Z`;
}

export function drawTicks(axis: Axis, y: number, max: number): SVGGElement {
  const group = svg("g", { class: "ticks" });
  for (const tau of axis.ticks(max)) {
    const x = axis.x(tau);
    group.append(
      svg("line", { x1: x, x2: x, y1: y, y2: y + 4 }),
      svg("text", { x, y: y + 16, "text-anchor": x < 20 ? "start" : "middle" }, value(tau)),
    );
  }
  return group;
}

/** Screens that need narrow drawings, so that labels stay readable. */
export const narrowScreens = "(max-width: 700px)";

/** Width of full-width drawings, in units in which a label is 12 high. */
export function drawingWidth(): number {
  return matchMedia(narrowScreens).matches ? 430 : 1000;
}

export function axisName(page: Page): string {
  return `isovalue${page.volume.valueUnit ? `, ${page.volume.valueUnit}` : ""}`;
}
