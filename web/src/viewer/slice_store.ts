// Slices that are there, and those that are on their way: of each axis the one asked for last.
import { isOvertaken, type Api } from "./api";
import { AXES, type AxisNumber } from "./grid";
import { decodeSlice, type Slice } from "./wire_samples";

/** of each axis */
const KEPT = 12;

export class SliceStore {
  private readonly kept = new Map<AxisNumber, Slice[]>(AXES.map((axis) => [axis, []]));
  private readonly wanted = new Map<AxisNumber, number>();
  private readonly loading = new Set<AxisNumber>();

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
    this.wanted.set(axis, index);
    if (!this.loading.has(axis)) void this.load(axis);
    return null;
  }

  private async load(axis: AxisNumber): Promise<void> {
    this.loading.add(axis);
    for (let index = this.wanted.get(axis); index !== undefined; index = this.wanted.get(axis)) {
      this.wanted.delete(axis);
      try {
        const answer = await this.api.ask(`/api/slice?axis=${axis}&index=${index}&most=${this.most}`, `slice ${axis}`);
        this.keep(decodeSlice(await answer.arrayBuffer(), axis, index));
      } catch (error) {
        if (!isOvertaken(error)) this.failed(error);
      }
    }
    this.loading.delete(axis);
  }

  private keep(slice: Slice): void {
    const list = this.kept.get(slice.axis) ?? [];
    list.unshift(slice);
    list.length = Math.min(list.length, KEPT);
    this.arrived(slice);
  }
}
