// The scene, isovalues and exports, in a browser; numbers are compared with the command line.
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import type { Page as Tab } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { canServe, meshes, pictureOf, Served, stableBox } from "./viewer_harness";

interface Listed {
  id: number;
  best_tau: number;
  cavities: number;
}

describe.skipIf(!canServe)("the scene", () => {
  let served: Served;
  let listed: Listed[] = [];

  beforeAll(async () => {
    served = await Served.phantom("demo", "--size", "128");
    listed = (JSON.parse(served.isoatlas("objects", served.store, "--json")) as { objects: Listed[] }).objects;
  });
  afterAll(() => served?.close());

  const shownAs = (tab: Tab, name: string) =>
    tab.locator(".scene li").filter({ has: tab.getByRole("button", { name: new RegExp(`^Select ${name} `) }) });
  const settled = (tab: Tab): Promise<void> =>
    expect
      .poll(
        () =>
          tab
            .locator(".scene .state")
            .allTextContents()
            .then((notes) => notes.every((note) => /triangles$|hidden$|cavities$/.test(note))),
      )
      .toBe(true);
  const save = async (tab: Tab, run: () => Promise<void>, name: string): Promise<string> => {
    const [download] = await Promise.all([tab.waitForEvent("download"), run()]);
    const file = join(served.folder, name);
    await download.saveAs(file);
    return file;
  };
  /** entries and isovalues, such as "0,14.6,1,1;1,25,1,1" */
  const scene = (n: number, more = ""): string =>
    `#scene=${listed
      .slice(0, n)
      .map(({ best_tau }, i) => `${i},${best_tau},1,1`)
      .join(";")}&selected=0${more}`;

  it("fits the view once for several objects that load one after the other, and not again for full surfaces", async () => {
    const tab = await served.browser.newPage({ viewport: { width: 1000, height: 700 } });
    await tab.addInitScript(() => localStorage.setItem("isoatlas-tour", "seen"));
    const held: (() => Promise<void>)[] = [];
    await tab.route("**/api/surface*", (route) => void held.push(() => route.continue()));
    await tab.goto((await served.address()) + scene(3));
    await expect.poll(() => held.length).toBe(3);
    await tab.waitForTimeout(500);
    await tab.evaluate(() => {
      const bar = document.querySelector<HTMLElement>(".scale .bar")!; // as long as the eye is far away
      const seen = ((window as unknown as { seen: string[] }).seen = [bar.style.width]);
      const look = (): void => void (bar.style.width !== seen.at(-1) && seen.push(bar.style.width));
      new MutationObserver(look).observe(bar, { attributes: true });
    });
    for (let i = 0; i < held.length; ++i) {
      await held[i]!();
      await tab.waitForTimeout(400);
    }
    await settled(tab);
    expect(held.length).toBeGreaterThan(3); // finer ones came too
    expect(new URL(tab.url()).hash).toContain("&view=");
    const seen = (): Promise<number> => tab.evaluate(() => (window as unknown as { seen: string[] }).seen.length);
    await expect.poll(seen).toBe(2); // a busy machine draws later
    await tab.close();
  });

  it("compiles no shader during steps, and requests the estimate first, once", async () => {
    const tab = await served.browser.newPage({ viewport: { width: 1000, height: 700 } });
    await tab.addInitScript(() => {
      localStorage.setItem("isoatlas-tour", "seen");
      const { linkProgram } = WebGL2RenderingContext.prototype;
      const counted = window as unknown as { linked: number };
      counted.linked = 0;
      WebGL2RenderingContext.prototype.linkProgram = function (program) {
        ++counted.linked;
        linkProgram.call(this, program);
      };
    });
    await tab.goto((await served.address()) + scene(2));
    await settled(tab);
    const linked = (): Promise<number> => tab.evaluate(() => (window as unknown as { linked: number }).linked);
    let before = 0; // once all that is drawn at first has been, however slow the machine is
    const isStill = async (): Promise<boolean> => {
      const last = before;
      before = await linked();
      return before > 0 && before === last;
    };
    await expect.poll(isStill, { interval: 500 }).toBe(true);
    for (let i = 0; i < 4; ++i) {
      const asked: string[] = [];
      const hear = (request: { url(): string }): void => {
        const { pathname } = new URL(request.url());
        if (pathname !== "/api/card" && pathname !== "/api/measures") asked.push(pathname); // those come when they come
      };
      tab.on("request", hear);
      await tab.keyboard.press(i % 2 === 0 ? "]" : "[");
      await settled(tab);
      await expect.poll(() => asked.length).toBeGreaterThan(1);
      tab.off("request", hear);
      expect(asked[0]).toBe("/api/preview");
      expect(asked.filter((path) => path === "/api/preview" || path === "/api/objects").length).toBe(1);
    }
    expect(await linked()).toBe(before);
    await tab.close();
  });

  it("hides, paints and fades without reloading, and undoes each by its name", async () => {
    const { tab, problems } = await served.open(scene(2));
    await settled(tab);
    const seen = meshes(tab);
    const row = shownAs(tab, "Object 1");
    await row.getByRole("button", { name: "show object 1" }).click();
    expect(await row.getByRole("button", { name: "show object 1" }).getAttribute("aria-pressed")).toBe("false");
    expect(await row.locator(".state").textContent()).toContain("hidden");
    await row.getByRole("button", { name: "show object 1" }).click();
    await row.getByRole("button", { name: "vermilion" }).click();
    await row.getByRole("slider", { name: "opacity" }).fill("0.5");
    await expect.poll(() => new URL(tab.url()).hash).toContain(",0.5,1,d55e00;");
    for (const step of ["opacity", "colour", "show or hide", "show or hide"])
      await tab.getByRole("button", { name: `Undo: ${step}`, exact: true }).click();
    await expect.poll(() => new URL(tab.url()).hash).toContain(`#scene=0,${listed[0]?.best_tau},1,1;`);
    expect(await tab.getByRole("button", { name: "Redo: show or hide" }).isEnabled()).toBe(true);
    expect(seen).toEqual([]);
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("lets clicks pass through ghosts", async () => {
    const { tab } = await served.open(scene(3).replace("selected=0", "selected=1"));
    await settled(tab);
    const canvas = tab.locator(".viewport canvas").first();
    const { width, height } = await stableBox(canvas);
    const selected = () => tab.locator('.scene [aria-current="true"]').locator("b").textContent();
    await tab.keyboard.press("g");
    expect(await tab.getByRole("button", { name: "Ghost others" }).getAttribute("aria-pressed")).toBe("true");
    for (let k = 1; k < 8; ++k) await canvas.click({ position: { x: (width * k) / 8, y: height / 2 } });
    expect(await selected()).toBe("Object 2");
    await tab.keyboard.press("g");
    for (let k = 1; k < 8 && (await selected()) === "Object 2"; ++k)
      await canvas.click({ position: { x: (width * k) / 8, y: height / 2 } });
    expect(await selected()).not.toBe("Object 2");
    await tab.close();
  });

  it("draws surfaces as points, as many as the command line, and back", async () => {
    const { id, best_tau } = listed[0] as Listed;
    const { tab } = await served.open(scene(1));
    await settled(tab);
    const note = () => shownAs(tab, "Object 1").locator(".state").textContent();
    const before = await note();
    await tab.keyboard.press("D");
    await expect.poll(note).toMatch(/points$/);
    expect(new URL(tab.url()).hash).toContain("points=1");
    const words = ["--object", `v${id}@${best_tau}`, "--points", "2", "-o", join(served.folder, "p.png"), "--json"];
    const drawn = JSON.parse(served.isoatlas("render", served.store, ...words)) as { objects: { points: number }[] };
    expect(await note()).toContain(`${drawn.objects[0]?.points.toLocaleString("en-US")} points`);
    await tab.reload();
    await expect.poll(note).toMatch(/points$/);
    await tab.keyboard.press("Control+z");
    await tab.keyboard.press("D");
    await expect.poll(note).toBe(before);
    await tab.close();
  });

  it("shows only the walls of cavities, as many triangles as the command line", async () => {
    const at = listed.findIndex(({ cavities }) => cavities > 0);
    const { id, best_tau } = listed[at] as Listed;
    const { tab } = await served.open(`#scene=${at},${best_tau},1,1&selected=0`);
    await settled(tab);
    const seen = meshes(tab);
    await tab.getByRole("button", { name: "Cavities only" }).click();
    await expect.poll(() => seen.filter(({ coarse }) => !coarse).length).toBe(1);
    const extracted = JSON.parse(
      served.isoatlas(
        "extract",
        served.store,
        "--object",
        `v${id}`,
        "--tau",
        String(best_tau),
        "--shell",
        "inner",
        "-o",
        "x.ply",
        "--json",
      ),
    ) as { triangles: number };
    expect(seen.at(-1)?.triangles).toBe(extracted.triangles);
    await expect.poll(() => tab.locator(".scene .state").textContent()).toContain(`${listed[at]?.cavities} cavit`);
    await tab.close();
  });

  it("draws points while a surface has too many triangles", async () => {
    const { tab } = await served.open(scene(1));
    await settled(tab);
    const drawn = async (): Promise<number> => (await pictureOf(tab)).data.filter((value, i) => i % 4 === 3 && value > 128).length;
    await expect.poll(drawn).toBeGreaterThan(0); // the frame after the words
    await tab.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
    const whole = await drawn();
    await tab.route("**/api/surface*", (route) => route.continue({ url: route.request().url().replace(/max=\d+/, "max=2000") }));
    const slider = tab.getByRole("slider", { name: "isovalue, on the histogram" });
    await slider.evaluate((input: HTMLInputElement) => {
      input.value = String(Number(input.value) + 0.01);
      input.dispatchEvent(new Event("input"));
    });
    await expect.poll(() => tab.locator(".scene .state").textContent()).toContain("4,000 points of it");
    await expect.poll(async () => Math.abs((await drawn()) / whole - 1)).toBeLessThan(0.2);
    await tab.unroute("**/api/surface*");
    await slider.dispatchEvent("change");
    await settled(tab);
    await tab.close();
  });

  it("loads coarse surfaces during a drag, a full one at its end, and updates the isovalue immediately", async () => {
    const { tab } = await served.open(scene(1));
    await settled(tab);
    const asked: number[] = [];
    const coarse: boolean[] = [];
    tab.on(
      "request",
      (request) => request.url().includes("/api/surface") && asked.push(Number(new URL(request.url()).searchParams.get("max"))),
    );
    tab.on("response", (response) => response.url().includes("/api/surface") && coarse.push(response.headers()["x-coarse"] === "1"));
    const slider = tab.getByRole("slider", { name: "isovalue, on the histogram" });
    const numbers = await slider.evaluate((input: HTMLInputElement) => {
      const box = document.querySelector<HTMLInputElement>('.axis input[aria-label="isovalue"]') as HTMLInputElement;
      const from = Number(input.value);
      return Array.from({ length: 40 }, (_, i) => {
        input.value = String(from + 5 * (i + 1));
        input.dispatchEvent(new Event("input"));
        return Number(box.value);
      });
    });
    expect(new Set(numbers).size).toBe(40); // the number follows at once
    await expect.poll(() => asked.length).toBe(2); // the first one and the last one
    expect(asked.every((most) => most <= 40_000)).toBe(true);
    await slider.dispatchEvent("change");
    await settled(tab);
    expect(coarse.filter((isCoarse) => !isCoarse)).toEqual([false]); // the last one of the drag, if it was quick, or one more
    expect(coarse.at(-1)).toBe(false);
    await expect.poll(() => tab.locator(".badge").textContent()).toContain("triangles");
    await tab.getByRole("button", { name: "Undo: isovalue" }).click();
    await expect.poll(() => new URL(tab.url()).hash).toContain(`#scene=0,${listed[0]?.best_tau},`);
    await tab.close();
  });

  for (const [colorScheme, mark] of [["light", [0, 114, 178]], ["dark", [86, 180, 233]]] as const)
    it(`draws the line of the isovalue where the histogram is clicked, ${colorScheme}`, async () => {
      const { tab, problems } = await served.open(scene(1), { colorScheme });
      await settled(tab);
      const box = await stableBox(tab.locator(".drawn"));
      const colourAt = (left: number): Promise<number[]> =>
        tab.locator(".drawn canvas").evaluate((canvas: HTMLCanvasElement, at) => {
          const near = canvas.getContext("2d")?.getImageData(Math.round(at * devicePixelRatio), 6 * devicePixelRatio, 1, 1).data ?? [];
          return [...near].slice(0, 3);
        }, left);
      for (const share of [0.05, 0.4, 0.95]) {
        const left = Math.round(share * box.width);
        await tab.mouse.click(box.x + left, box.y + 20);
        const away = (colour: number[]): number => Math.max(...mark.map((n, i) => Math.abs(n - (colour[i] ?? 0))));
        await expect.poll(async () => away(await colourAt(left))).toBeLessThan(16);
      }
      expect(problems).toEqual([]);
      await tab.close();
    });

  it("steps by a given step, and plays to the end of the range", async () => {
    const { tab, problems } = await served.open(scene(1));
    await settled(tab);
    const box = tab.getByRole("textbox", { name: "isovalue" });
    await tab.getByRole("textbox", { name: "step" }).fill("2.5");
    await tab.getByRole("textbox", { name: "step" }).press("Enter");
    await tab.locator(".axis .badge").click();
    const before = Number(await box.inputValue());
    await tab.keyboard.press("]");
    expect(Number(await box.inputValue())).toBeCloseTo(before + 2.5, 3);
    expect(new URL(tab.url()).hash).toContain("&step=2.5");
    const top = Number(((await tab.locator(".object dd").allTextContents()).join(" ").match(/from (\S+) downwards/) ?? [])[1] ?? NaN);
    await tab.getByRole("combobox", { name: "speed" }).selectOption("20");
    await box.fill(String(top - 9));
    await box.press("Enter");
    await settled(tab);
    const asked: string[] = [];
    tab.on(
      "request",
      (request) => request.url().includes("/api/surface") && asked.push(new URL(request.url()).searchParams.get("tau") ?? ""),
    );
    await tab.getByRole("button", { name: "play upwards" }).click();
    await expect.poll(() => tab.getByRole("button", { name: "play upwards" }).isVisible()).toBe(true);
    await expect.poll(() => box.inputValue()).toBe(String(Number((top - 9 + 7.5).toPrecision(7))));
    expect(new Set(asked).size).toBe(3);
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("shows the next event", async () => {
    const { tab } = await served.open(scene(1));
    await settled(tab);
    await tab.keyboard.press("}");
    await expect.poll(() => tab.locator(".message").textContent()).toMatch(/(Object|Cavity) \d+ (appears|merges|opens).* at /);
    await tab.close();
  });

  it("is saved and loaded; invalid files are rejected with a reason", async () => {
    const { tab } = await served.open(scene(2, "&ghosts=1"));
    await settled(tab);
    const hash = new URL(tab.url()).hash;
    await tab.keyboard.press("s");
    const file = await save(tab, () => tab.getByRole("button", { name: "Save the scene" }).click(), "scene.json");
    await tab.keyboard.press("Escape");
    await tab.keyboard.press("Delete");
    await tab.keyboard.press("s");
    writeFileSync(join(served.folder, "bad.json"), readFileSync(file, "utf8").replace("isoatlas/scene/1", "isoatlas/scene/9"));
    await tab.getByLabel("scene file to load").setInputFiles(join(served.folder, "bad.json"));
    await expect.poll(() => tab.getByRole("alert").textContent()).toContain('this viewer reads "isoatlas/scene/1"');
    await tab.getByLabel("scene file to load").setInputFiles(file);
    await expect.poll(() => new URL(tab.url()).hash).toBe(hash);
    await tab.close();
  });

  it("shows measures of an object, and saves its labels", async () => {
    const { id, best_tau } = listed[0] as Listed;
    const { tab } = await served.open(scene(1));
    await settled(tab);
    const { objects } = JSON.parse(served.isoatlas("objects", served.store, "--tau", String(best_tau), "--json")) as {
      objects: { id: number; voxels: number; b1: number }[];
    };
    const there = objects.find((object) => object.id === id);
    await expect.poll(() => tab.locator(".here").textContent()).toMatch(/area[\d.]+ .*²/);
    await tab.keyboard.press("s");
    const file = await save(tab, () => tab.getByRole("button", { name: "Save the labels" }).click(), "labels.nrrd");
    const labels = JSON.parse(served.isoatlas("objects", file, "--tau", "0.5", "--json")) as { objects: { voxels: number }[] };
    expect(labels.objects.reduce((sum, { voxels }) => sum + voxels, 0)).toBe(there?.voxels);
    await tab.close();
  });

  it("saves a table with a line for each object", async () => {
    const { tab } = await served.open(scene(1));
    await tab.keyboard.press("s");
    const file = await save(tab, () => tab.getByRole("button", { name: "Save the table of objects" }).click(), "objects.csv");
    const objects = readFileSync(file, "utf8")
      .split("\r\n")
      .map((line) => line.split(","))
      .filter((cells) => cells[3] === "object");
    expect(objects.map((cells) => cells[2])).toEqual(listed.map(({ id }) => `v${id}`));
    await tab.close();
  });

  it("saves an image of the requested size, and an animation with different frames", async () => {
    const { tab, problems } = await served.open(scene(2));
    await settled(tab);
    await tab.keyboard.press("s");
    await tab.getByRole("spinbutton", { name: "width" }).fill("320");
    await tab.getByRole("spinbutton", { name: "height" }).fill("200");
    const picture = readFileSync(await save(tab, () => tab.getByRole("button", { name: "Save the image" }).click(), "p.png"));
    expect([picture.readUInt32BE(16), picture.readUInt32BE(20)]).toEqual([320, 200]);
    for (const what of ["turn", "tau"]) {
      await tab.getByRole("combobox", { name: "motion" }).selectOption(what);
      await tab.getByRole("spinbutton", { name: "frames", exact: true }).fill("5");
      const bytes = readFileSync(await save(tab, () => tab.getByRole("button", { name: "Save the animation" }).click(), "a.png"));
      const frames = await tab.evaluate(async (base64) => {
        const decoder = new ImageDecoder({ data: Uint8Array.from(atob(base64), (c) => c.charCodeAt(0)), type: "image/png" });
        await decoder.tracks.ready;
        const sums: number[] = [];
        for (let i = 0; i < (decoder.tracks.selectedTrack?.frameCount ?? 0); ++i) {
          const { image } = await decoder.decode({ frameIndex: i });
          const canvas = new OffscreenCanvas(image.displayWidth, image.displayHeight);
          const pen = canvas.getContext("2d") as OffscreenCanvasRenderingContext2D;
          pen.drawImage(image, 0, 0);
          sums.push(pen.getImageData(0, 0, canvas.width, canvas.height).data.reduce((sum, byte, k) => (sum + byte * (k % 1009)) % 1e9, 0));
        }
        return sums;
      }, bytes.toString("base64"));
      expect(new Set(frames).size, what).toBe(5);
    }
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("has a command line that draws the same view", async () => {
    for (const flat of [false, true]) {
      const { tab } = await served.open(scene(3).replace(/,1,1;/, ",0.4,1,d55e00;"), { viewport: { width: 1100, height: 640 } });
      await settled(tab);
      for (const key of ["ArrowLeft", "ArrowUp", "ArrowLeft", ...(flat ? ["u", "R", "q"] : ["r"])]) await tab.keyboard.press(key);
      if (flat) for (const key of ["o", "c"]) await tab.keyboard.press(key); // without perspective, and cut open
      await tab.keyboard.press("s");
      const command = (await tab.locator(".export code").textContent()) ?? "";
      expect([command.includes("--perspective"), command.includes("--cut="), command.includes("--up=")]).toEqual([!flat, flat, true]);
      const words = [...command.matchAll(/--\S+?='[^']*'|'[^']*'|\S+/g)].map(([word]) => word.replaceAll("'", ""));
      served.isoatlas(...words.slice(1), "--background", "transparent", "--quiet");
      await tab.getByRole("spinbutton", { name: "width" }).fill(String(words[words.indexOf("--size") + 1]?.split("x")[0]));
      await tab.getByRole("spinbutton", { name: "height" }).fill(String(words[words.indexOf("--size") + 1]?.split("x")[1]));
      for (const name of ["scale bar", "legend"]) await tab.getByRole("checkbox", { name }).uncheck();
      await tab.getByRole("combobox", { name: "background" }).selectOption("transparent");
      const here = await save(tab, () => tab.getByRole("button", { name: "Save the image" }).click(), "here.png");
      const pictures = [here, join(served.folder, "scene.png")].map((file) => readFileSync(file).toString("base64"));
      const { both, either } = await tab.evaluate(overlap, pictures);
      expect(either).toBeGreaterThan(10_000);
      expect(both / either).toBeGreaterThan(0.95);
      await tab.close();
    }
  });
});

/** Number of pixels that are opaque in both images, and in at least one. */
async function overlap(pictures: string[]): Promise<{ both: number; either: number }> {
  const alphas = await Promise.all(
    pictures.map(async (base64) => {
      const image = await createImageBitmap(new Blob([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], { type: "image/png" }));
      const canvas = new OffscreenCanvas(image.width, image.height);
      const pen = canvas.getContext("2d") as OffscreenCanvasRenderingContext2D;
      pen.drawImage(image, 0, 0);
      return pen.getImageData(0, 0, image.width, image.height).data.filter((_, i) => i % 4 === 3);
    }),
  );
  const [p, q] = alphas as [Uint8ClampedArray, Uint8ClampedArray];
  if (p.length !== q.length) throw new Error("the pictures have different sizes");
  let [both, either] = [0, 0];
  p.forEach((alpha, i) => {
    const [a, b] = [alpha > 40, (q[i] ?? 0) > 40];
    both += Number(a && b);
    either += Number(a || b);
  });
  return { both, either };
}
