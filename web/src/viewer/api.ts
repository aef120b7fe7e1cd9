// Questions to `isoatlas view`: docs/server.md. A question for a surface ends the one before it of the same lane.
import { decodeMesh, type Mesh } from "./wire";

export interface Entry {
  id: number;
  /** null: beyond all samples */
  appears: number | null;
  merges: number | null;
  best: number;
  low: number;
  high: number;
  voxels: number;
  measure: number;
  tunnels: number;
  cavities: number;
  position: [number, number, number];
  inside: number;
  trunk: boolean;
  note: string;
}

export interface Atlas {
  name: string;
  size: number[];
  type: string;
  spacing: [number, number, number];
  origin: [number, number, number];
  direction: [number, number, number][];
  unit: string | null;
  valueUnit: string | null;
  low: number;
  high: number;
  noise: number;
  branches: number;
  objects: Entry[];
}

export interface Preview {
  tau: number;
  objects: number;
  contours: number;
  tunnels: number;
  cavities: number;
  /** at least, at most */
  triangles: [number, number];
  bytes: [number, number];
}

/** What the server says when it cannot answer. */
export class Refusal extends Error {
  constructor(
    readonly status: number,
    message: string,
  ) {
    super(message);
  }
}

export class Api {
  private readonly client = crypto.randomUUID();
  private readonly lanes = new Map<string, AbortController>();

  constructor(
    private readonly token: string,
    private readonly base = "",
  ) {}

  atlas(): Promise<Atlas> {
    return this.ask("/api/atlas", "atlas").then((answer) => answer.json() as Promise<Atlas>);
  }

  preview(tau: number): Promise<Preview> {
    return this.ask(`/api/preview?tau=${tau}`, "preview").then((answer) => answer.json() as Promise<Preview>);
  }

  /** object: a voxel in it; null: all there is. most: triangles; fewer come where there are more. */
  async surface(lane: string, tau: number, object: number | null, most: number): Promise<Mesh> {
    const which = object === null ? "" : `&object=${object}`;
    const answer = await this.ask(`/api/surface?tau=${tau}${which}&most=${most}`, lane);
    return decodeMesh(await answer.arrayBuffer(), answer.headers.get("X-Coarse") === "1");
  }

  /** The file that `isoatlas extract` writes. */
  async file(tau: number, object: number | null, format: string): Promise<Blob> {
    const which = object === null ? "" : `&object=${object}`;
    return (await this.ask(`/api/surface?tau=${tau}${which}&format=${format}`, "file")).blob();
  }

  /** Ends what a lane is waiting for. */
  leave(lane: string): void {
    this.lanes.get(lane)?.abort();
    this.lanes.delete(lane);
  }

  private async ask(path: string, lane: string): Promise<Response> {
    this.leave(lane);
    const abort = new AbortController();
    this.lanes.set(lane, abort);
    const headers = { Authorization: `Bearer ${this.token}`, "X-Client": `${this.client}/${lane}` };
    const answer = await fetch(this.base + path, { headers, signal: abort.signal });
    if (!answer.ok) throw new Refusal(answer.status, await messageOf(answer));
    return answer;
  }
}

async function messageOf(answer: Response): Promise<string> {
  try {
    const refusal = (await answer.json()) as { error: { message: string } };
    return refusal.error.message;
  } catch {
    return `the server answered ${answer.status}`;
  }
}

/** A question that a newer one has ended is no failure. */
export function isOvertaken(error: unknown): boolean {
  return (error instanceof DOMException && error.name === "AbortError") || (error instanceof Refusal && error.status === 409);
}
