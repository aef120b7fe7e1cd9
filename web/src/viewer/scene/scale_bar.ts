// A scale bar of a round length, in the unit of the file or in the chosen one.
import { html } from "../../shared/dom";
import { value } from "../../shared/format";
import { shownQuantity } from "../../shared/units";

const MAX_SHARE = 0.25;

/** The longest of 1, 2, 5 times a power of ten that is at most `max`. */
export function roundLength(max: number): number {
  if (!(max > 0)) return 0;
  const power = 10 ** Math.floor(Math.log10(max));
  const step = [5, 2, 1].find((s) => s * power <= max * (1 + 1e-9)) ?? 1;
  return Number((step * power).toPrecision(6));
}

export class ScaleBar {
  readonly element = html("div", { class: "scale" });
  private readonly bar = html("span", { class: "bar" });
  private readonly text = html("span", {});

  constructor(private readonly unit: string | null) {
    this.element.append(this.bar, this.text);
  }

  /** length: physical length of `pixels`. */
  show(length: number, pixels: number): void {
    const { amount, unit } = shownQuantity(length, this.unit, 1);
    const bar = roundLength(amount * MAX_SHARE);
    this.bar.style.width = `${(pixels * bar) / amount}px`;
    this.text.textContent = `${value(bar)} ${unit ?? (bar === 1 ? "voxel" : "voxels")}`;
  }
}
