// A scene of surfaces with levels of detail beside the exact one, from many places: the same silhouettes but for the pixels that it says,
// closed meshes, and not more triangles than may be drawn. ISOATLAS_LEVELS_STORE: another store with levels, of its first object at
// ISOATLAS_LEVELS_TAU; ISOATLAS_LEVELS_VIEWS: how many.
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Frame, Page as Tab } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { decodeMesh, type Mesh } from "../src/shared/wire";
import { canServe, meshes, pictureOf, Served, type Picture } from "./viewer_harness";

const STORE = process.env.ISOATLAS_LEVELS_STORE;
const TAU = Number(process.env.ISOATLAS_LEVELS_TAU ?? 0); // of the first object
const VIEWS = Number(process.env.ISOATLAS_LEVELS_VIEWS ?? 8);
const MOST = 1_000_000; // triangles that the page asks for
const BUDGET = STORE ? MOST : 60_000; // what it then gets

/** Uniform numbers below 1, the same each time. */
function randoms(seed: number): () => number {
  let state = seed;
  return () => {
    state = (Math.imul(state, 1_664_525) + 1_013_904_223) >>> 0;
    return state / 2 ** 32;
  };
}

/** Pixels of `one` without a pixel of `other` within so many pixels. */
function strays(one: Picture, other: Picture, reach: number): number {
  const isDrawn = ({ data }: Picture, i: number): boolean => (data[4 * i + 3] ?? 0) > 128;
  const { width, height } = one;
  const isNear = (x: number, y: number): boolean => {
    for (let v = Math.max(0, y - reach); v <= Math.min(height - 1, y + reach); v++)
      for (let u = Math.max(0, x - reach); u <= Math.min(width - 1, x + reach); u++) if (isDrawn(other, u + v * width)) return true;
    return false;
  };
  let count = 0;
  for (let i = 0; i < width * height; i++) if (isDrawn(one, i) && !isDrawn(other, i) && !isNear(i % width, Math.floor(i / width))) count++;
  return count;
}

/** Edges that are not those of two triangles, one in each direction. */
function openEdges(corners: ArrayLike<number>): number {
  const points = 1 + Array.from(corners).reduce((most, corner) => Math.max(most, corner), 0);
  const edges = new Float64Array(corners.length); // twice the number of the edge, and whether it runs upwards
  for (let i = 0; i < corners.length; i++) {
    const [from, to] = [corners[i]!, corners[i % 3 === 2 ? i - 2 : i + 1]!];
    edges[i] = 2 * (Math.min(from, to) * points + Math.max(from, to)) + Number(from < to);
  }
  edges.sort();
  let open = 0;
  for (let i = 0; i < edges.length; i += 2) if (edges[i]! % 2 !== 0 || edges[i + 1] !== edges[i]! + 1) open++;
  return open + (edges.length % 2);
}

interface Scene {
  shown: { tau: number }[];
  view: number[] | null;
}

/** A viewer in a frame, whose scene is changed from outside. */
class Shown {
  private constructor(
    private readonly served: Served,
    readonly tab: Tab,
    readonly frame: Frame,
    readonly problems: string[],
  ) {}

  static async open(served: Served): Promise<Shown> {
    const headers = { Authorization: `Bearer ${served.token}` };
    const { address } = (await (await fetch(`${served.origin}/api/address?for=frame`, { headers })).json()) as { address: string };
    const tab = await served.browser.newPage({ viewport: { width: 960, height: 640 } });
    const problems: string[] = [];
    tab.on("pageerror", (error) => problems.push(error.message));
    const isAll = (url: URL): boolean => url.pathname === "/api/surface" && url.searchParams.get("max") === String(MOST);
    await tab.route(isAll, (route) => route.continue({ url: route.request().url().replace(`max=${MOST}`, `max=${BUDGET}`) }));
    await tab.setContent(`<iframe src="${address}" width="900" height="600"></iframe>`);
    const frame = await (await tab.waitForSelector("iframe")).contentFrame();
    return new Shown(served, tab, frame!, problems);
  }

  async scene(): Promise<Scene | null> {
    const headers = { Authorization: `Bearer ${this.served.token}` };
    return ((await (await fetch(`${this.served.origin}/api/scene`, { headers })).json()) as { scene: Scene | null }).scene;
  }

  /** Resolves when the page has taken the view. */
  async look(scene: Scene, view: number[] | null): Promise<void> {
    const headers = { Authorization: `Bearer ${this.served.token}` };
    const body = JSON.stringify({ ...scene, view });
    expect((await fetch(`${this.served.origin}/api/scene`, { method: "PUT", headers, body })).status).toBe(200);
    const hash = view ? `view=${view.join()}` : "view=";
    await expect.poll(() => this.frame.evaluate(() => location.hash), { timeout: 60_000 }).toContain(hash);
  }

  /** What the page was sent. */
  async mesh(asked: URLSearchParams): Promise<Mesh> {
    asked.set("max", String(BUDGET));
    const headers = { Authorization: `Bearer ${this.served.token}` };
    return decodeMesh(await (await fetch(`${this.served.origin}/api/surface?${asked.toString()}`, { headers })).arrayBuffer());
  }

  notes(): Promise<string[]> {
    return this.frame.locator(".scene .state").allTextContents();
  }

  drawn(): Promise<unknown> {
    return this.frame.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
  }
}

describe.skipIf(!canServe)("surfaces with levels of detail", () => {
  const folder = mkdtempSync(join(tmpdir(), "isoatlas-levels-"));
  const store = STORE ?? join(folder, "field.atlas");
  const servers: Served[] = [];
  beforeAll(async () => {
    const cli = (...words: string[]): unknown => execFileSync(process.env.ISOATLAS_CLI ?? "", [...words, "--quiet"], { cwd: folder });
    if (!STORE) {
      cli("phantom", "random-field", "--size", "56", "-o", "field.nrrd");
      cli("build", "field.nrrd", "-o", "field.atlas");
      cli("levels", "field.atlas", "--object", "1@0");
    }
    servers.push(await Served.store(store), await Served.store(store, false));
  }, 600_000);
  afterAll(async () => {
    for (const served of servers) await served.close();
    rmSync(folder, { recursive: true });
  });

  it(`look like the exact ones from ${VIEWS} places`, { timeout: 3_600_000 }, async () => {
    const viewers = [await Shown.open(servers[0]!), await Shown.open(servers[1]!)];
    const [coarse, exact] = viewers as [Shown, Shown];
    const asked = meshes(coarse.tab);
    for (const viewer of viewers) {
      await expect.poll(() => viewer.scene(), { timeout: 60_000 }).not.toBeNull();
      const { shown, ...rest } = (await viewer.scene())!;
      await viewer.look({ ...rest, shown: [{ ...shown[0]!, tau: TAU }] }, null);
    }
    await expect.poll(() => coarse.notes(), { timeout: 600_000 }).toEqual([expect.stringMatching(/within .* pixel/)]);
    await expect.poll(() => exact.notes(), { timeout: 600_000 }).toEqual([expect.stringMatching(/triangles$/)]);
    await expect.poll(async () => (await coarse.scene())?.view).toBeTruthy();
    const scene = (await coarse.scene())!;
    const target = scene.view!.slice(3);
    const away = Math.hypot(...[0, 1, 2].map((i) => scene.view![i]! - target[i]!));
    const random = randoms(1);
    let [most, finest] = [0, Infinity];
    for (let i = 0; i < VIEWS; i++) {
      const [height, turn, far] = [2 * random() - 1, 2 * Math.PI * random(), away * (0.5 + random())];
      const beside = Math.sqrt(1 - height * height);
      const at = target.map((x) => x + 0.1 * away * (random() - 0.5));
      const eye = [Math.cos(turn) * beside, Math.sin(turn) * beside, height].map((x, axis) => at[axis]! + far * x);
      const view = [...eye, ...at].map((x) => Number(x.toPrecision(7)));
      for (const viewer of viewers) await viewer.look({ ...scene, shown: scene.shown }, view);
      await expect.poll(() => asked.at(-1)?.asked.get("eye"), { timeout: 60_000 }).toBe(view.slice(0, 3).join());
      await expect.poll(() => coarse.notes(), { timeout: 60_000 }).toEqual([expect.stringMatching(/exact topology, within .* pixel/)]);
      const [, triangles = "", pixels = ""] = /([\d,]+) triangles.*within ([\d.e-]+) pixel/.exec((await coarse.notes())[0]!) ?? [];
      most = Math.max(most, Number(triangles.replaceAll(",", "")));
      finest = Math.min(finest, Number(pixels));
      await Promise.all(viewers.map((viewer) => viewer.drawn()));
      const [one, other] = [await pictureOf(coarse.frame), await pictureOf(exact.frame)];
      const reach = Math.ceil(Number(pixels)) + 1; // and one of the raster
      expect([strays(one, other, reach), strays(other, one, reach)], `view ${i}, ${view.join()}, within ${pixels} pixels`).toEqual([0, 0]);
      expect(openEdges((await coarse.mesh(asked.at(-1)!.asked)).corners), `view ${i}, ${view.join()}`).toBe(0); // no hole
    }
    console.log(`${VIEWS} views, at most ${most} triangles, within ${finest} pixels at best`);
    expect(most).toBeLessThanOrEqual(BUDGET);
    for (const { tab, problems } of viewers) {
      expect(problems).toEqual([]);
      await tab.close();
    }
  });
});
