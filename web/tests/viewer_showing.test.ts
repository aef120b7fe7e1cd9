// Where slices look, their window of grey values, and what is up, in a browser.
import { existsSync } from "node:fs";
import { join } from "node:path";
import type { Page as Tab } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { canServe, Served, stableBox } from "./viewer_harness";

const data = process.env.ISOATLAS_DATA ?? "nowhere";
const lung = join(data, "lung_ct/lung_lo.nrrd");
const heads = ["RAS", "LPI", "AIL", "SRP"];
const headFile = (code: string): string => join(data, `nifti_orientations/${code}.nii.gz`);

function hashOf(tab: Tab): URLSearchParams {
  return new URLSearchParams(new URL(tab.url()).hash.slice(1));
}
function part(tab: Tab, key: string): () => string | null {
  return () => hashOf(tab).get(key);
}
const numbersOf = (text: string | null): number[] => (text ?? "").split(",").map(Number);
const slicesLoaded = (tab: Tab): Promise<void> =>
  expect.poll(() => tab.locator(".at-crosshair .value").textContent()).toMatch(/\d/);

/** Numbers of the window: level and width. */
async function windowOf(tab: Tab): Promise<number[]> {
  const box = (name: string) => tab.getByRole("spinbutton", { name: `${name} of the window` });
  return [Number(await box("level").inputValue()), Number(await box("width").inputValue())];
}

/** The slices by their plane: grey values of pixels, columns and rows of the same number. */
function pixelsOf(tab: Tab): Promise<Record<string, number[]>> {
  return tab.evaluate(() => {
    const side = 48;
    const figures = [...document.querySelectorAll(".slices figure")].map((figure) => {
      const small = new OffscreenCanvas(side, side);
      const pen = small.getContext("2d") as OffscreenCanvasRenderingContext2D;
      pen.drawImage(figure.querySelector("canvas")!, 0, 0, side, side);
      const grey = [...pen.getImageData(0, 0, side, side).data].filter((_, i) => i % 4 === 0);
      return [figure.querySelector("figcaption")!.textContent!.split(",")[0]!, grey] as const;
    });
    return Object.fromEntries(figures);
  });
}

function lettersOf(tab: Tab): Promise<Record<string, string>> {
  return tab.evaluate(() => {
    const figures = [...document.querySelectorAll(".slices figure")].map((figure) => {
      const letters = ["left", "right", "top", "bottom"].map((side) => figure.querySelector(`.side-letter.${side}`)!.textContent);
      return [figure.querySelector("figcaption")!.textContent!.split(",")[0]!, letters.join("")] as const;
    });
    return Object.fromEntries(figures);
  });
}

describe.skipIf(!canServe || !existsSync(headFile("RAS")))("slices of one head, stored in four ways", () => {
  const served = new Map<string, Served>();
  beforeAll(async () => {
    for (const code of heads) served.set(code, await Served.file(headFile(code)));
  });
  afterAll(async () => {
    for (const one of served.values()) await one.close();
  });

  /** A place of the volume stored as RAS, in another order of axes. */
  function stored(code: string, voxel: readonly number[], size: readonly number[]): number[] {
    return [...code].map((letter) => {
      const axis = ["RL", "AP", "SI"].findIndex((pair) => pair.includes(letter));
      return "RAS".includes(letter) ? voxel[axis]! : size[axis]! - 1 - voxel[axis]!;
    });
  }

  it("are the same pictures with the same letters; arrows go where they point", async () => {
    const [size, voxel] = [[64, 79, 67], [25, 50, 40]];
    let first: Record<string, number[]> = {};
    for (const code of heads) {
      const cross = stored(code, voxel, size);
      const { tab, problems } = await served.get(code)!.open(`#scene=&selected=-1&slices=1&cross=${cross.join()}`);
      await slicesLoaded(tab);
      expect(await lettersOf(tab), code).toEqual({ axial: "RLAP", coronal: "RLSI", sagittal: "APSI" });
      if (code === "RAS") {
        await expect.poll(async () => Object.values(await pixelsOf(tab)).every((grey) => Math.max(...grey) > 100)).toBe(true);
        first = await pixelsOf(tab);
        const mirrored = first.axial!.map((_, i) => first.axial![i - (i % 48) + 47 - (i % 48)]!);
        expect(difference(mirrored, first.axial!)).toBeGreaterThan(5); // the pictures tell left from right
      }
      for (const plane of ["axial", "coronal", "sagittal"]) {
        const from = async (): Promise<number> => difference((await pixelsOf(tab))[plane]!, first[plane]!);
        await expect.poll(from, { message: `${code} ${plane}` }).toBeLessThan(2);
      }
      const axial = tab.locator(".slices figure", { hasText: "axial" }).locator("canvas");
      expect(await axial.getAttribute("aria-label")).toContain("left side is the patient's right, top is anterior");
      await axial.press("ArrowRight"); // to the patient's left
      await expect.poll(part(tab, "cross")).toBe(stored(code, [24, 50, 40], size).join());
      await axial.press("ArrowUp");
      await expect.poll(part(tab, "cross")).toBe(stored(code, [24, 51, 40], size).join());
      const box = await stableBox(axial);
      await axial.click({ position: { x: box.width * 0.35, y: box.height * 0.5 } }); // right of the middle of the patient
      const leftwards = [...code].findIndex((letter) => "RL".includes(letter));
      await expect.poll(() => numbersOf(part(tab, "cross")())[leftwards]! > 32).toBe(code[leftwards] === "R");
      expect(problems).toEqual([]);
      await tab.close();
    }
  });

  it("stand upright in 3D, seen from the front; views are named after the patient", async () => {
    const ups: Record<string, string> = {};
    for (const code of heads) {
      const { tab, problems } = await served.get(code)!.open();
      await expect.poll(part(tab, "view")).not.toBeNull();
      const [x, y, z, a, b, c] = numbersOf(hashOf(tab).get("view")) as [number, number, number, number, number, number];
      expect([x > a, y > b, z > c]).toEqual([true, true, true]); // RAS: right, anterior, superior
      expect(hashOf(tab).has("up")).toBe(false);
      await tab.locator(".menus summary", { hasText: "View" }).click();
      await tab.getByRole("button", { name: "View from left, +X" }).click();
      await expect.poll(() => numbersOf(hashOf(tab).get("view"))[0]! < a).toBe(true);
      await tab.keyboard.press("s");
      ups[code] = /--up=\S+/.exec((await tab.locator(".export code").textContent()) ?? "")?.[0] ?? "usual";
      expect(problems).toEqual([]);
      await tab.close();
    }
    expect(ups).toEqual({ RAS: "usual", LPI: "usual", AIL: "usual", SRP: "usual" });
  });
});

/** Mean of the absolute differences. */
function difference(p: readonly number[], q: readonly number[]): number {
  return p.reduce((sum, n, i) => sum + Math.abs(n - q[i]!), 0) / p.length;
}

describe.skipIf(!canServe || !existsSync(lung))("the window of slices of a CT", () => {
  let served: Served;
  beforeAll(async () => {
    served = await Served.file(lung);
  });
  afterAll(() => served?.close());
  const select = (tab: Tab) => tab.getByRole("combobox", { name: "window", exact: true });

  it("is chosen by keyboard alone, typed, undone, and restored by a link", async () => {
    const { tab, problems } = await served.open();
    await tab.keyboard.press("W");
    await expect.poll(() => tab.locator(".slices").isVisible()).toBe(true);
    expect(await select(tab).evaluate((element) => element === document.activeElement)).toBe(true);
    for (let i = 0; i < 3; ++i) await tab.keyboard.press("ArrowDown");
    await expect.poll(part(tab, "grey")).toBe("-1350,150");
    expect(await select(tab).inputValue()).toBe("Lung");
    expect(await windowOf(tab)).toEqual([-600, 1500]);
    await tab.keyboard.press("Tab");
    await tab.keyboard.press("Control+a");
    await tab.keyboard.type("40");
    await tab.keyboard.press("Tab");
    await tab.keyboard.press("Control+a");
    await tab.keyboard.type("400");
    await tab.keyboard.press("Enter");
    await expect.poll(part(tab, "grey")).toBe("-160,240");
    expect(await select(tab).inputValue()).toBe("Soft tissue");
    const other = await served.open(new URL(tab.url()).hash);
    expect([await select(other.tab).inputValue(), ...(await windowOf(other.tab))]).toEqual(["Soft tissue", 40, 400]);
    await other.tab.close();
    for (const grey of ["-710,790", "-1350,150"]) {
      await tab.keyboard.press("Control+z");
      await expect.poll(part(tab, "grey")).toBe(grey);
    }
    for (let steps = 0; part(tab, "grey")() !== null && steps < 3; ++steps) await tab.keyboard.press("Control+z"); // slow keys are steps
    await expect.poll(part(tab, "grey")).toBeNull();
    expect(problems.concat(other.problems)).toEqual([]);
    await tab.close();
  });

  it("offers the presets of CT by their range of values, and around the isovalue of the selected object", async () => {
    const { tab, problems } = await served.open("#scene=0,200,1,1&selected=0&slices=1");
    const headings = await select(tab).locator("optgroup").evaluateAll((all) => all.map((one) => one.getAttribute("label")));
    expect(headings).toEqual(["CT (HU)"]);
    await select(tab).selectOption("Around the isovalue of the selected object");
    await expect.poll(async () => (await windowOf(tab))[0]).toBe(200);
    await select(tab).selectOption("Full range");
    await expect.poll(part(tab, "grey")).toBe("-1130,1379");
    await select(tab).selectOption("Automatic (0.5 % to 99.5 %)");
    await expect.poll(part(tab, "grey")).toBeNull();
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("follows a drag with the right button, or with Ctrl, in one step, and keys", async () => {
    const { tab, problems } = await served.open("#scene=&selected=-1&slices=1&grey=-160,240&cross=20,20,20");
    await slicesLoaded(tab);
    const box = await stableBox(tab.locator(".slices canvas").nth(2));
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    const drag = async (right: number, down: number, button: "left" | "right" | "middle"): Promise<void> => {
      await tab.mouse.move(x, y);
      await tab.mouse.down({ button });
      await tab.mouse.move(x + right, y + down, { steps: 4 });
      await tab.mouse.up({ button });
    };
    await drag(40, 0, "right");
    await expect.poll(async () => (await windowOf(tab))[1]! > 450).toBe(true);
    expect((await windowOf(tab))[0]).toBe(40);
    await tab.keyboard.press("Control+z");
    await expect.poll(() => windowOf(tab)).toEqual([40, 400]);
    await drag(0, 20, "middle");
    await expect.poll(() => windowOf(tab)).toEqual([80, 400]);
    await tab.keyboard.down("Control");
    await drag(-30, 0, "left");
    await tab.keyboard.up("Control");
    await expect.poll(async () => (await windowOf(tab))[1]! < 380).toBe(true);
    expect(hashOf(tab).get("cross")).toBe("20,20,20"); // the crosshair stays
    await drag(0, 0, "right");
    for (let i = 0; i < 2; ++i) await tab.keyboard.press("Control+z");
    await expect.poll(() => windowOf(tab)).toEqual([40, 400]);
    for (const [key, level, width] of [["=", 40, 440], ["-", 40, 400], ["'", 60, 400], [";", 40, 400]] as const) {
      await tab.keyboard.press(key);
      await expect.poll(() => windowOf(tab)).toEqual([level, width]);
    }
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("has no part beyond the edge of the screen, however small", async () => {
    for (const [width, height] of [[1400, 900], [1000, 700], [800, 600], [390, 844]] as const) {
      const { tab } = await served.open("#scene=&selected=-1&slices=1", { viewport: { width, height } });
      await slicesLoaded(tab);
      const [right, left] = await tab.evaluate(() => {
        const all = document.querySelectorAll(".slices, .slices select, .slices input, .slices figure");
        const boxes = [...all].map((element) => element.getBoundingClientRect());
        const seen = boxes.filter((box) => box.width > 0);
        return [Math.max(...seen.map((box) => box.right)), Math.min(...seen.map((box) => box.left))];
      });
      expect(right, `${width}`).toBeLessThanOrEqual(width);
      expect(left, `${width}`).toBeGreaterThanOrEqual(0);
      const picture = await stableBox(tab.locator(".slices canvas").first());
      expect(picture.height, `${width}`).toBeGreaterThan(100);
      for (const menu of await tab.locator(".menus summary").all()) {
        await menu.click();
        const open = (await tab.locator(".menus details[open] .box").boundingBox())!;
        expect(open.x, `${width}`).toBeGreaterThanOrEqual(0);
        expect(open.x + open.width, `${width}`).toBeLessThanOrEqual(width);
        await tab.keyboard.press("Escape");
      }
      await tab.close();
    }
  });
});

describe.skipIf(!canServe)("what is up", () => {
  let served: Served;
  beforeAll(async () => {
    served = await Served.phantom("demo", "--size", "48");
  });
  afterAll(() => served?.close());

  const ready = (tab: Tab): Promise<void> => expect.poll(part(tab, "view")).not.toBeNull();
  /** From the target to the camera. */
  const offset = (tab: Tab): number[] => {
    const [x, y, z, a, b, c] = numbersOf(hashOf(tab).get("view")) as [number, number, number, number, number, number];
    return [x - a, y - b, z - c];
  };

  it("is chosen in the menu, undone, and restored by a link; slices turn with it", async () => {
    const { tab, problems } = await served.open();
    await ready(tab);
    const before = offset(tab);
    const view = tab.locator(".menus summary", { hasText: "View" });
    await view.click();
    expect(await tab.getByRole("button", { name: "Up direction +Z" }).getAttribute("aria-pressed")).toBe("true");
    await tab.getByRole("button", { name: "Up direction −Z" }).click();
    await expect.poll(part(tab, "up")).toBe("-z");
    await expect.poll(() => offset(tab)).toEqual([-before[0]!, before[1]!, -before[2]!].map((n) => expect.closeTo(n, 2)));
    await tab.keyboard.press("k");
    const top = (): Promise<(string | null)[]> => tab.locator(".side-letter.top").allTextContents();
    await expect.poll(top).toEqual(["−z", "−z", "−y"]);
    const other = await served.open(new URL(tab.url()).hash);
    await expect.poll(() => other.tab.locator(".side-letter.top").allTextContents()).toEqual(["−z", "−z", "−y"]);
    await other.tab.locator(".menus summary", { hasText: "View" }).click();
    expect(await other.tab.getByRole("button", { name: "Up direction −Z" }).getAttribute("aria-pressed")).toBe("true");
    await other.tab.close();
    for (let i = 0; i < 2; ++i) await tab.keyboard.press("Control+z");
    await expect.poll(part(tab, "up")).toBeNull();
    await expect.poll(() => offset(tab)).toEqual(before.map((n) => expect.closeTo(n, 2)));
    expect(problems.concat(other.problems)).toEqual([]);
    await tab.close();
  });

  it("is kept by standard views and orbits, by keyboard alone", async () => {
    const { tab, problems } = await served.open();
    await ready(tab);
    await tab.keyboard.press("u");
    await expect.poll(part(tab, "up")).toBe("-z");
    await tab.keyboard.press("x");
    await expect.poll(() => Math.hypot(offset(tab)[1]!, offset(tab)[2]!)).toBeLessThan(0.1);
    const upright = await picture(tab);
    await tab.keyboard.press("u");
    await tab.keyboard.press("x");
    await expect.poll(part(tab, "up")).toBeNull();
    const usual = await picture(tab);
    expect(difference(upright, [...usual].reverse())).toBeLessThan(0.25 * difference(upright, usual)); // by half around the view
    await tab.keyboard.press("R");
    await expect.poll(part(tab, "up")).toBe("y");
    await tab.keyboard.press("ArrowRight"); // around y
    await expect.poll(() => Math.abs(offset(tab)[2]!)).toBeGreaterThan(1);
    expect(Math.abs(offset(tab)[1]!)).toBeLessThan(0.1);
    for (const key of ["Q", "r", "q"]) await tab.keyboard.press(key);
    await tab.keyboard.press("x");
    await expect.poll(() => Math.abs(offset(tab)[2]!)).toBeLessThan(0.1);
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("turns with the wheel of the mouse and drags: orbits around the chosen axis", async () => {
    const { tab, problems } = await served.open();
    await ready(tab);
    await tab.locator(".menus summary", { hasText: "View" }).click();
    await tab.getByRole("button", { name: "Up direction +Y" }).click();
    await expect.poll(part(tab, "up")).toBe("y");
    const before = offset(tab);
    const box = await stableBox(tab.locator(".viewport > canvas"));
    await tab.mouse.move(box.x + box.width / 2 + 90, box.y + 90);
    await tab.mouse.down();
    await tab.mouse.move(box.x + box.width / 2 + 190, box.y + 90, { steps: 4 });
    await tab.mouse.up();
    await expect.poll(() => Math.abs(offset(tab)[0]! - before[0]!) + Math.abs(offset(tab)[2]! - before[2]!)).toBeGreaterThan(1);
    expect(offset(tab)[1]).toBeCloseTo(before[1]!, 1); // the height above the axis stays
    expect(problems).toEqual([]);
    await tab.close();
  });
});

/** What is drawn in 3D: opacities. */
async function picture(tab: Tab): Promise<number[]> {
  const read = (): Promise<number[]> =>
    tab.evaluate(() => {
      const side = 40;
      const canvas = document.querySelector<HTMLCanvasElement>(".viewport > canvas")!;
      const small = new OffscreenCanvas(side, side);
      const pen = small.getContext("2d") as OffscreenCanvasRenderingContext2D;
      const { width, height } = canvas;
      const edge = Math.min(width, height);
      pen.drawImage(canvas, (width - edge) / 2, (height - edge) / 2, edge, edge, 0, 0, side, side);
      return [...pen.getImageData(0, 0, side, side).data].filter((_, i) => i % 4 === 3);
    });
  let last = await read();
  for (;;) {
    await tab.waitForTimeout(300);
    const next = await read();
    if (difference(last, next) === 0) return next;
    last = next;
  }
}
