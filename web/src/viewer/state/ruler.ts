// Where the samples of an axis lie along it, in units of length from the first one: at equal steps, or where the file says.

/** An even picture of an axis: which of the samples that are there each of its texels shows, and between what lengths they lie. */
export interface Texels {
  samples: Uint32Array;
  low: number;
  high: number;
}

/** for an axis of uneven steps */
const MOST_TEXELS = 2048;

export class Ruler {
  /** the least length between two samples */
  readonly finest: number;

  /** places: of every sample; null: they are even. */
  constructor(
    readonly size: number,
    spacing: number,
    private readonly places: readonly number[] | null,
  ) {
    const steps = places?.slice(1).map((place, i) => place - places[i]!) ?? [];
    this.finest = steps.length > 0 ? steps.reduce((p, q) => Math.min(p, q)) : spacing;
    if (steps.length === 0) this.places = null;
  }

  /** Of a sample; numbers between samples are places between them, and the outermost steps go on beyond the ends. */
  length(sample: number): number {
    const { places } = this;
    if (!places) return sample * this.finest;
    const i = Math.min(Math.max(Math.floor(sample), 0), places.length - 2);
    return places[i]! + (sample - i) * (places[i + 1]! - places[i]!);
  }

  /** The other way. */
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

  /** Of every step-th sample: each is seen as far as halfway to its neighbours. */
  texels(step: number): Texels {
    const count = Math.ceil(this.size / step);
    const [low, high] = [this.length(-step / 2), this.length((count - 0.5) * step)];
    if (!this.places) return { samples: Uint32Array.from({ length: count }, (_, i) => i), low, high };
    const texels = Math.min(MOST_TEXELS, Math.ceil((high - low) / this.finest));
    const nearest = (i: number): number => Math.round(this.sample(low + ((i + 0.5) / texels) * (high - low)) / step);
    return { samples: Uint32Array.from({ length: texels }, (_, i) => Math.min(Math.max(nearest(i), 0), count - 1)), low, high };
  }
}
