// Loads surfaces of objects, one channel an object: during a drag coarse ones that arrive in time, full ones when it ends. Of large ones
// with levels of detail the full one is fine where the eye is near, and is loaded again from where the eye goes.
import { ConnectionError, failureText, isSuperseded, type Api, type Eye, type SurfaceTarget } from "./api";
import { countComponents } from "./count_components";
import { DragBudget } from "./drag_budget";
import { DIVISIONS } from "../state/points";
import type { ShellFilter } from "../state/state";
import type { Mesh } from "../../shared/wire";

/** triangles */
const FULL = 100_000_000;
const COARSE = 20_000;
/** of all surfaces with levels of detail together */
const SEEN = 1_000_000;

export interface SurfaceRequest {
  tau: number;
  target: SurfaceTarget;
  walls: ShellFilter;
}

/** Load state of the surface of an object: what is loaded, whether more is on its way, or the error. */
export interface LoadState {
  /** keyOf() its request; empty: nothing is loaded yet */
  key: string;
  triangles: number;
  /** drawn instead of triangles: if coarse, some of a surface that has too many; 0: none */
  points: number;
  bytes: number;
  coarse: boolean;
  /** of fewer triangles than the exact surface has: with its topology, at most so many voxels from it; null: it is exact, or points */
  within: number | null;
  /** no part of it is seen farther than so many pixels from the exact surface; null: it does not depend on the view */
  pixels: number | null;
  /** of walls of cavities: their number; null: not counted */
  walls: number | null;
  waiting: boolean;
  error: string;
}

const NONE: LoadState = {
  key: "",
  triangles: 0,
  points: 0,
  bytes: 0,
  coarse: false,
  within: null,
  pixels: null,
  walls: null,
  waiting: false,
  error: "",
};

class Channel {
  key = "";
  /** triangles of the pending request; 0: none is pending */
  requested = 0;
  /** the full surface follows without another request */
  untilFull = false;
  next: SurfaceRequest | null = null;
  /** of the last mesh: from where it is seen */
  eye = "";
  /** of that surface: a coarse one was no level of detail, so that it is not finer where the eye is near */
  hasNoLevels = "";
  loadState = NONE;
}

/** Equal for requests that have the same surface as response. */
export function keyOf({ tau, walls }: Pick<SurfaceRequest, "tau" | "walls">): string {
  return `${tau} ${walls}`;
}

export class Surfaces {
  private readonly channels = new Map<number, Channel>();
  private readonly pending = new Set<Promise<void>>();
  private readonly dragged = new DragBudget(COARSE);
  private asPoints = false;

  /** onMesh: null where there is no such surface. eye: from where the scene is seen now. frameTime: of the scene, milliseconds. */
  constructor(
    private readonly api: Api,
    private readonly onMesh: (entry: number, mesh: Mesh | null, tau: number) => void,
    private readonly onUpdate: (entry: number) => void,
    private readonly eye: () => Eye | undefined = () => undefined,
    private readonly frameTime: () => number = () => 0,
  ) {}

  loadStateOf(entry: number): LoadState {
    return this.channels.get(entry)?.loadState ?? NONE;
  }

  /** From now on: full surfaces as points, or as triangles. Those that are loaded are requested again. */
  drawAsPoints(asPoints: boolean): void {
    if (asPoints === this.asPoints) return;
    this.asPoints = asPoints;
    for (const channel of this.channels.values()) {
      channel.key = "";
      channel.loadState = { ...channel.loadState, key: "" };
    }
  }

  /** While dragging: one coarse surface at a time, then that of the last request. Else the request supersedes older ones. */
  request(entry: number, request: SurfaceRequest, dragging: boolean): void {
    const channel = this.channels.get(entry) ?? new Channel();
    this.channels.set(entry, channel);
    const [key, { loadState }] = [keyOf(request), channel];
    channel.next = null;
    const isLoading = channel.requested > 0 && (dragging || channel.untilFull);
    const isDone = loadState.key === key && (dragging || !(loadState.coarse || this.isSeenFromElsewhere(channel)));
    if (channel.key === key && (isLoading || isDone)) return;
    if (dragging && channel.requested > 0 && channel.requested < FULL) {
      channel.next = request;
      return;
    }
    const levels = dragging ? [this.dragged.triangles] : loadState.key === key && loadState.error === "" ? [FULL] : [COARSE, FULL];
    channel.untilFull = !dragging;
    channel.key = key;
    this.track(this.load(entry, channel, request, levels));
  }

  remove(entry: number): void {
    const channel = this.channels.get(entry);
    if (!channel) return;
    channel.key = "";
    this.channels.delete(entry);
    this.api.abort(channelName(entry));
  }

  /** Resolves when no request is pending. */
  async settled(): Promise<void> {
    while (this.pending.size > 0) await Promise.allSettled(this.pending);
  }

  private isSeenFromElsewhere({ eye, loadState }: Channel): boolean {
    return loadState.pixels !== null && eye !== JSON.stringify(this.eye());
  }

  private track(work: Promise<void>): void {
    this.pending.add(work);
    void work.finally(() => this.pending.delete(work));
  }

  private meshOf(entry: number, { tau, target, walls }: SurfaceRequest, maxTriangles: number): Promise<Mesh> {
    const channel = this.channels.get(entry) as Channel;
    if (this.asPoints && maxTriangles === FULL) return this.api.points(channelName(entry), tau, target, DIVISIONS, walls);
    const mayHaveLevels = channel.loadState.within !== null && channel.hasNoLevels !== channel.key;
    const eye = maxTriangles === FULL && mayHaveLevels ? this.eye() : undefined;
    if (!eye) return this.api.surface(channelName(entry), tau, target, maxTriangles, walls);
    channel.eye = JSON.stringify(eye);
    return this.api.surface(channelName(entry), tau, target, Math.floor(SEEN / this.channels.size), walls, eye);
  }

  /** levels: maximal numbers of triangles, loaded one after the other. */
  private async load(entry: number, channel: Channel, request: SurfaceRequest, levels: number[]): Promise<void> {
    const key = keyOf(request);
    const isDragged = !channel.untilFull;
    const isStale = (): boolean => channel.key !== key || this.channels.get(entry) !== channel;
    try {
      for (const maxTriangles of levels) {
        channel.requested = maxTriangles;
        channel.loadState = { ...channel.loadState, waiting: true };
        this.onUpdate(entry);
        const start = performance.now();
        let mesh = await this.meshOf(entry, request, maxTriangles);
        if (isDragged) this.dragged.took(performance.now() - start, mesh.coarse, this.frameTime());
        if (isStale()) return;
        if (maxTriangles === FULL && mesh.coarse && mesh.pixels === undefined && channel.hasNoLevels !== key) {
          channel.hasNoLevels = key; // coarse by blocks of cells: then the exact surface
          mesh = await this.meshOf(entry, request, maxTriangles);
          if (isStale()) return;
        }
        const isFirst = mesh.coarse || (this.asPoints && !mesh.isOpen); // coarse triangles first, then points
        const isLast = mesh.pixels !== undefined || !isFirst;
        channel.loadState = {
          key,
          triangles: mesh.triangles,
          points: mesh.spacing !== undefined ? mesh.positions.length / 3 : mesh.isOpen ? mesh.triangles / 2 : 0,
          bytes: mesh.bytes,
          coarse: !isLast,
          within: mesh.within ?? null,
          pixels: mesh.pixels ?? null,
          walls: request.walls === "cavities" && isLast && !mesh.isOpen ? countComponents(mesh.corners) : null,
          waiting: false,
          error: "",
        };
        this.onMesh(entry, mesh, request.tau);
        if (isLast) break;
      }
    } catch (error) {
      if (isStale() || isSuperseded(error)) return;
      if (error instanceof ConnectionError) channel.key = ""; // the same request is made again when there is a connection
      channel.loadState = { ...NONE, key, error: failureText(error) };
      this.onMesh(entry, null, request.tau);
    }
    channel.requested = 0;
    this.onUpdate(entry);
    const { next } = channel;
    channel.next = null;
    if (next) this.request(entry, next, true);
  }
}

function channelName(entry: number): string {
  return `surface ${entry}`;
}
