// Measures and volume rendering of a ball of known size, in a browser with `isoatlas view`.
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { Api } from "../src/viewer/api/api";
import { march } from "../src/viewer/scene/compositing";
import { PLACES, type OpacityTent } from "../src/viewer/api/transfer_function";
import { decodeVolume } from "../src/viewer/api/wire_samples";
import { ballFile, MIDDLE, middlePixel, RADIUS, SIDE, SPACING } from "./ball";
import { tableOfTents } from "./tents";
import { canServe, Served, stableBox } from "./viewer_harness";
import type { Page as Tab } from "playwright-core";

describe.skipIf(!canServe)("a ball", () => {
  let served: Served;
  let folder: string;
  const scene = `#scene=-1,${100 - 10 * RADIUS},1,1&selected=0`;
  beforeAll(async () => {
    folder = mkdtempSync(join(tmpdir(), "isoatlas-ball-"));
    ballFile(join(folder, "ball.nrrd"));
    served = await Served.file(join(folder, "ball.nrrd"));
  });
  afterAll(async () => {
    await served?.close();
    rmSync(folder, { recursive: true });
  });

  async function middleOf(tab: Tab): Promise<[number, number]> {
    const box = await stableBox(tab.locator(".viewport > canvas"));
    return [box.x + box.width / 2, box.y + box.height / 2];
  }
  const text = (tab: Tab): Promise<string[]> => tab.locator(".measures li b").allTextContents();

  it("is measured in the unit that the user chooses, which is in the link and in the table", async () => {
    const { tab, problems } = await served.open();
    const size = (): Promise<string> => tab.locator(".object").innerText();
    await expect.poll(size).toMatch(/enclosed volume\s+[\d.,]+ [mc]m³/);
    const unit = tab.getByRole("combobox", { name: "unit of lengths" });
    await unit.selectOption("µm");
    await expect.poll(size).toContain("µm³");
    await expect.poll(size).toMatch(/enclosed volume\s+[\d.,]+ µm³/);
    expect(await size()).not.toMatch(/[mc]m[²³]/);
    expect(await tab.locator(".cards .card .about").first().innerText()).toContain("µm³");
    await expect.poll(() => tab.locator(".scale").innerText()).toMatch(/^\d+ µm$/);
    expect(new URL(tab.url()).hash).toContain("unit=um");
    const other = await served.open(new URL(tab.url()).hash);
    expect(await other.tab.getByRole("combobox", { name: "unit of lengths" }).inputValue()).toBe("µm");
    await expect.poll(() => other.tab.locator(".scale").innerText()).toMatch(/^\d+ µm$/);
    await other.tab.close();
    await unit.selectOption("");
    await expect.poll(size).not.toContain("µm³");
    expect(new URL(tab.url()).hash).not.toContain("unit=");
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("has its diameter, clicked on both sides", async () => {
    const { tab, problems } = await served.open(scene);
    await tab.locator(".objects h1").click();
    await tab.waitForTimeout(800);
    for (const key of ["f", "y", "m"]) await tab.keyboard.press(key);
    await tab.waitForTimeout(300);
    await tab.mouse.click(...(await middleOf(tab)));
    await tab.keyboard.press("Y");
    await tab.waitForTimeout(300);
    await tab.mouse.click(...(await middleOf(tab)));
    await expect.poll(() => text(tab)).toHaveLength(1);
    const [length, unit] = ((await text(tab))[0] ?? "").split(" ");
    expect(Math.abs(Number(length) - 2 * RADIUS)).toBeLessThan(0.05);
    expect(unit).toBe("mm");
    expect(new URL(tab.url()).hash).toContain("measure=");
    await tab.keyboard.press("Control+z");
    await expect.poll(() => tab.locator(".measures").isHidden()).toBe(true);
    await tab.keyboard.press("Control+y");
    await tab.getByRole("button", { name: "remove distance" }).click();
    await expect.poll(() => tab.locator(".measures").isHidden()).toBe(true);
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("is measured by keys alone, angles too, and on a slice", async () => {
    const { tab, problems } = await served.open(`${scene}&slices=1&cross=6,20,20`);
    await tab.locator(".objects h1").click();
    for (const key of ["M", "e", ...Array<string>(14).fill("6"), "e", ...Array<string>(14).fill("8"), "e"]) await tab.keyboard.press(key);
    await expect.poll(() => text(tab)).toEqual(["90°"]);
    for (const key of ["m", "e", ...Array<string>(14).fill("5"), "e"]) await tab.keyboard.press(key);
    await expect.poll(() => text(tab)).toEqual(["90°", "7 mm"]);
    await tab.keyboard.press("m");
    const box = await stableBox(tab.locator(".slices canvas").nth(2));
    const sample = Math.min(box.width, box.height) / SIDE;
    for (const by of [-10, 10]) await tab.mouse.click(box.x + box.width / 2 + by * sample, box.y + box.height / 2);
    await expect.poll(() => text(tab)).toEqual(["90°", "7 mm", "10 mm"]);
    await tab.getByRole("button", { name: "view from the left" }).press("Enter");
    expect(problems).toEqual([]);
    await tab.close();
  });

  /** The medium along a line through the middle, by the transfer function of the server. */
  async function matterAlongX(factor: number): Promise<{ opacityTo: (end: number) => number; least: number }> {
    const api = new Api(served.token, served.origin);
    const volume = decodeVolume(await (await api.request("/api/volume", "volume")).arrayBuffer());
    const { tents } = (await (await api.request("/api/transfer", "transfer")).json()) as { tents: OpacityTent[] };
    expect(volume.size).toEqual([SIDE, SIDE, SIDE]);
    const table = tableOfTents(tents.map((tent) => ({ ...tent, density: factor * tent.density })), volume.low, volume.high);
    const placeAt = (t: number): number => {
      const sample = t / SPACING;
      const [i, u] = [Math.min(Math.floor(sample), SIDE - 2), sample - Math.min(Math.floor(sample), SIDE - 2)];
      const byte = (k: number): number => volume.bytes[k + SIDE * (MIDDLE + SIDE * MIDDLE)] ?? 0;
      return (PLACES / 255) * ((1 - u) * byte(i) + u * byte(i + 1));
    };
    return { opacityTo: (end) => march(table, placeAt, 0, end, 0.01)[3], least: Math.min(...tents.map(({ low }) => low)) };
  }
  const middle = [MIDDLE, MIDDLE, MIDDLE].map((n) => n * SPACING);
  const alongX = `&flat=1&view=${middle[0]! - 40},${middle[1]},${middle[2]},${middle.join()}`;

  it("absorbs as much light as the integral along the ray", async () => {
    const factor = 0.0625;
    const expected = (await matterAlongX(factor)).opacityTo((SIDE - 1) * SPACING);
    expect(expected).toBeGreaterThan(0.2);
    expect(expected).toBeLessThan(0.95);
    const { tab, problems } = await served.open(`#scene=&selected=-1&volume=${factor}${alongX}`);
    const opacity = async (): Promise<number> => ((await middlePixel(tab))[3] ?? 0) / 255;
    await expect.poll(opacity).toBeGreaterThan(0);
    await tab.waitForTimeout(600);
    expect(Math.abs((await opacity()) - expected)).toBeLessThan(0.02);
    expect(await tab.locator(".volume-bar").textContent()).toContain("41 × 41 × 41: every sample");
    expect(problems).toEqual([]);
    await tab.close();
  });

  /** The pixel in the middle with a surface, after convergence. */
  async function pixelOf(tau: number, colour: string, factor: number | null): Promise<number[]> {
    const { tab, problems } = await served.open(
      `#scene=-1,${tau},1,1,${colour}&selected=0${alongX}${factor === null ? "" : `&volume=${factor}`}`,
    );
    await expect.poll(() => tab.locator(".scene .state").textContent()).toMatch(/triangles$/);
    if (factor !== null) await expect.poll(() => tab.locator(".volume-bar").textContent()).toContain("every sample");
    let before: number[];
    let now: number[] = [];
    do {
      before = now;
      await tab.waitForTimeout(700); // longer than it takes until a picture is made finer
      now = await middlePixel(tab);
    } while (String(now) !== String(before));
    expect(problems).toEqual([]);
    await tab.close();
    return now;
  }

  it("occludes the medium behind its surface, not in front: contrast of black and white equals the transmittance", async () => {
    const factor = 0.125;
    const { opacityTo, least } = await matterAlongX(factor);
    const before = (radius: number): number => opacityTo(Math.max(0, middle[0]! - radius));
    const [small, large] = [3, (100 - least) / 10];
    expect(before(small)).toBeGreaterThan(0.1); // something is in front of the small ball,
    expect(opacityTo(2 * middle[0]!)).toBeGreaterThan(before(small) + 0.1); // something behind its surface,
    expect(before(large)).toBeLessThan(0.001); // and all of it behind that of the large one
    for (const radius of [small, large]) {
      const tau = 100 - 10 * radius;
      const contrast = async (matter: number | null): Promise<number> => {
        const [white, black] = [await pixelOf(tau, "ffffff", matter), await pixelOf(tau, "000000", matter)];
        expect([white[3], black[3]]).toEqual([255, 255]);
        return white[1]! - black[1]!;
      };
      const bare = await contrast(null);
      expect(bare).toBeGreaterThan(100);
      expect(Math.abs(1 - (await contrast(factor)) / bare - before(radius)), `radius ${radius}`).toBeLessThan(0.03);
    }
  });
});
