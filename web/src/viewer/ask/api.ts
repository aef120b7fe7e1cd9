// Questions to `isoatlas view`: docs/server.md. A question for a surface ends the one before it of the same lane.
import { readPage, type Page, type Picture } from "../../page";
import type { Branches } from "./catalogue";
import { messages, type ServerState } from "./server_state";
import type { Walls } from "../state/state";
import { decodeMesh, type Mesh } from "./wire";

/** What a surface is of: an object that holds a voxel, the wall of a cavity, or all there is. */
export type Which = { object: number } | { contour: number } | null;

export interface Preview {
  tau: number;
  /** the one that was asked for; null: there is none of this name */
  object?: There | null;
  objects: number;
  contours: number;
  tunnels: number;
  cavities: number;
  /** at least, at most */
  triangles: [number, number];
  bytes: [number, number];
}

/** An object at an isovalue. */
export interface There {
  id: number;
  tunnels: number;
  cavities: number;
  /** at least, at most */
  voxels: [number, number];
}

/** How large an object is at an isovalue, in the unit of the file. */
export interface Measures extends There {
  area: number;
  volume: number;
}

/** before it is looked again whether there is something to wait for, in milliseconds */
const PAUSE = 50;

/** the lane of what answers the hand, before anything is made */
const AT_ONCE = "preview";

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
  private surfaces = 0;
  private readonly lanes = new Map<string, AbortController>();

  constructor(
    /** of this browser, or the token of a program */
    private readonly token: string,
    private readonly base = "",
  ) {}

  async page(): Promise<Page> {
    const page = readPage(await (await this.ask("/api/atlas", "atlas")).text());
    if (page === null) throw new Error("the server sent no atlas");
    return page;
  }

  /** The most important ones, at most so many. */
  branches(top: number): Promise<Branches> {
    return this.ask(`/api/branches?top=${top}`, "branches").then((answer) => answer.json() as Promise<Branches>);
  }

  /** How many objects a selection keeps: choosing.ts, selectionWords(). */
  async kept(selection: [string, number][]): Promise<number> {
    const answer = await this.ask(`/api/branches?top=1${selection.map(([name, number]) => `&${name}=${number}`).join("")}`, "kept");
    return ((await answer.json()) as { kept: number }).kept;
  }

  /** null: there is nothing to draw. */
  async card(of: { entry: number } | { branch: number }, frames: number): Promise<Picture | null> {
    const answer = await this.ask(`/api/card?frames=${frames}${words(of)}`, "card");
    return ((await answer.json()) as { picture: Picture | null }).picture;
  }

  /** object: one to be told of, too. */
  preview(tau: number, object: number | null): Promise<Preview> {
    const path = `/api/preview?tau=${tau}${object === null ? "" : words({ object })}`;
    return this.ask(path, AT_ONCE).then((answer) => answer.json() as Promise<Preview>);
  }

  /** Of the objects that hold these voxels. */
  async measures(tau: number, objects: number[]): Promise<Measures[]> {
    const answer = (await (await this.ask(`/api/measures?tau=${tau}&object=${objects.join(",")}`, "measures")).json()) as {
      objects: Measures[];
    };
    return answer.objects;
  }

  /** most: triangles; fewer come where there are more. */
  async surface(lane: string, tau: number, which: Which, most: number, walls: Walls = "all"): Promise<Mesh> {
    ++this.surfaces;
    try {
      const answer = await this.ask(`/api/surface?tau=${tau}${words(which)}${shell(walls)}&most=${most}`, lane);
      return await decodeMesh(await answer.arrayBuffer(), answer.headers.get("X-Coarse") === "1");
    } finally {
      --this.surfaces;
    }
  }

  /** The file that `isoatlas extract` writes. */
  async file(tau: number, which: Which, format: string, walls: Walls = "all"): Promise<Blob> {
    return (await this.ask(`/api/surface?tau=${tau}${words(which)}${shell(walls)}&format=${format}`, "file")).blob();
  }

  /** The file that `isoatlas label` writes: of one object, or of all. */
  async labels(tau: number, object: number | null, format: string): Promise<Blob> {
    return (await this.ask(`/api/label?tau=${tau}${object === null ? "" : `&object=${object}`}&format=${format}`, "file")).blob();
  }

  /** The state of the server and of this page's questions, whenever it changes, until the connection ends. */
  async *events(): AsyncGenerator<ServerState> {
    const answer = await fetch(`${this.base}/api/events`, { headers: { Authorization: `Bearer ${this.token}`, "X-Client": this.client } });
    if (!answer.ok || !answer.body) throw new Refusal(answer.status, await messageOf(answer));
    yield* messages(answer.body);
  }

  /** Until no surface is on its way: what nobody waits for should wait. */
  async quiet(): Promise<void> {
    do await new Promise((resolve) => setTimeout(resolve, PAUSE));
    while (this.surfaces > 0);
  }

  /** Ends what a lane is waiting for. */
  leave(lane: string): void {
    this.lanes.get(lane)?.abort();
    this.lanes.delete(lane);
  }

  async ask(path: string, lane: string): Promise<Response> {
    this.leave(lane);
    const abort = new AbortController();
    this.lanes.set(lane, abort);
    const headers = { Authorization: `Bearer ${this.token}`, "X-Client": `${this.client}/${lane}` };
    const priority = lane === AT_ONCE ? "high" : "auto"; // a browser asks a server only a few questions at a time
    const answer = await fetch(this.base + path, { headers, signal: abort.signal, priority });
    if (!answer.ok) throw new Refusal(answer.status, await messageOf(answer));
    return answer;
  }
}

function shell(walls: Walls): string {
  return walls === "cavities" ? "&shell=inner" : "";
}

function words(which: Which | { entry: number } | { branch: number }): string {
  return Object.entries(which ?? {})
    .map(([name, id]) => `&${name}=${id}`)
    .join("");
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
