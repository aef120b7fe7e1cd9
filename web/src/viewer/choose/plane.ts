// A plane of two logarithmic axes, in pixels: contrast from left to right, size from bottom to top.

export interface Frame {
  left: number;
  right: number;
  top: number;
  bottom: number;
}

export class Logarithmic {
  private readonly low: number;
  private readonly high: number;

  /** Values from least to most lie between the pixels `from` and `to`, with a little room; least > 0. */
  constructor(
    least: number,
    most: number,
    private readonly from: number,
    private readonly to: number,
  ) {
    const room = 0.04 * Math.max(1, Math.log10(most / least));
    this.low = Math.log10(least) - room;
    this.high = Math.log10(most) + room;
  }

  /** What is not positive lies at the low end. */
  pixel(value: number): number {
    const at = value > 0 ? (Math.log10(value) - this.low) / (this.high - this.low) : 0;
    return this.from + Math.min(Math.max(at, 0), 1) * (this.to - this.from);
  }

  /** null: beyond the end, where there is no limit. Three digits. */
  value(pixel: number): number | null {
    const at = (pixel - this.from) / (this.to - this.from);
    if (at <= 0 || at >= 1) return null;
    return Number((10 ** (this.low + at * (this.high - this.low))).toPrecision(3));
  }

  /** Powers of ten, no two of them closer than `gap` pixels. */
  tens(gap: number): number[] {
    const step = Math.max(1, Math.ceil((gap * (this.high - this.low)) / Math.abs(this.to - this.from)));
    const tens: number[] = [];
    for (let power = Math.ceil(this.low / step) * step; power <= this.high; power += step) tens.push(10 ** power);
    return tens;
  }
}

/** Least positive and most; 1 and 1 where there is none. */
export function spanOf(values: Iterable<number>): [number, number] {
  let [least, most] = [Infinity, 0];
  for (const value of values) {
    if (value > 0) least = Math.min(least, value);
    most = Math.max(most, value);
  }
  return most > 0 ? [least, most] : [1, 1];
}
