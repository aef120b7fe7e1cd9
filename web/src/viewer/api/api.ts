// Requests to `isoatlas view`: docs/server.md. A request supersedes the earlier one of the same channel.
import { voxelWord } from "../../shared/names";
import { readPage, type Page, type Picture } from "../../shared/page";
import type { BranchList } from "./catalogue";
import { Connection } from "./connection";
import { messages, type ServerState } from "./server_state";
import type { ShellFilter } from "../state/state";
import { decodeMesh, type Mesh } from "../../shared/wire";

/** Target of a surface: the object that contains a voxel, the wall of a cavity, or the whole isosurface. */
export type SurfaceTarget = ({ object: number } | { contour: number }) & { polarity?: Polarity } | null;

/** From where a scene is seen: a point, how wide a pixel is at a distance of 1, and the cone around the picture. */
export interface Eye {
  at: readonly number[];
  pixel: number;
  towards: readonly number[];
  /** of the whole cone, degrees */
  angle: number;
}

/** of requests about objects of low values of a page of both */
export type Polarity = "low" | undefined;

export interface Preview {
  tau: number;
  /** the requested one; null: no object with this id */
  object?: ObjectAtIsovalue | null;
  objects: number;
  contours: number;
  tunnels: number;
  cavities: number;
  /** at least, at most */
  triangles: [number, number];
  bytes: [number, number];
}

/** Topology of an object at an isovalue. */
export interface ObjectAtIsovalue {
  id: number;
  tunnels: number;
  cavities: number;
  /** at least, at most */
  voxels: [number, number];
}

/** Size of an object at an isovalue, in the unit of the file. */
export interface Measures extends ObjectAtIsovalue {
  area: number;
  volume: number;
  sphericity: number;
  /** null: flat within rounding */
  feret: { max: number | null; min: number | null; mean: number | null };
  values: { mean: number; min: number; max: number; sum: number; deviation: number };
  /** the volume ends before the object does */
  touches_border: boolean;
}

/** A name of an object or cavity: docs/schema/server-names.schema.json */
export interface GivenName {
  name: string;
  side: "object" | "cavity";
  polarity?: "high" | "low";
  id: number;
  tau: number;
}

/** between polls for pending requests, in milliseconds */
const PAUSE = 50;

/** the request that tells whether a server has the volume of the page */
const PAGE_CHANNEL = "atlas";

/** requests that give immediate feedback, sent before others */
const PREVIEW_CHANNEL = "preview";

/** An error response of the server. */
export class ServerError extends Error {
  constructor(
    readonly status: number,
    message: string,
  ) {
    super(message);
  }
}

/** The scene of the server, as JSON; empty: none. */
export interface SharedScene {
  text: string;
  /** name of its file, where it has one */
  file: string;
  /** 0: the server was started with it */
  version: number;
  /** whether this page has set it */
  isOwn: boolean;
}

/** Channels and time steps of the file, of which the page shows one volume: docs/schema/server-volumes.schema.json */
export interface Volumes {
  /** number of the page's: channel + channels * time step */
  volume: number;
  /** "" without a name */
  channels: string[];
  time_steps: number;
  /** of the time steps, or empty */
  times: number[];
  time_unit: string;
}

/** There is no connection to the server, which the page says once (waiting.ts). */
export class ConnectionError extends Error {
  constructor() {
    super("no connection");
  }
}

/** Why a request about an object failed, beside its title. */
export function failureText(error: unknown): string {
  if (error instanceof ServerError && error.status === 404) return "does not exist";
  return error instanceof Error ? error.message : String(error);
}

export class Api {
  readonly connection = new Connection();
  private readonly client = randomName();
  private surfaces = 0;
  private readonly channels = new Map<string, AbortController>();

  constructor(
    /** of this browser, or the token of a program */
    private token: string,
    /** before the path of each request: those of a page are beside it, also where a proxy serves it below a path of its own */
    private readonly base = ".",
    /** of a page in a frame, instead of cookie and token; empty: it is in a tab */
    private readonly frameKey = "",
  ) {}

  /** Is the page in a frame of another one, with which it shares its scene? */
  get isInFrame(): boolean {
    return this.frameKey !== "";
  }

  /** Another tab may have got another key, from a server that runs again. */
  takeKey(key: string): void {
    if (key !== "") this.token = key;
  }

  async page(): Promise<Page> {
    const page = readPage(await (await this.request("/api/atlas", PAGE_CHANNEL)).text());
    if (page === null) throw new Error("The response of the server is not an atlas. Reload the page.");
    return page;
  }

  async volumes(): Promise<Volumes> {
    return (await this.request("/api/volumes", "volumes")).json() as Promise<Volumes>;
  }

  /** The scene with which the server was started, or which was set since. */
  async scene(): Promise<SharedScene> {
    const told = (await (await this.request("/api/scene", "scene")).json()) as ServerScene;
    const text = told.scene === null ? "" : JSON.stringify(told.scene);
    return { text, file: told.file, version: told.version, isOwn: told.client === this.client };
  }

  /** Sets it; returns its version. Rejected with 409 where it is not `after` any more. */
  async setScene(text: string, after: number): Promise<number> {
    const response = await this.request(`/api/scene?after=${after}`, "set scene", "PUT", text);
    return ((await response.json()) as { version: number }).version;
  }

  /** The objects of highest rank, at most `top`. */
  branches(top: number): Promise<BranchList> {
    return this.request(`/api/branches?top=${top}`, "branches").then((response) => response.json() as Promise<BranchList>);
  }

  /** Number of objects that a selection keeps: state/selection.ts, selectionOptions(). */
  async kept(selection: [string, number][]): Promise<number> {
    const response = await this.request(`/api/branches?top=1${selection.map(([name, number]) => `&${name}=${number}`).join("")}`, "kept");
    return ((await response.json()) as { kept: number }).kept;
  }

  /** null: nothing to draw. */
  async card(of: { entry: number } | { branch: number }, frames: number): Promise<Picture | null> {
    const response = await this.request(`/api/card?frames=${frames}${parameters(of)}`, "card");
    return ((await response.json()) as { picture: Picture | null }).picture;
  }

  /** object: include this object; null: none. */
  preview(tau: number, object: number | null, polarity?: Polarity): Promise<Preview> {
    const path = `/api/preview?tau=${tau}${object === null ? "" : parameters({ object })}${ofPolarity(polarity)}`;
    return this.request(path, PREVIEW_CHANNEL).then((response) => response.json() as Promise<Preview>);
  }

  /** Of the objects that contain these voxels. */
  async measures(tau: number, objects: number[], polarity?: Polarity): Promise<Measures[]> {
    const path = `/api/measures?tau=${tau}&object=${objects.map(voxelWord).join(",")}${ofPolarity(polarity)}`;
    const response = (await (await this.request(path, "measures")).json()) as {
      objects: Measures[];
    };
    return response.objects;
  }

  /**
   * maxTriangles: if there are more, a coarser surface with the same topology, or else so many points of it; eye: less where it is near, if
   * there are levels of detail.
   */
  surface(channel: string, tau: number, target: SurfaceTarget, maxTriangles: number, walls: ShellFilter = "all", eye?: Eye): Promise<Mesh> {
    return this.mesh(channel, `tau=${tau}${parameters(target)}${shell(walls)}&max=${maxTriangles}${seenFrom(eye)}`);
  }

  /** The points of Dividing Cubes, `divisions` along each axis of a cell, as squares of two triangles. */
  async points(channel: string, tau: number, target: SurfaceTarget, divisions: number, walls: ShellFilter): Promise<Mesh> {
    const squares = await this.mesh(channel, `tau=${tau}${parameters(target)}${shell(walls)}&points=${divisions}`);
    return { ...squares, isOpen: true };
  }

  private async mesh(channel: string, query: string): Promise<Mesh> {
    ++this.surfaces;
    try {
      const response = await this.request(`/api/surface?${query}`, channel);
      const mesh = await decodeMesh(await response.arrayBuffer(), response.headers.get("X-Coarse") === "1");
      const number = (name: string): number | undefined => (response.headers.has(name) ? Number(response.headers.get(name)) : undefined);
      return { ...mesh, within: number("X-Distance"), pixels: number("X-Pixels"), spacing: number("X-Spacing") };
    } finally {
      --this.surfaces;
    }
  }

  /** The file that `isoatlas extract` writes. unit: of lengths, where the file of the volume says none. */
  async file(tau: number, target: SurfaceTarget, format: string, walls: ShellFilter, how: FileOptions): Promise<SavedFile> {
    const query = `tau=${tau}${parameters(target)}${shell(walls)}&format=${format}${inUnit(how.unit)}`;
    const simplify = how.within === null ? "" : `&simplify=${how.within}`;
    return savedFile(await this.request(`/api/surface?${query}${simplify}`, "file"));
  }

  /** The file that `isoatlas label` writes: of one object, or of all. */
  async labels(tau: number, object: number | null, format: string, unit: string | null, polarity?: Polarity): Promise<Blob> {
    const of = parameters(object === null ? null : { object }) + ofPolarity(polarity);
    return (await this.request(`/api/label?tau=${tau}${of}&format=${format}${inUnit(unit)}`, "file")).blob();
  }

  /** One file of several objects and contours, such as "2@1367", "v81275@40", "c1@20": "surfaces" or "segmentation". */
  async several(kind: SeveralKind, objects: string[], contours: string[], format: string, how: FileOptions): Promise<SavedFile> {
    const words = {
      object: objects.join(","),
      contour: contours.join(","),
      format,
      unit: how.unit ?? "",
      simplify: how.within === null ? "" : String(how.within),
    };
    const given = Object.entries(words).filter(([, word]) => word !== "");
    const query = given.map(([name, word]) => `${name}=${encodeURIComponent(word)}`).join("&");
    return savedFile(await this.request(`/api/${kind}?${query}`, "file"));
  }

  /** Names of objects and cavities. */
  async names(): Promise<GivenName[]> {
    return ((await (await this.request("/api/names", "names")).json()) as { names: GivenName[] }).names;
  }

  /** An empty name is taken away. Returns all names. */
  async rename(side: "object" | "contour", reference: string, name: string): Promise<GivenName[]> {
    const path = `/api/name?${side}=${encodeURIComponent(reference)}&name=${encodeURIComponent(name)}`;
    return ((await (await this.request(path, "rename", "PUT")).json()) as { names: GivenName[] }).names;
  }

  /** The state of the server and the pending requests of this page, on every change, until the connection ends. */
  async *events(): AsyncGenerator<ServerState> {
    const headers = { ...this.authorisation, "X-Client": this.client, Accept: "text/event-stream" }; // jupyter-server-proxy streams such
    const response = await fetch(this.base + "/api/events", { headers });
    if (!response.ok || !response.body) throw new ServerError(response.status, await messageOf(response));
    yield* messages(response.body);
  }

  /** Resolves when no surface is being loaded; low-priority requests wait for it. */
  async idle(): Promise<void> {
    do await new Promise((resolve) => setTimeout(resolve, PAUSE));
    while (this.surfaces > 0);
  }

  /** Aborts the pending request of a channel. */
  abort(channel: string): void {
    this.channels.get(channel)?.abort();
    this.channels.delete(channel);
  }

  private get authorisation(): Record<string, string> {
    return this.isInFrame ? { "X-Frame-Key": this.frameKey } : { Authorization: `Bearer ${this.token}` };
  }

  async request(path: string, channel: string, method = "GET", body?: string): Promise<Response> {
    this.abort(channel);
    if (this.connection.problem !== "" && channel !== PAGE_CHANNEL) throw new ConnectionError(); // it might reach another volume
    const controller = new AbortController();
    this.channels.set(channel, controller);
    const headers = { ...this.authorisation, "X-Client": `${this.client}/${channel}` };
    const priority = channel === PREVIEW_CHANNEL ? "high" : "auto"; // browsers limit the number of parallel requests to a server
    const options = { method, headers, body, signal: controller.signal, priority } as const;
    const response = await fetch(this.base + path, options).catch((error: unknown) => {
      throw error instanceof TypeError ? new ConnectionError() : error; // a TypeError: the network
    });
    if (!response.ok) throw new ServerError(response.status, await messageOf(response));
    return response;
  }
}

/** docs/schema/server-scene.schema.json */
interface ServerScene {
  version: number;
  client: string;
  file: string;
  scene: unknown;
}

/** crypto.randomUUID() is missing where the page around a frame has neither https nor a local address. */
function randomName(): string {
  return Array.from(crypto.getRandomValues(new Uint8Array(16)), (byte) => byte.toString(16).padStart(2, "0")).join("");
}

/** unit: null: that of the volume. within: fewer triangles, at most so many voxels from the exact surface; null: the exact surface. */
export interface FileOptions {
  unit: string | null;
  within: number | null;
}

/** simplified: of a surface with fewer triangles. */
export interface SavedFile {
  blob: Blob;
  simplified?: { triangles: number; distance: number };
}

async function savedFile(response: Response): Promise<SavedFile> {
  const blob = await response.blob();
  const distance = response.headers.get("X-Distance");
  if (distance === null) return { blob };
  return { blob, simplified: { triangles: Number(response.headers.get("X-Triangles")), distance: Number(distance) } };
}

export type SeveralKind = "surfaces" | "segmentation";

function inUnit(unit: string | null): string {
  return unit === null ? "" : `&unit=${encodeURIComponent(unit)}`;
}

function seenFrom(eye?: Eye): string {
  return eye ? `&eye=${eye.at.join(",")}&pixel=${eye.pixel}&towards=${eye.towards.join(",")}&angle=${eye.angle}` : "";
}

function shell(walls: ShellFilter): string {
  return walls === "cavities" ? "&shell=inner" : "";
}

function parameters(target: SurfaceTarget | { entry: number } | { branch: number }): string {
  const word = (name: string, id: number): string => (name === "object" || name === "contour" ? voxelWord(id) : String(id));
  const { polarity, ...named } = (target ?? {}) as { polarity?: Polarity } & Record<string, number>;
  const words = Object.entries(named).map(([name, id]) => `&${name}=${word(name, id)}`);
  return words.join("") + ofPolarity(polarity);
}

function ofPolarity(polarity: Polarity): string {
  return polarity === undefined ? "" : `&polarity=${polarity}`;
}

async function messageOf(response: Response): Promise<string> {
  try {
    const refusal = (await response.json()) as { error: { message: string } };
    return refusal.error.message;
  } catch {
    return `HTTP status ${response.status}`;
  }
}

/** A request that was superseded by a newer one is not a failure. */
export function isSuperseded(error: unknown): boolean {
  return (error instanceof DOMException && error.name === "AbortError") || (error instanceof ServerError && error.status === 409);
}
