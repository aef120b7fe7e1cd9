// Slices, crosshair, locating objects, clipping and camera, in a browser with `isoatlas view`.
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { Api } from "../src/viewer/api/api";
import { acrossAndDown, AXES, Grid, type AxisNumber } from "../src/viewer/state/grid";
import type { Ruler } from "../src/viewer/state/ruler";
import { SlicedMesh } from "../src/viewer/scene/plane_cut";
import { decodeSlice } from "../src/viewer/api/wire_samples";
import { canServe, Served, stableBox } from "./viewer_harness";
import type { Page as Tab } from "playwright-core";

function hashOf(tab: Tab): URLSearchParams {
  return new URLSearchParams(new URL(tab.url()).hash.slice(1));
}

describe.skipIf(!canServe)("slices", () => {
  let served: Served;
  let api: Api;
  beforeAll(async () => {
    served = await Served.phantom("demo", "--size", "48");
    api = new Api(served.token, served.origin);
  });
  afterAll(() => served?.close());

  /** Largest distance of the contour from the crossings of tau between neighbouring samples of the slice. */
  async function farthest(axis: AxisNumber, index: number, tau: number): Promise<{ crossings: number; distance: number }> {
    const page = await api.page();
    const mesh = await api.surface("all", tau, null, 10_000_000);
    const grid = new Grid(page);
    const [wide, high] = acrossAndDown(axis).map((other) => grid.rulers[other]) as [Ruler, Ruler];
    const pieces = new SlicedMesh(mesh, grid).cut(axis, index).map((length, i) => (i % 2 === 0 ? wide : high).sample(length));
    const slice = decodeSlice(await (await api.request(`/api/slice?axis=${axis}&index=${index}`, "slice")).arrayBuffer(), axis, index);
    const { columns, rows, samples } = slice;
    const near = (u: number, v: number): number => {
      let best = Infinity;
      for (let i = 0; i < pieces.length; i += 4) {
        const [a, b, c, d] = [pieces[i]!, pieces[i + 1]!, pieces[i + 2]!, pieces[i + 3]!];
        const [x, y] = [c - a, d - b];
        const t = Math.min(Math.max(((u - a) * x + (v - b) * y) / (x * x + y * y || 1), 0), 1);
        best = Math.min(best, Math.hypot(u - a - t * x, v - b - t * y));
      }
      return best;
    };
    let [crossings, distance] = [0, 0];
    for (let v = 0; v < rows; ++v)
      for (let u = 0; u < columns; ++u)
        for (const [x, y] of [[1, 0], [0, 1]] as const) {
          if (u + x >= columns || v + y >= rows) continue;
          const [p, q] = [samples[u + columns * v]!, samples[u + x + columns * (v + y)]!];
          if (p >= tau === q >= tau) continue;
          const t = (tau - p) / (q - p);
          ++crossings;
          distance = Math.max(distance, near(u + t * x, v + t * y));
        }
    return { crossings, distance };
  }

  it("show contours at the crossings between samples", async () => {
    const { size } = new Grid(await api.page());
    for (const axis of AXES) {
      const { crossings, distance } = await farthest(axis, Math.floor(size[axis] / 2), 120.5);
      expect(crossings).toBeGreaterThan(20);
      expect(distance).toBeLessThan(1 / 32); // two steps of positions on the wire
    }
  });

  it("share a crosshair, moved by keys, clicks and the wheel, with undo", async () => {
    const { tab, problems } = await served.open();
    await tab.locator(".objects h1").click();
    await tab.keyboard.press("k");
    const captions = (): Promise<string[]> => tab.locator(".slices figcaption").allTextContents();
    const page = await api.page();
    const middle = page.volume.size.map((n) => Math.floor(n / 2));
    await expect.poll(captions).toEqual(AXES.map((axis) => `${"xyz"[axis]} ${middle[axis]} of ${page.volume.size[axis]}`));
    await expect.poll(() => tab.locator(".at-crosshair .value").textContent()).toMatch(/\d/);
    const slice = tab.locator(".slices canvas");
    await slice.nth(2).focus();
    for (const key of ["ArrowRight", "ArrowUp", "PageDown"]) await tab.keyboard.press(key);
    const moved = [middle[0]! + 1, middle[1]! - 1, middle[2]! - 1];
    await expect.poll(() => hashOf(tab).get("cross")).toBe(moved.join());
    await expect.poll(captions).toEqual(AXES.map((axis) => `${"xyz"[axis]} ${moved[axis]} of ${page.volume.size[axis]}`));
    const [across] = acrossAndDown(2);
    const said = await tab.locator(".at-crosshair").textContent();
    const answer = (await (await api.request(`/api/at?voxel=${moved.join()}`, "at")).json()) as { value: number };
    expect(said).toContain(`sample ${moved.join(", ")}`);
    await expect.poll(async () => Number(await tab.locator(".at-crosshair .value").textContent())).toBeCloseTo(answer.value, 1);
    await tab.locator(".objects h1").click();
    await tab.keyboard.press(["5", "7", "9"][across]!);
    await expect.poll(() => hashOf(tab).get("cross")).toBe([moved[0]! - 1, moved[1], moved[2]].join());
    await tab.keyboard.press("Control+z");
    await expect.poll(() => hashOf(tab).get("cross")).toBe(moved.join());
    const box = await stableBox(slice.nth(0));
    await tab.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await tab.mouse.wheel(0, 100);
    await expect.poll(() => hashOf(tab).get("cross")).toBe([moved[0]! - 1, moved[1], moved[2]].join());
    await tab.mouse.click(box.x + box.width / 2 + 20, box.y + box.height / 2);
    await expect.poll(() => Number(hashOf(tab).get("cross")?.split(",")[1])).toBeGreaterThan(moved[1]!);
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("locate objects that contain a sample: the innermost, visible or not", async () => {
    const page = await api.page();
    const { size } = new Grid(page);
    const inner = page.entries.findIndex(({ inside }, i) => inside >= 0 && page.branches[page.entries[i]!.branch]?.side === "object");
    const { id, inside } = page.entries[inner]!;
    const voxel = [id % size[0], Math.floor(id / size[0]) % size[1], Math.floor(id / size[0] / size[1])];
    const { tab, problems } = await served.open(
      `#scene=${inside},${page.entries[inside]!.tau},1,1&selected=-1&slices=1&cross=${voxel.join()}`,
    );
    await expect.poll(() => tab.locator(".slices .chip").count()).toBeGreaterThan(0);
    await tab.locator(".objects h1").click();
    await tab.keyboard.press("a");
    await expect.poll(() => tab.locator(".object h2").textContent()).toBe(`Object ${inside + 1}`);
    await tab.locator(".slices .chip", { hasText: `Object ${inner + 1}` }).click();
    await expect.poll(() => tab.locator(".object h2").textContent()).toBe(`Object ${inner + 1}`);
    expect(hashOf(tab).get("scene")?.split(";").length).toBe(2);
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("keep their size when the text below changes", async () => {
    const { tab, problems } = await served.open();
    await tab.locator(".objects h1").click();
    await tab.keyboard.press("k");
    await expect.poll(() => tab.locator(".slices .located").textContent()).not.toBe("");
    const heights = await tab.evaluate(() => {
      const slice = document.querySelector(".slices canvas")!;
      const height = (): number => slice.getBoundingClientRect().height;
      const [held, said] = [document.querySelector(".slices .located")!, document.querySelector(".slices .at-crosshair")!];
      const before = height();
      held.replaceChildren();
      said.replaceChildren();
      const empty = height();
      for (const of of [held, said]) of.textContent = "a long name ".repeat(40);
      return [before, empty, height()];
    });
    expect(new Set(heights).size).toBe(1);
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("are shown in 3D with a grey range, and restored by a link", async () => {
    const { tab, problems } = await served.open();
    await tab.locator(".objects h1").click();
    for (const key of ["k", "K", "b", "o"]) await tab.keyboard.press(key);
    await tab.getByRole("slider", { name: "white value" }).fill("500");
    await expect.poll(() => hashOf(tab).has("grey")).toBe(true);
    const { hash } = new URL(tab.url());
    const other = await served.open(hash);
    await expect.poll(() => other.tab.locator(".slices").isVisible()).toBe(true);
    expect(await other.tab.getByRole("slider", { name: "white value" }).inputValue()).toBe("500");
    expect(["slices", "planes", "edges", "flat"].map((key) => hashOf(other.tab).get(key))).toEqual(["1", "1", "1", "1"]);
    for (let i = 0; i < 3; ++i) await other.tab.keyboard.press("K");
    expect(problems.concat(other.problems)).toEqual([]);
    await tab.close();
    await other.tab.close();
  });

  it("allow clipping by slider, key and handle", async () => {
    const { tab, problems } = await served.open();
    await tab.locator(".objects h1").click();
    await tab.waitForTimeout(500);
    await tab.keyboard.press("Y");
    await tab.keyboard.press("c");
    const cut = (): number[] => (hashOf(tab).get("cut") ?? "").split(",").map(Number);
    await expect.poll(() => cut().length).toBe(4);
    await tab.getByRole("button", { name: "clip along x" }).click();
    await expect.poll(cut).toEqual([1, 0, 0, 0.5]);
    await tab.keyboard.press(">");
    await expect.poll(cut).toEqual([1, 0, 0, 0.48]);
    await tab.keyboard.press("Control+z");
    await expect.poll(cut).toEqual([1, 0, 0, 0.5]);
    await tab.keyboard.press("f");
    const box = await stableBox(tab.locator(".viewport > canvas"));
    const middle = [box.x + box.width / 2, box.y + box.height / 2] as const;
    await tab.waitForTimeout(300);
    await tab.mouse.move(...middle);
    await tab.mouse.down();
    await tab.mouse.move(middle[0] + 30, middle[1], { steps: 3 });
    await tab.mouse.up();
    await expect.poll(() => Math.abs((cut()[3] ?? 0.5) - 0.5)).toBeGreaterThan(0.02);
    await tab.waitForTimeout(800);
    const share = cut()[3]!;
    await tab.getByRole("button", { name: "flip the clipping plane" }).click();
    await expect.poll(cut).toEqual([-1, 0, 0, expect.closeTo(1 - share, 5)]);
    await tab.getByRole("button", { name: "remove the clipping plane" }).click();
    await expect.poll(() => hashOf(tab).has("cut")).toBe(false);
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("allow views by the orientation cube, and slow rotation until any input", async () => {
    const { tab, problems } = await served.open();
    await tab.waitForTimeout(500);
    await tab.getByRole("button", { name: "view from the far end of z" }).click();
    const view = (): number[] => (hashOf(tab).get("view") ?? "").split(",").map(Number);
    await expect.poll(() => Math.abs(view()[0]! - view()[3]!) + Math.abs(view()[1]! - view()[4]!)).toBeLessThan(1);
    const before = view();
    await tab.keyboard.press("T");
    await tab.waitForTimeout(600);
    await tab.keyboard.press("Escape");
    await expect.poll(view).not.toEqual(before);
    const after = view();
    await tab.waitForTimeout(300);
    expect(view()).toEqual(after);
    const calm = await served.open("", { reducedMotion: "reduce" });
    await calm.tab.waitForTimeout(800);
    await calm.tab.keyboard.press("T");
    await expect.poll(() => calm.tab.locator(".message").textContent()).toContain("less motion");
    expect(problems).toEqual([]);
    await tab.close();
    await calm.tab.close();
  });

  it("need no more GPU memory after many steps", async () => {
    const { tab, problems } = await served.open(
      "#scene=0,120,1,1;1,130,0.5,1&selected=0&slices=1&planes=1&cut=1,0,0,0.5&edges=1&measure=0,0,0,9,9,9",
    );
    const held = (): Promise<string | undefined> =>
      tab.evaluate(() => document.querySelector<HTMLCanvasElement>(".viewport > canvas")?.dataset.gpuMemory);
    const steps = async (count: number): Promise<void> => {
      for (let i = 0; i < count; ++i) await tab.keyboard.press(["]", "6", "K", "[", "8", "<", "K", "0", "ArrowLeft", ">"][i % 10]!);
      await expect.poll(() => tab.locator(".at-crosshair .value").textContent()).toMatch(/\d/); // the slices are there
      for (let last: string | undefined = ""; last !== (last = await held()); ) await tab.waitForTimeout(1000);
    };
    await tab.locator(".objects h1").click();
    await steps(20);
    const before = await held();
    await steps(40);
    expect(await held()).toBe(before);
    expect(problems).toEqual([]);
    await tab.close();
  });
});
