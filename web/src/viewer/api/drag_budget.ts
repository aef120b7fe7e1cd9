// How many triangles surfaces may have while an isovalue is dragged: as many as arrive in time and are drawn in time, which without a
// graphics card are few. Where no surface with the topology of the exact one has few enough, points of it are drawn.

/** the most triangles, in the fewest ones */
const MOST = 32;
/** ms: a surface that took less could have been larger, one that took more should be smaller */
const QUICK = 200;
const SLOW = 400;
/** ms: the same of a frame */
const QUICK_FRAME = 80;
const SLOW_FRAME = 160;

export class DragBudget {
  private most: number;

  /** fewest: few enough for a slow line */
  constructor(private readonly fewest: number) {
    this.most = fewest;
  }

  get triangles(): number {
    return this.most;
  }

  /**
   * A surface was there after so many milliseconds, and a frame takes so many. isCoarse: the exact one has more triangles than were
   * allowed.
   */
  took(milliseconds: number, isCoarse: boolean, frame = 0): void {
    if (milliseconds > SLOW) this.most = Math.max(this.most / 4, this.fewest);
    else if (frame > SLOW_FRAME) this.most = Math.max(this.most / 2, this.fewest);
    else if (milliseconds < QUICK && frame < QUICK_FRAME && isCoarse) this.most = Math.min(2 * this.most, MOST * this.fewest);
  }
}
