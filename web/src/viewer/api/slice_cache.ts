// Cache of slices; of each axis only the latest request is pending.
import type { Api } from "./api";
import { AXES, type AxisNumber } from "../state/grid";
import { Latest } from "./latest";
import { decodeSlice, type Slice } from "./wire_samples";

/** of each axis */
const MAX_KEPT = 12;

export class SliceCache {
  private readonly kept = new Map<AxisNumber, Slice[]>(AXES.map((axis) => [axis, []]));
  private readonly requests = AXES.map((axis) => new Latest<number>((index) => this.load(axis, index)));

  /** onSlice: a requested slice has been loaded. maxSamples: larger slices are subsampled. */
  constructor(
    private readonly api: Api,
    private readonly onSlice: (slice: Slice) => void,
    private readonly onError: (error: unknown) => void,
    private readonly maxSamples = 1 << 20,
  ) {}

  /** The slice if it is cached; else it is requested. */
  get(axis: AxisNumber, index: number): Slice | null {
    const slice = this.kept.get(axis)?.find((one) => one.index === index);
    if (slice) return slice;
    this.requests[axis]?.request(index, `${index} ${this.api.connection.count}`);
    return null;
  }

  private async load(axis: AxisNumber, index: number): Promise<void> {
    try {
      const response = await this.api.request(`/api/slice?axis=${axis}&index=${index}&max=${this.maxSamples}`, `slice ${axis}`);
      this.keep(decodeSlice(await response.arrayBuffer(), axis, index));
    } catch (error) {
      this.onError(error);
    }
  }

  private keep(slice: Slice): void {
    const list = this.kept.get(slice.axis) ?? [];
    list.unshift(slice);
    list.length = Math.min(list.length, MAX_KEPT);
    this.onSlice(slice);
  }
}
