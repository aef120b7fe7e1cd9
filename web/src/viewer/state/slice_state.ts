// State of the slices.
import type { Page } from "../../shared/page";
import { AXES, type Triple } from "./grid";
import { flag, numbers } from "./part";

export const SLICES = flag("slices", "slices");
export const PLANES = flag("planes", "slices in 3D");
/** the sample at the crosshair; null: the middle of the volume */
export const CROSSHAIR = numbers("cross", "crosshair", 3, (voxel) => voxel.every((n) => Number.isInteger(n) && n >= 0));
/** values shown as black and white; null: from the histogram */
export const GREY = numbers("grey", "grey range", 2, ([black, white]) => (black ?? 0) < (white ?? 0));

export function middleOf({ volume }: Page): Triple {
  return AXES.map((axis) => Math.floor((volume.size[axis] ?? 1) / 2)) as Triple;
}

/** The values between the 0.5 % and 99.5 % quantiles of the samples. */
export function greyRange({ histogram, axis }: Pick<Page, "histogram" | "axis">): [number, number] {
  const { edges, counts } = histogram;
  const all = counts.reduce((sum, count) => sum + count, 0);
  const { low, high } = axis;
  const quantile = (share: number): number => {
    let sum = 0;
    for (let i = 0; i < counts.length; ++i) {
      const count = counts[i] ?? 0;
      if (count > 0 && sum + count >= share * all)
        return (edges[i] ?? low) + ((share * all - sum) / count) * ((edges[i + 1] ?? high) - (edges[i] ?? low));
      sum += count;
    }
    return high;
  };
  const [black, white] = [Math.max(quantile(0.005), axis.low), Math.min(quantile(0.995), axis.high)];
  return black < white ? [black, white] : [low, high];
}
