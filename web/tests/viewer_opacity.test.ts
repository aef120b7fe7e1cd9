// The editor of the opacity curve, in a browser: pointer, keys, touch, undo, links, the command line, narrow windows.
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { inflateSync } from "node:zlib";
import type { Locator, Page as Tab } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { layersIn, matterAt, opacityOf, type Layer } from "../src/viewer/state/opacity_curve";
import { march } from "../src/viewer/scene/compositing";
import { PLACES, transferTable } from "../src/viewer/api/transfer_function";
import { ballFile, MIDDLE, middlePixel, SIDE, SPACING } from "./ball";
import { canServe, Served, stableBox } from "./viewer_harness";

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const CENTRE = MIDDLE * SPACING;
const alongX = `&flat=1&view=${CENTRE - 40},${CENTRE},${CENTRE},${CENTRE},${CENTRE},${CENTRE}`;
/** two layers; the second is hidden */
const CURVE = "40:0:ff0000,50:0.08,60:0.02:0000ff,80:0;!90:0:00ff00,99:0.5";

interface Violation {
  id: string;
  nodes: { html: string }[];
}

function curveOf(tab: Tab): Layer[] | null {
  const text = new URLSearchParams(new URL(tab.url()).hash.slice(1)).get("curve");
  return text === null ? null : layersIn(text);
}

/** Opacity that the curve gives a ray through the middle: the value is 100 - 10 times the distance to it. */
function expectedOpacity(layers: Layer[], factor: number): number {
  const high = 100;
  const low = 100 - 10 * SPACING * MIDDLE * Math.sqrt(3);
  const place = (t: number): number => (PLACES * (100 - 10 * Math.abs(t - CENTRE) - low)) / (high - low);
  const table = transferTable(layers, low, high, SPACING / factor);
  return march(table, place, 0, (SIDE - 1) * SPACING, 0.005)[3];
}

describe.skipIf(!canServe)("the opacity curve", () => {
  let served: Served;
  let folder: string;
  beforeAll(async () => {
    folder = mkdtempSync(join(tmpdir(), "isoatlas-opacity-"));
    ballFile(join(folder, "ball.nrrd"));
    served = await Served.file(join(folder, "ball.nrrd"));
  });
  afterAll(async () => {
    await served?.close();
    rmSync(folder, { recursive: true });
  });

  const points = (tab: Tab): Locator => tab.locator(".opacity-plot .point");
  const undo = (tab: Tab): Promise<void> => tab.keyboard.press("Control+z");
  /** The editor, open. */
  async function edit(hash: string, options = {}): Promise<{ tab: Tab; problems: string[] }> {
    const opened = await served.open(hash, options);
    await expect.poll(() => opened.tab.locator(".volume-bar .about").textContent()).toContain("every sample");
    await opened.tab.getByRole("button", { name: "Opacity curve", exact: true }).click();
    await points(opened.tab).first().waitFor();
    return opened;
  }
  async function centre(handle: Locator): Promise<[number, number]> {
    const box = await stableBox(handle.locator(".dot"));
    return [box.x + box.width / 2, box.y + box.height / 2];
  }
  const open = (curve = CURVE): string => `#scene=&selected=-1&volume=1&curve=${curve}${alongX}`;

  it("starts from the proposal, and is dragged in one step of undo", async () => {
    const { tab, problems } = await edit(`#scene=&selected=-1&volume=1${alongX}`);
    expect(curveOf(tab)).toBeNull();
    const first = await points(tab).nth(1).getAttribute("aria-valuetext");
    const count = await points(tab).count();
    const [x, y] = await centre(points(tab).nth(1));
    await tab.mouse.move(x, y);
    await tab.mouse.down();
    for (let i = 1; i <= 10; ++i) await tab.mouse.move(x - i, y - 2 * i);
    await tab.mouse.up();
    await expect.poll(() => curveOf(tab)?.[0]?.points.length).toBe(count);
    const moved = await points(tab).nth(1).getAttribute("aria-valuetext");
    expect(moved).not.toBe(first);
    await undo(tab);
    await expect.poll(() => points(tab).nth(1).getAttribute("aria-valuetext")).toBe(first);
    await expect.poll(() => curveOf(tab)).toBeNull();
    await tab.keyboard.press("Control+y");
    await expect.poll(() => points(tab).nth(1).getAttribute("aria-valuetext")).toBe(moved);
    await tab.getByRole("button", { name: "Proposal" }).click();
    await expect.poll(() => curveOf(tab)).toBeNull();
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("draws what the integral along the ray says, and the command line draws the same", async () => {
    const layers = layersIn(CURVE)!;
    for (const factor of [1, 0.5]) {
      const expected = expectedOpacity(layers, factor);
      expect(expected).toBeGreaterThan(0.1);
      expect(expected).toBeLessThan(0.9);
      const { tab, problems } = await served.open(open().replace("volume=1", `volume=${factor}`));
      const opacity = async (): Promise<number> => ((await middlePixel(tab))[3] ?? 0) / 255;
      await expect.poll(async () => Math.abs((await opacity()) - expected)).toBeLessThan(0.02);
      await tab.context().grantPermissions(["clipboard-read", "clipboard-write"]);
      await tab.locator(".menus summary", { hasText: "Export" }).click();
      await tab.getByRole("button", { name: "Copy command" }).click();
      await expect.poll(() => tab.evaluate(() => navigator.clipboard.readText())).toContain("--transfer='40:0:#FF0000,");
      const command = await tab.evaluate(() => navigator.clipboard.readText());
      const words = [...command.matchAll(/'([^']*)'|([^\s']*'[^']*')|(\S+)/g)].map(([word]) => word.replaceAll("'", ""));
      served.isoatlas(...words.slice(1), "--background", "transparent", "--quiet");
      expect(Math.abs(middleAlpha(readFileSync(join(served.folder, "scene.png"))) - expected)).toBeLessThan(0.02);
      expect(problems).toEqual([]);
      await tab.close();
    }
  });

  it("is edited by keys alone", async () => {
    const { tab, problems } = await edit(open());
    expect(await tab.evaluate(() => document.activeElement?.getAttribute("data-point"))).toBe("0"); // opened: the first point
    await tab.keyboard.press("Tab");
    const now = (): Promise<string | null> => tab.evaluate(() => document.activeElement?.getAttribute("aria-valuetext") ?? null);
    expect(await now()).toBe("value 50, opacity 0.08");
    const before = await tab.evaluate(() => location.hash.match(/view=[^&]*/)![0]);
    await tab.keyboard.press("ArrowRight");
    const small = Number(/value ([\d.]+)/.exec((await now())!)![1]);
    await tab.keyboard.press("ArrowLeft");
    await tab.keyboard.press("Shift+ArrowLeft");
    const large = Number(/value ([\d.]+)/.exec((await now())!)![1]);
    expect(50 - large).toBeGreaterThan(5 * (small - 50));
    await tab.keyboard.press("Shift+ArrowUp");
    expect(Number(/opacity ([\d.]+)/.exec((await now())!)![1])).toBeCloseTo((Math.sqrt(0.08) + 0.05) ** 2, 3);
    const settled = (): number | undefined => curveOf(tab)?.[0]?.points[1]?.opacity; // in the link when the last step has ended
    await expect.poll(settled).toBeCloseTo((Math.sqrt(0.08) + 0.05) ** 2, 4);
    expect(curveOf(tab)?.[0]?.points[1]?.value).toBeCloseTo(large, 1);
    expect(await tab.evaluate(() => location.hash.match(/view=[^&]*/)![0])).toBe(before); // the camera stays
    const moved = await now();
    await tab.evaluate(() => {
      const key = (): KeyboardEvent => new KeyboardEvent("keydown", { key: "ArrowRight", bubbles: true, cancelable: true });
      for (let i = 0; i < 5; ++i) document.activeElement!.dispatchEvent(key()); // as fast as a key that is held
    });
    expect(await now()).not.toBe(moved);
    await tab.keyboard.press("Control+z"); // one step
    await expect.poll(now).toBe(moved);
    await tab.keyboard.press("Insert");
    await expect.poll(() => points(tab).count()).toBe(5);
    expect(Number(/value ([\d.]+)/.exec((await now())!)![1])).toBeCloseTo((large + 60) / 2, 1);
    await tab.keyboard.press("Delete");
    await expect.poll(() => points(tab).count()).toBe(4);
    await tab.keyboard.press("Escape");
    expect(await tab.locator(".volume-dock").isVisible()).toBe(false);
    expect(await tab.evaluate(() => document.activeElement?.textContent)).toBe("Opacity curve");
    await tab.keyboard.press("V");
    expect(await tab.locator(".volume-dock").isVisible()).toBe(true);
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("gets points by a press on the curve and by a double click, takes typed numbers and colours, and keeps two points", async () => {
    const { tab, problems } = await edit(open());
    const [[x1, y1], [x2, y2]] = [await centre(points(tab).nth(2)), await centre(points(tab).nth(3))];
    await tab.mouse.click((x1 + x2) / 2, y1 + 0.3 * (y2 - y1), { delay: 20 });
    await expect.poll(() => curveOf(tab)?.[0]?.points.length).toBe(5); // the fourth is on the curve
    const added = curveOf(tab)![0]!.points[3]!;
    expect(added.opacity).toBeCloseTo(opacityOf(matterAt(layersIn(CURVE)![0]!.points, added.value).extinction), 5);
    const [x0, y0] = await centre(points(tab).nth(0));
    await tab.mouse.dblclick(x0 - 60, y0 - 30);
    await expect.poll(() => curveOf(tab)?.[0]?.points.length).toBe(6);
    expect(curveOf(tab)![0]!.points[0]!.value).toBeLessThan(40);
    expect(curveOf(tab)![0]!.points[0]!.opacity).toBeGreaterThan(0.01);
    await undo(tab);
    await expect.poll(() => points(tab).count()).toBe(5);
    const value = tab.getByRole("textbox", { name: "value of the point" });
    const opacity = tab.getByRole("textbox", { name: /opacity of a voxel/ });
    await points(tab).nth(1).focus();
    await value.fill("45.5");
    await value.press("Enter");
    await opacity.fill("0.3");
    await opacity.press("Tab");
    await expect.poll(() => curveOf(tab)?.[0]?.points[1]).toMatchObject({ value: 45.5, opacity: 0.3 });
    await value.fill("500");
    await value.press("Tab");
    await tab.getByText(/stays between its neighbours/).waitFor();
    await value.fill("much");
    await value.press("Tab");
    await tab.getByText(/"much" is not a number/).waitFor();
    await tab.getByLabel("colour of the point").fill("#12ab34");
    await expect.poll(() => curveOf(tab)?.[0]?.points[1]?.colour).toBe("#12ab34");
    const remove = tab.getByRole("button", { name: "Remove", exact: true });
    for (let left = await points(tab).count(); left > 2; --left) await remove.click();
    await remove.click();
    await tab.getByText("A curve has at least two points.").waitFor();
    expect(await points(tab).count()).toBe(2);
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("is dragged by touch", async () => {
    const { tab, problems } = await edit(open(), { hasTouch: true, viewport: { width: 390, height: 844 } });
    const [x, y] = await centre(points(tab).nth(1));
    const device = await tab.context().newCDPSession(tab);
    const touch = (type: string, at: [number, number] | null): Promise<unknown> =>
      device.send("Input.dispatchTouchEvent", { type: type as "touchStart", touchPoints: at ? [{ x: at[0], y: at[1] }] : [] });
    await touch("touchStart", [x, y]);
    for (let i = 1; i <= 8; ++i) await touch("touchMove", [x, y - 4 * i]);
    await touch("touchEnd", null);
    await expect.poll(() => curveOf(tab)?.[0]?.points[1]?.opacity).toBeGreaterThan(0.1);
    expect(curveOf(tab)?.[0]?.points[1]?.value).toBeCloseTo(50, 0);
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("shows and hides layers in the legend, and only one of them", async () => {
    const { tab, problems } = await edit(open());
    const shown = (): boolean[] | undefined => curveOf(tab)?.map(({ visible }) => visible);
    await tab.getByRole("button", { name: "show 90 to 99" }).click();
    await expect.poll(shown).toEqual([true, true]);
    expect(await tab.getByRole("button", { name: "show 90 to 99" }).getAttribute("aria-pressed")).toBe("true");
    await tab.getByRole("button", { name: "90 to 99", exact: true }).click();
    expect(await points(tab).count()).toBe(2);
    await tab.getByRole("button", { name: "Only this layer" }).click();
    await expect.poll(shown).toEqual([false, true]);
    await tab.getByRole("button", { name: "Show all layers" }).click();
    await expect.poll(shown).toEqual([true, true]);
    const slider = tab.getByRole("slider", { name: "opacity of the layer" });
    await slider.fill("0.5");
    await expect.poll(() => curveOf(tab)?.[1]?.points[1]?.opacity).toBeCloseTo(0.25, 6);
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("is restored by a link, and an invalid one is left out", async () => {
    const { tab, problems } = await edit(open());
    expect(await points(tab).nth(1).getAttribute("aria-valuetext")).toBe("value 50, opacity 0.08");
    await points(tab).nth(1).focus();
    await tab.keyboard.press("Shift+ArrowUp");
    await expect.poll(() => curveOf(tab)?.[0]?.points[1]?.opacity).toBeGreaterThan(0.1);
    const { hash } = new URL(tab.url());
    const again = await edit(hash);
    expect(curveOf(again.tab)).toEqual(curveOf(tab));
    const wrong = await edit(open("40:0:ff0000,50:7"));
    expect(curveOf(wrong.tab)).toBeNull();
    for (const one of [tab, again.tab, wrong.tab]) await one.close();
    expect([...problems, ...again.problems, ...wrong.problems]).toEqual([]);
  });

  it("is offered a remedy where an opaque surface hides it, which is one step of undo", async () => {
    const { tab, problems } = await served.open(`#scene=-1,30,1,1&selected=0${alongX}`);
    const note = tab.getByRole("group", { name: "surfaces hide the volume" });
    expect(await note.isVisible()).toBe(false);
    await tab.keyboard.press("v");
    expect(await note.getByRole("status").textContent()).toContain("An opaque surface hides the volume");
    await note.getByRole("button", { name: "Hide surfaces" }).click();
    await expect.poll(() => tab.url()).toContain("scene=-1,30,1,0&");
    expect(await note.isVisible()).toBe(false);
    await undo(tab);
    await expect.poll(() => tab.url()).toContain("scene=-1,30,1,1&");
    await note.getByRole("button", { name: "Make transparent" }).click();
    await expect.poll(() => tab.url()).toContain("scene=-1,30,0.35,1&");
    expect(await note.isVisible()).toBe(false);
    await undo(tab);
    await note.getByRole("button", { name: "leave the surfaces as they are" }).click();
    expect(await note.isVisible()).toBe(false);
    expect(tab.url()).toContain("scene=-1,30,1,1&");
    expect(problems).toEqual([]);
    await tab.close();
  });

  for (const [width, height] of [
    [1400, 900],
    [800, 600],
    [390, 844],
  ] as const) {
    it(`leaves room for the 3D view, ${width} x ${height}, and violates no rule of axe-core, light and dark`, async () => {
      for (const colorScheme of ["light", "dark"] as const) {
        const { tab } = await edit(`#scene=-1,60,1,1&selected=0&volume=1`, { colorScheme, viewport: { width, height } });
        const box = async (selector: string): Promise<{ x: number; y: number; width: number; height: number }> =>
          (await tab.locator(selector).boundingBox())!;
        const end = async (): Promise<number> => (await box(".viewport > canvas")).y + (await box(".viewport > canvas")).height;
        const covered = async (): Promise<number> => Math.abs((await end()) - (await box(".volume-dock")).y);
        await expect.poll(covered).toBeLessThanOrEqual(1);
        expect((await box(".viewport > canvas")).height).toBeGreaterThan(height / 3);
        const dock = await box(".volume-dock");
        const overflow = await tab.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
        expect(overflow).toBeLessThanOrEqual(0);
        expect(dock.x >= 0 && dock.x + dock.width <= width).toBe(true);
        const cut = await tab
          .locator(".opacity-editor .fields")
          .evaluateAll(
            (fields) =>
              fields.filter((field) => field.getBoundingClientRect().right > innerWidth || field.scrollWidth > field.clientWidth)
                .length,
          );
        expect(cut).toBe(0);
        const close = (await tab.getByRole("button", { name: "turn volume rendering off" }).boundingBox())!;
        expect(close.x + close.width).toBeLessThanOrEqual(width);
        await tab.evaluate(axe);
        const found = await tab.evaluate(async () => {
          const { violations } = await (window as unknown as { axe: { run(): Promise<{ violations: Violation[] }> } }).axe.run();
          return violations.flatMap(({ id, nodes }) => nodes.map(({ html }) => `${id}: ${html.slice(0, 160)}`));
        });
        expect(found).toEqual([]);
        await tab.close();
      }
    });
  }

  it("leaves room for the 3D view on a phone with slices, too", async () => {
    const { tab, problems } = await edit("#scene=-1,60,1,1&selected=0&volume=1&slices=1", { viewport: { width: 390, height: 844 } });
    const ends = (): Promise<number[]> =>
      tab.evaluate(() =>
        [".viewport > canvas", ".volume-dock", ".slices"].map((name) => document.querySelector(name)!.getBoundingClientRect())
          .flatMap(({ top, bottom }) => [Math.round(top), Math.round(bottom)]),
      );
    const areInOrder = async (): Promise<boolean> => {
      const [top, canvas, dock, dockEnd, slices] = (await ends()) as [number, number, number, number, number];
      return canvas - top > 844 / 3 && Math.abs(canvas - dock) <= 1 && Math.abs(dockEnd - slices) <= 1;
    };
    await expect.poll(areInOrder).toBe(true);
    expect(await tab.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(390);
    expect(problems).toEqual([]);
    await tab.close();
  });
});

/** Alpha in the middle of a picture, 0 to 1. PNG with 8 bits, red, green, blue and alpha, not interlaced. */
function middleAlpha(file: Buffer): number {
  const parts: Buffer[] = [];
  let [width, height] = [0, 0];
  for (let at = 8; at < file.length;) {
    const length = file.readUInt32BE(at);
    const name = file.toString("latin1", at + 4, at + 8);
    const data = file.subarray(at + 8, at + 8 + length);
    if (name === "IHDR") [width, height] = [data.readUInt32BE(0), data.readUInt32BE(4)];
    if (name === "IDAT") parts.push(data);
    at += 12 + length;
  }
  const bytes = inflateSync(Buffer.concat(parts));
  const stride = 4 * width;
  const rows: Uint8Array[] = [];
  for (let y = 0; y < height; ++y) {
    const filter = bytes[y * (stride + 1)]!;
    const row = Uint8Array.from(bytes.subarray(y * (stride + 1) + 1, (y + 1) * (stride + 1)));
    for (let i = 0; i < stride; ++i) {
      const [left, up, corner] = [row[i - 4] ?? 0, rows[y - 1]?.[i] ?? 0, i >= 4 ? (rows[y - 1]?.[i - 4] ?? 0) : 0];
      const guess = left + up - corner;
      const [a, b, c] = [left, up, corner].map((n) => Math.abs(guess - n)) as [number, number, number];
      const paeth = a <= b && a <= c ? left : b <= c ? up : corner;
      row[i] = row[i]! + [0, left, up, (left + up) >> 1, paeth][filter]!;
    }
    rows.push(row);
  }
  return rows[height >> 1]![4 * (width >> 1) + 3]! / 255;
}
