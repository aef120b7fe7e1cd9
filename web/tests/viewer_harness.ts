// Runs `isoatlas view` on a volume and a browser that opens the viewer; shared by the tests of the viewer. Skipped without
// Chromium or isoatlas.
import { webcrypto } from "node:crypto";
import { execFileSync, spawn, type ChildProcess } from "node:child_process";
import { existsSync, mkdtempSync, rmSync, symlinkSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, join } from "node:path";
import { chromium, type Browser, type BrowserContextOptions, type Frame, type Locator, type Page as Tab } from "playwright-core";

globalThis.crypto ??= webcrypto as Crypto; // Debian's Node 18 keeps it to itself

const browserFile = ["/usr/bin/chromium", "/usr/bin/chromium-browser"].find((file) => existsSync(file));
const cli = process.env.ISOATLAS_CLI ?? "";
export const SOFTWARE_DRAWING = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];

export const canServe = browserFile !== undefined && existsSync(cli);

/** A response to a request for a mesh. */
export interface AskedMesh {
  asked: URLSearchParams;
  triangles: number;
  coarse: boolean;
}

export class Served {
  private constructor(
    readonly folder: string,
    /** http://127.0.0.1:PORT */
    readonly origin: string,
    /** bearer token of programs */
    readonly token: string,
    /** the served store, in the folder */
    readonly store: string,
    private server: ChildProcess,
    readonly browser: Browser,
  ) {}

  /** phantom: its name and options, such as "demo" or "torus-chain", "--size", "32". */
  static async phantom(...phantom: string[]): Promise<Served> {
    const [folder, name] = made(phantom);
    build(folder, name);
    return Served.begin(folder, name);
  }

  /** A volume without a store: it is built while the page is open. options: of the viewer. */
  static async building(phantom: string[], options: string[] = []): Promise<Served> {
    return Served.begin(...made(phantom), options);
  }

  /** An existing volume. isBuilt: its store is there before the viewer; else the viewer builds it. */
  static async file(path: string, isBuilt = true): Promise<Served> {
    const folder = mkdtempSync(join(tmpdir(), "isoatlas-viewer-"));
    const name = basename(path).replace(/\..*/, "");
    const extension = basename(path).slice(name.length);
    symlinkSync(path, join(folder, name + extension));
    if (isBuilt) build(folder, name, extension);
    return Served.begin(folder, name, [], extension);
  }

  /** An existing store, with the levels of detail beside it or without them. */
  static async store(path: string, hasLevels = true): Promise<Served> {
    const folder = mkdtempSync(join(tmpdir(), "isoatlas-viewer-"));
    const name = basename(path, ".atlas");
    const files = hasLevels ? [".atlas", ".atlas.lod"] : [".atlas"];
    for (const file of files) symlinkSync(path.replace(/\.atlas$/, file), join(folder, name + file));
    return Served.begin(folder, name, [], ".atlas");
  }

  private static async begin(folder: string, name: string, options: string[] = [], extension = ".nrrd"): Promise<Served> {
    const token = crypto.randomUUID().replaceAll("-", "");
    const { server, address } = await started(folder, token, [name + extension, ...options]);
    const browser = await chromium.launch({ executablePath: browserFile, args: SOFTWARE_DRAWING });
    return new Served(folder, new URL(address).origin, token, `${name}.atlas`, server, browser);
  }

  /** An address that opens the page once. */
  async address(): Promise<string> {
    const answer = await fetch(`${this.origin}/api/address`, { headers: { Authorization: `Bearer ${this.token}` } });
    return ((await answer.json()) as { address: string }).address;
  }

  /** Ends only the server. */
  end(): void {
    this.server.kill("SIGINT");
  }

  /** Kills the server; resolves when it has ended. */
  async kill(): Promise<void> {
    const ended = new Promise((resolve) => this.server.once("exit", resolve));
    this.server.kill("SIGKILL");
    await ended;
  }

  /** Starts it again, on its port and with its token. store: another one. */
  async restart(store = this.store, ...options: string[]): Promise<void> {
    const { server } = await started(this.folder, this.token, [store, "--port", new URL(this.origin).port, ...options]);
    this.server = server;
  }

  async close(): Promise<void> {
    await this.browser.close();
    this.end();
    rmSync(this.folder, { recursive: true });
  }

  /** Output of the command line. */
  isoatlas(...words: string[]): string {
    return execFileSync(cli, words, { cwd: this.folder, encoding: "utf8" });
  }

  /** A tab with the viewer, and its errors so far. firstTime: with the introduction. */
  async open(hash = "", options: BrowserContextOptions = {}, firstTime = false): Promise<{ tab: Tab; problems: string[] }> {
    const tab = await this.browser.newPage({ viewport: { width: 1000, height: 700 }, ...options });
    if (!firstTime) await tab.addInitScript(() => localStorage.setItem("isoatlas-tour", "seen"));
    tab.setDefaultTimeout(120_000);
    const problems: string[] = [];
    tab.on("pageerror", (error) => problems.push(error.message));
    const isSuperseded = (text: string): boolean => text.includes("409 (Conflict)"); // a newer request has ended it, as it should
    tab.on("console", (message) => message.type() === "error" && !isSuperseded(message.text()) && problems.push(message.text()));
    await tab.goto((await this.address()) + hash);
    await tab.waitForSelector(".objects [role=tab]");
    return { tab, problems };
  }
}

/** The server, and the address that it prints. */
async function started(folder: string, token: string, words: string[]): Promise<{ server: ChildProcess; address: string }> {
  const env = { ...process.env, ISOATLAS_TOKEN: token, XDG_RUNTIME_DIR: folder, XDG_STATE_HOME: folder };
  const server = spawn(cli, ["view", ...words, "--no-browser", "--quiet"], { cwd: folder, env });
  const address = await new Promise<string>((resolve) => server.stdout?.once("data", (bytes: Buffer) => resolve(String(bytes).trim())));
  return { server, address };
}

/** Creates a folder with a phantom; returns it and the name of its file without .nrrd. */
function made(phantom: string[]): [string, string] {
  const folder = mkdtempSync(join(tmpdir(), "isoatlas-viewer-"));
  const name = phantom[0] ?? "demo";
  execFileSync(cli, ["phantom", ...phantom, "-o", `${name}.nrrd`, "--quiet"], { cwd: folder });
  return [folder, name];
}

function build(folder: string, name: string, extension = ".nrrd"): void {
  execFileSync(cli, ["build", name + extension, "-o", `${name}.atlas`, "--quiet"], { cwd: folder });
}

/**
 * Where an element is once it stands still: in the same place in ten frames, and nothing covers its middle. Places on the screen that
 * were taken while a panel opened belong to something else when the pointer arrives there.
 */
export async function stableBox(locator: Locator): Promise<{ x: number; y: number; width: number; height: number }> {
  return locator.first().evaluate(
    (element) =>
      new Promise((resolve) => {
        let before = "";
        let frames = 0;
        const look = (): void => {
          const { x, y, width, height } = element.getBoundingClientRect();
          const now = [x, y, width, height].join(" ");
          const there = document.elementFromPoint(x + width / 2, y + height / 2);
          const isThere = there !== null && (element.contains(there) || (element.parentElement?.contains(there) ?? false));
          frames = now === before && width > 0 && isThere ? frames + 1 : 0;
          before = now;
          if (frames >= 10) resolve({ x, y, width, height });
          else requestAnimationFrame(look);
        };
        look();
      }),
  );
}

/** Responses with meshes from now on. */
export function meshes(tab: Tab): AskedMesh[] {
  const list: AskedMesh[] = [];
  tab.on("response", (answer) => {
    const url = new URL(answer.url());
    if (url.pathname !== "/api/surface" || answer.status() !== 200) return;
    list.push({
      asked: url.searchParams,
      triangles: Number(answer.headers()["x-triangles"]),
      coarse: answer.headers()["x-coarse"] === "1",
    });
  });
  return list;
}

export interface Picture {
  width: number;
  height: number;
  /** red, green, blue, alpha */
  data: Uint8Array;
}

/** What the viewport shows. */
export async function pictureOf(frame: Frame | Tab): Promise<Picture> {
  const { width, height, text } = await frame.evaluate(() => {
    const canvas = document.querySelector<HTMLCanvasElement>(".viewport canvas")!;
    const copy = document.createElement("canvas");
    [copy.width, copy.height] = [canvas.width, canvas.height];
    const pen = copy.getContext("2d")!;
    pen.drawImage(canvas, 0, 0);
    const bytes = pen.getImageData(0, 0, copy.width, copy.height).data;
    let binary = "";
    for (let i = 0; i < bytes.length; i += 32_768) binary += String.fromCharCode(...bytes.subarray(i, i + 32_768));
    return { width: copy.width, height: copy.height, text: btoa(binary) };
  });
  return { width, height, data: Uint8Array.from(Buffer.from(text, "base64")) };
}
