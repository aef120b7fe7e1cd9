// Surfaces inside a page that was opened from disk: turned, saved, and what is there without WebGL. Skipped where there is no Chromium.
import AxeBuilder from "axe-core";
import { existsSync, mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { MeshoptEncoder } from "meshoptimizer";
import { chromium, type Browser, type Page as Tab } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import type { LabelPage } from "../src/page/labels";
import { bytesOf } from "../src/shared/base64";
import type { Page, PageMesh } from "../src/shared/page";
import { stlOf } from "../src/shared/stl";
import { decodeMesh } from "../src/shared/wire";
import { branch, entry, page } from "./sample";
import { SOFTWARE_DRAWING, stableBox } from "./viewer_harness";

const browserFile = ["/usr/bin/chromium", "/usr/bin/chromium-browser"].find((file) => existsSync(file));
const bundled = fileURLToPath(new URL("../dist/atlas.html", import.meta.url));

/** A tetrahedron with a right angle at (10, 20, 30) and legs of 2, as src/preview/wire_mesh.h has it. */
async function tetrahedron(): Promise<PageMesh> {
  await MeshoptEncoder.ready;
  const points = new Uint8Array(4 * 8);
  const words = new Uint16Array(points.buffer);
  [[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4]].forEach((place, i) => words.set(place, 4 * i));
  const corners = new Uint32Array([0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]);
  const packed = MeshoptEncoder.encodeVertexBuffer(points, 4, 8);
  packed[0] = 0xa0; // version 0, as the server writes it
  const triangles = MeshoptEncoder.encodeIndexBuffer(new Uint8Array(corners.buffer), corners.length, 4);
  const bytes = new Uint8Array(56 + packed.length + triangles.length);
  const head = new DataView(bytes.buffer);
  head.setUint32(0, 0x69616d31, false);
  [4, 4, packed.length, triangles.length].forEach((number, i) => head.setUint32(4 + 4 * i, number, true));
  [10, 20, 30, 0.5].forEach((number, i) => head.setFloat64(24 + 8 * i, number, true));
  bytes.set(packed, 56);
  bytes.set(triangles, 56 + packed.length);
  return { data: Buffer.from(bytes).toString("base64"), triangles: 4, of: 4, keepsTopology: true };
}

/** Points of a binary STL, three a triangle. */
function pointsOf(stl: ArrayBuffer): number[][] {
  const view = new DataView(stl);
  const triangles = view.getUint32(80, true);
  expect(stl.byteLength).toBe(84 + 50 * triangles);
  return Array.from({ length: 3 * triangles }, (_, i) =>
    [0, 1, 2].map((axis) => view.getFloat32(84 + 50 * Math.floor(i / 3) + 12 + 12 * (i % 3) + 4 * axis, true)),
  );
}

describe("a mesh of a page", () => {
  it("is decoded and becomes STL in physical coordinates, seen from outside", async () => {
    const stl = stlOf(await decodeMesh(bytesOf((await tetrahedron()).data)));
    const points = pointsOf(stl);
    expect(new Set(points.map((point) => point.join(" ")))).toEqual(new Set(["10 20 30", "12 20 30", "10 22 30", "10 20 32"]));
    const det = (p: number[], q: number[], r: number[]): number =>
      p[0]! * (q[1]! * r[2]! - q[2]! * r[1]!) - p[1]! * (q[0]! * r[2]! - q[2]! * r[0]!) + p[2]! * (q[0]! * r[1]! - q[1]! * r[0]!);
    const sum = [0, 3, 6, 9].map((t) => det(points[t]!, points[t + 1]!, points[t + 2]!)).reduce((p, q) => p + q);
    expect(sum / 6).toBeCloseTo(8 / 6, 4); // positive: counter-clockwise from outside
  });
});

describe.skipIf(!browserFile || !existsSync(bundled))("a page that turns", () => {
  let browser: Browser;
  let blind: Browser;
  beforeAll(async () => {
    browser = await chromium.launch({ executablePath: browserFile, args: ["--no-sandbox", ...SOFTWARE_DRAWING] });
    blind = await chromium.launch({ executablePath: browserFile, args: ["--no-sandbox", "--disable-gpu", "--disable-3d-apis"] });
  });
  afterAll(() => Promise.all([browser.close(), blind.close()]));

  async function open(data: Page | LabelPage, hash = "", where = browser): Promise<{ tab: Tab; problems: string[] }> {
    const file = join(mkdtempSync(join(tmpdir(), "isoatlas-turn-")), "a.html");
    writeFileSync(file, readFileSync(bundled, "utf8").replace('json">null<', () => `json">${JSON.stringify(data)}<`));
    const tab = await where.newPage({ viewport: { width: 1000, height: 900 } });
    const problems: string[] = [];
    tab.on("pageerror", (error) => problems.push(error.message));
    tab.on("console", (message) => message.type() === "error" && where === browser && problems.push(message.text()));
    tab.on("request", (request) => /^(file|data|blob):/.test(request.url()) || problems.push(`asked for ${request.url()}`));
    await tab.goto(`file://${file}${hash}`);
    return { tab, problems };
  }
  const withMesh = async (changes: Partial<PageMesh> = {}): Promise<Page> =>
    page([branch({ id: 1 }), branch({ id: 2 })], [
      entry({ id: 1, mesh: { ...(await tetrahedron()), ...changes } }),
      entry({ id: 2, branch: 1, mesh: await tetrahedron() }),
    ]);
  const viewOf = (tab: Tab): Promise<string | null> => tab.locator(".solid canvas").getAttribute("data-view");

  it("turns an object with the pointer and with the keys", async () => {
    const { tab, problems } = await open(await withMesh(), "#object-1");
    const canvas = tab.locator(".detail .solid canvas");
    await canvas.waitFor();
    await expect.poll(() => viewOf(tab)).toBeTruthy();
    const first = await viewOf(tab);
    await canvas.focus();
    await tab.keyboard.press("ArrowRight");
    const second = await viewOf(tab);
    expect(second).not.toBe(first);
    await tab.keyboard.press("ArrowLeft");
    expect(await viewOf(tab)).toBe(first);
    const box = await stableBox(canvas);
    await tab.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await tab.mouse.down();
    await tab.mouse.move(box.x + box.width / 2 + 80, box.y + box.height / 2 + 30);
    await tab.mouse.up();
    await expect.poll(() => viewOf(tab)).not.toBe(first);
    expect(await tab.locator("#detail-title").textContent()).toContain("1"); // arrow keys on it do not leave the object
    expect(await tab.locator(".solid .note").textContent()).toContain("The exact surface, 4 triangles.");
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("saves the surface as STL", async () => {
    const { tab } = await open(await withMesh(), "#object-1");
    const [download] = await Promise.all([tab.waitForEvent("download"), tab.click(".save-stl")]);
    expect(download.suggestedFilename()).toBe("scan-object-1.stl");
    const bytes = readFileSync((await download.path()) as string);
    expect(pointsOf(new Uint8Array(bytes).buffer)).toHaveLength(12);
    await tab.close();
  });

  it("says whether the topology is that of the exact surface", async () => {
    for (const [keepsTopology, words] of [
      [true, "with the same components and tunnels"],
      [false, "without its smallest parts and tunnels"],
    ] as const) {
      const { tab } = await open(await withMesh({ of: 9000, keepsTopology }), "#object-1");
      await expect.poll(() => tab.locator(".solid .note").textContent()).toContain(words);
      await tab.close();
    }
  });

  it("gives its canvas back when another object is opened, or the dialog closes", async () => {
    const { tab, problems } = await open(await withMesh(), "#object-1");
    for (let i = 0; i < 20; ++i) {
      await tab.locator(".detail .solid canvas").waitFor(); // browsers lose the oldest of more than 16
      await tab.click('[aria-label="Next object"]');
    }
    expect(await tab.locator("canvas").count()).toBe(1);
    await tab.keyboard.press("Escape");
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("shows the picture where there is no WebGL", async () => {
    const { tab, problems } = await open(await withMesh(), "#object-1", blind);
    await tab.locator(".solid.picture-only").waitFor({ state: "attached" });
    expect(await tab.locator("canvas").count()).toBe(0);
    expect(await tab.locator(".save-stl").count()).toBe(1);
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("turns a label, and shows its picture again", async () => {
    const mesh = await tetrahedron();
    const labels: LabelPage = {
      schema: "isoatlas/label-page/1",
      version: "0.2.0",
      volume: { name: "labels", size: [4, 4, 4], type: "uint8", spacing: [1, 1, 1], unit: "mm" },
      notes: [],
      interpolant: "trilinear",
      background: 10,
      labels: [
        {
          ...{ label: 3, name: "Liver", voxels: 9, measure: 9, components: 1, tunnels: 0, cavities: 0 },
          ...{ colour: "#aa8800", picture: null, mesh, commands: [] },
        },
      ],
    };
    const { tab, problems } = await open(labels);
    await tab.click("text=Turn in 3D");
    await tab.locator("#label-3 .solid canvas").waitFor();
    await tab.click("text=Turn in 3D");
    expect(await tab.locator("#label-3 canvas").count()).toBe(0);
    expect(await tab.locator("#label-3 .turntable").count()).toBe(1);
    expect(problems).toEqual([]);
    await tab.close();
  });

  const violations = async (tab: Tab): Promise<string[]> => {
    await tab.evaluate(AxeBuilder.source);
    return tab.evaluate(async () => {
      const { axe } = globalThis as unknown as { axe: { run(): Promise<{ violations: { id: string; nodes: { html: string }[] }[] }> } };
      return (await axe.run()).violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html).join(" ")}`);
    });
  };

  for (const [colorScheme, width] of [
    ["light", 1000],
    ["dark", 1000],
    ["dark", 390],
  ] as const)
    it(`has no accessibility problem, ${colorScheme}, ${width} pixels wide, and says when it is not complete`, async () => {
      const data = await withMesh();
      data.complete = false;
      const { tab, problems } = await open(data, "#object-1");
      await tab.emulateMedia({ colorScheme, reducedMotion: "reduce" });
      await tab.setViewportSize({ width, height: 900 });
      await tab.locator(".detail .solid canvas").waitFor();
      expect(await violations(tab)).toEqual([]);
      expect(await tab.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(width);
      await tab.keyboard.press("Escape");
      expect(await violations(tab)).toEqual([]);
      expect(await tab.locator("header .assumed").textContent()).toContain("still drawing");
      expect(await tab.locator("text=Reload").count()).toBe(1);
      expect(problems).toEqual([]);
      await tab.close();
    });

  it("of labels says when it is not complete, without an accessibility problem", async () => {
    const data: LabelPage = {
      ...{ schema: "isoatlas/label-page/1", version: "0", notes: [], interpolant: "trilinear", background: 9, complete: false },
      volume: { name: "labels.nrrd", size: [4, 4, 4], type: "uint8", spacing: [1, 1, 1], unit: null },
      labels: [],
    };
    const { tab } = await open(data);
    expect(await tab.locator("header .assumed").textContent()).toContain("still drawing");
    expect(await violations(tab)).toEqual([]);
    await tab.close();
  });
});
