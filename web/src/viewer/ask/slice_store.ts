// Slices that are there, and those that are on their way: of each axis the one asked for last.
import type { Api } from "./api";
import { AXES, type AxisNumber } from "../state/grid";
import { Latest } from "./latest";
import { decodeSlice, type Slice } from "./wire_samples";

/** of each axis */
const KEPT = 12;

export class SliceStore {
  private readonly kept = new Map<AxisNumber, Slice[]>(AXES.map((axis) => [axis, []]));
  private readonly asked = AXES.map((axis) => new Latest<number>((index) => this.load(axis, index)));

  /** arrived: a slice that was wanted. most: samples of a slice; fewer come of larger ones. */
  constructor(
    private readonly api: Api,
    private readonly arrived: (slice: Slice) => void,
    private readonly failed: (error: unknown) => void,
    private readonly most = 1 << 20,
  ) {}

  /** The slice, if it is there; else it is asked for. */
  get(axis: AxisNumber, index: number): Slice | null {
    const slice = this.kept.get(axis)?.find((one) => one.index === index);
    if (slice) return slice;
    this.asked[axis]?.want(index, String(index));
    return null;
  }

  private async load(axis: AxisNumber, index: number): Promise<void> {
    try {
      const answer = await this.api.ask(`/api/slice?axis=${axis}&index=${index}&most=${this.most}`, `slice ${axis}`);
      this.keep(decodeSlice(await answer.arrayBuffer(), axis, index));
    } catch (error) {
      this.failed(error);
    }
  }

  private keep(slice: Slice): void {
    const list = this.kept.get(slice.axis) ?? [];
    list.unshift(slice);
    list.length = Math.min(list.length, KEPT);
    this.arrived(slice);
  }
}
