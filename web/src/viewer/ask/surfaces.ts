// Surfaces as they are asked for and as they come, one lane an object: coarse ones while something is dragged, whole ones when it rests.
import { isOvertaken, type Api, type Which } from "./api";
import { pieces } from "./pieces";
import type { Walls } from "../state/state";
import type { Mesh } from "./wire";

/** triangles */
const WHOLE = 100_000_000;
const COARSE = 20_000;

export interface Wish {
  tau: number;
  which: Which;
  walls: Walls;
}

/** What there is of an object: how much came, whether more is coming, or why there is nothing. */
export interface Arrival {
  /** of which wish: keyOf; empty: of none yet */
  of: string;
  triangles: number;
  bytes: number;
  coarse: boolean;
  /** of walls of cavities: how many; null: not counted */
  walls: number | null;
  waiting: boolean;
  error: string;
}

const NONE: Arrival = { of: "", triangles: 0, bytes: 0, coarse: false, walls: null, waiting: false, error: "" };

class Lane {
  key = "";
  /** how many triangles are being asked for; 0: nothing is */
  asking = 0;
  /** will the whole surface be asked for without another wish? */
  toTheEnd = false;
  next: Wish | null = null;
  arrival = NONE;
}

/** The same for wishes that are answered by the same surface. */
export function keyOf({ tau, walls }: Pick<Wish, "tau" | "walls">): string {
  return `${tau} ${walls}`;
}

export class Surfaces {
  private readonly lanes = new Map<number, Lane>();
  private readonly under = new Set<Promise<void>>();

  /** came: null where there is no such surface. */
  constructor(
    private readonly api: Api,
    private readonly came: (entry: number, mesh: Mesh | null, tau: number) => void,
    private readonly told: (entry: number) => void,
  ) {}

  arrivalOf(entry: number): Arrival {
    return this.lanes.get(entry)?.arrival ?? NONE;
  }

  /** While dragging: one coarse surface at a time, and the last wish next. Else: nothing older is waited for. */
  want(entry: number, wish: Wish, dragging: boolean): void {
    const lane = this.lanes.get(entry) ?? new Lane();
    this.lanes.set(entry, lane);
    const [key, { arrival }] = [keyOf(wish), lane];
    lane.next = null;
    const isComing = lane.asking > 0 && (dragging || lane.toTheEnd);
    if (lane.key === key && (isComing || (arrival.of === key && (dragging || !arrival.coarse)))) return;
    if (dragging && lane.asking === COARSE) {
      lane.next = wish;
      return;
    }
    const steps = dragging ? [COARSE] : arrival.of === key ? [WHOLE] : [COARSE, WHOLE];
    lane.toTheEnd = !dragging;
    lane.key = key;
    this.follow(this.ask(entry, lane, wish, steps));
  }

  forget(entry: number): void {
    const lane = this.lanes.get(entry);
    if (!lane) return;
    lane.key = "";
    this.lanes.delete(entry);
    this.api.leave(laneName(entry));
  }

  /** When nothing is being waited for any more. */
  async settled(): Promise<void> {
    while (this.under.size > 0) await Promise.allSettled(this.under);
  }

  private follow(work: Promise<void>): void {
    this.under.add(work);
    void work.finally(() => this.under.delete(work));
  }

  private async ask(entry: number, lane: Lane, wish: Wish, steps: number[]): Promise<void> {
    const key = keyOf(wish);
    const isOld = (): boolean => lane.key !== key || this.lanes.get(entry) !== lane;
    try {
      for (const most of steps) {
        lane.asking = most;
        lane.arrival = { ...lane.arrival, waiting: true };
        this.told(entry);
        const mesh = await this.api.surface(laneName(entry), wish.tau, wish.which, most, wish.walls);
        if (isOld()) return;
        lane.arrival = {
          of: key,
          triangles: mesh.triangles,
          bytes: mesh.bytes,
          coarse: mesh.coarse,
          walls: wish.walls === "cavities" && !mesh.coarse ? pieces(mesh.corners) : null,
          waiting: false,
          error: "",
        };
        this.came(entry, mesh, wish.tau);
        if (!mesh.coarse) break;
      }
    } catch (error) {
      if (isOld() || isOvertaken(error)) return;
      lane.arrival = { ...NONE, of: key, error: error instanceof Error ? error.message : String(error) };
      this.came(entry, null, wish.tau);
    }
    lane.asking = 0;
    this.told(entry);
    const { next } = lane;
    lane.next = null;
    if (next) this.want(entry, next, true);
  }
}

function laneName(entry: number): string {
  return `surface ${entry}`;
}
