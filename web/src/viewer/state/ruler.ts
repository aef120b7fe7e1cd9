// Positions of samples along an axis, in units of length from the first one: at even steps, or as given by the file.

/** Even texels along an axis: the nearest present sample of each, and the lengths at both ends. */
export interface Texels {
  samples: Uint32Array;
  low: number;
  high: number;
}

/** for an axis of uneven steps */
const MAX_TEXELS = 2048;

export class Ruler {
  /** the smallest step */
  readonly finest: number;

  /** places: positions of all samples; null: even steps. */
  constructor(
    readonly size: number,
    spacing: number,
    private readonly places: readonly number[] | null,
  ) {
    const steps = places?.slice(1).map((place, i) => place - places[i]!) ?? [];
    this.finest = steps.length > 0 ? steps.reduce((p, q) => Math.min(p, q)) : spacing;
    if (steps.length === 0) this.places = null;
  }

  /** Position of a sample; linear between samples, extrapolated by the outermost steps. */
  length(sample: number): number {
    const { places } = this;
    if (!places) return sample * this.finest;
    const i = Math.min(Math.max(Math.floor(sample), 0), places.length - 2);
    return places[i]! + (sample - i) * (places[i + 1]! - places[i]!);
  }

  /** Inverse of length(). */
  sample(length: number): number {
    const { places } = this;
    if (!places) return length / this.finest;
    let [low, high] = [0, places.length - 1];
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (places[middle]! <= length) low = middle;
      else high = middle;
    }
    return low + (length - places[low]!) / (places[high]! - places[low]!);
  }

  /** Of every step-th sample: each extends half-way to its neighbours. */
  texels(step: number): Texels {
    const count = Math.ceil(this.size / step);
    const [low, high] = [this.length(-step / 2), this.length((count - 0.5) * step)];
    if (!this.places) return { samples: Uint32Array.from({ length: count }, (_, i) => i), low, high };
    const texels = Math.min(MAX_TEXELS, Math.ceil((high - low) / this.finest));
    const nearest = (i: number): number => Math.round(this.sample(low + ((i + 0.5) / texels) * (high - low)) / step);
    return { samples: Uint32Array.from({ length: texels }, (_, i) => Math.min(Math.max(nearest(i), 0), count - 1)), low, high };
  }
}
