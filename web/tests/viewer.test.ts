// What a newcomer does, in a browser, on a store that `isoatlas view` serves. Skipped where there is no Chromium or no isoatlas.
import { execFileSync, spawn, type ChildProcess } from "node:child_process";
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { chromium, type Browser, type Page as Tab } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";

const browserFile = ["/usr/bin/chromium", "/usr/bin/chromium-browser"].find((file) => existsSync(file));
const cli = process.env.ISOATLAS_CLI ?? "";

interface Listed {
  id: number;
  best_tau: number;
}

describe.skipIf(!browserFile || !existsSync(cli))("the viewer", () => {
  let browser: Browser;
  let server: ChildProcess;
  let address = "";
  let folder = "";
  const isoatlas = (...words: string[]): string => execFileSync(cli, words, { cwd: folder, encoding: "utf8" });

  beforeAll(async () => {
    folder = mkdtempSync(join(tmpdir(), "isoatlas-viewer-"));
    isoatlas("phantom", "demo", "-o", "demo.nrrd");
    server = spawn(cli, ["view", "demo.nrrd", "--no-browser", "--quiet"], { cwd: folder });
    address = await new Promise((resolve) => server.stdout?.once("data", (bytes: Buffer) => resolve(String(bytes).trim())));
    browser = await chromium.launch({ executablePath: browserFile, args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"] });
  }, 60_000);
  afterAll(async () => {
    await browser?.close();
    server?.kill("SIGINT");
    rmSync(folder, { recursive: true });
  });

  async function open(hash = ""): Promise<{ tab: Tab; problems: string[] }> {
    const tab = await browser.newPage({ viewport: { width: 1000, height: 700 } });
    const problems: string[] = [];
    tab.on("pageerror", (error) => problems.push(error.message));
    tab.on("console", (message) => message.type() === "error" && problems.push(message.text()));
    await tab.goto(address + hash);
    await tab.waitForSelector(".objects li");
    return { tab, problems };
  }
  /** Mesh answers from now on, by what their address asks. */
  function meshes(tab: Tab): { asked: URLSearchParams; triangles: number; coarse: boolean }[] {
    const list: { asked: URLSearchParams; triangles: number; coarse: boolean }[] = [];
    tab.on("response", (answer) => {
      const url = new URL(answer.url());
      if (url.pathname !== "/api/surface" || answer.status() !== 200) return;
      list.push({ asked: url.searchParams, triangles: Number(answer.headers()["x-triangles"]), coarse: answer.headers()["x-coarse"] === "1" });
    });
    return list;
  }

  it("shows the first object at once, as many triangles as the command line extracts", async () => {
    const { tab, problems } = await open();
    await tab.waitForFunction(() => document.querySelector(".badge")?.textContent?.includes("triangles"));
    const listed = (JSON.parse(isoatlas("objects", "demo.atlas", "--json")) as { objects: Listed[] }).objects;
    expect(await tab.locator(".objects ol").first().locator("li").count()).toBe(listed.length + 1);
    const seen = meshes(tab);
    await tab.getByRole("button", { name: /^Object 2/ }).click();
    await expect.poll(() => seen.filter((mesh) => !mesh.coarse).length).toBeGreaterThan(0);
    const last = seen[seen.length - 1];
    const object = listed[1] as Listed;
    expect(Number(last?.asked.get("object"))).toBe(object.id);
    const extracted = JSON.parse(isoatlas("extract", "demo.atlas", "--object", String(object.id), "--tau", String(object.best_tau), "-o", "x.ply", "--json")) as { triangles: number };
    expect(last?.triangles).toBe(extracted.triangles);
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("evolves one object, undoes it, and restores it from its link", async () => {
    const { tab } = await open();
    await tab.getByRole("button", { name: /^Object 1/ }).click();
    const box = tab.getByRole("textbox", { name: "isovalue" });
    const before = await box.inputValue();
    await box.fill("100");
    await box.press("Enter");
    await tab.locator(".objects h1").click();
    await tab.keyboard.press("]");
    await expect.poll(() => box.inputValue()).toBe("101.25");
    await tab.keyboard.press("{");
    await expect.poll(() => box.inputValue()).toBe("90");
    const link = tab.url();
    for (let i = 0; i < 3; ++i) await tab.keyboard.press("Control+z");
    await expect.poll(() => box.inputValue()).toBe(before);
    const other = await open(new URL(link).hash);
    await expect.poll(() => other.tab.getByRole("textbox", { name: "isovalue" }).inputValue()).toBe("90");
    expect(other.problems).toEqual([]);
    await tab.close();
    await other.tab.close();
  });

  it("adds objects, each at its own isovalue, and takes them out", async () => {
    const { tab } = await open();
    await tab.getByRole("button", { name: /^Object 4/ }).click();
    await tab.getByRole("button", { name: /^Object 5/ }).click({ modifiers: ["Shift"] });
    expect(await tab.locator(".objects input:checked").count()).toBe(2);
    await tab.getByRole("button", { name: "Hide" }).click();
    expect(await tab.locator(".objects input:checked").count()).toBe(1);
    expect(await tab.locator(".object h2").textContent()).toBe("Object 4");
    await tab.close();
  });

  it("shows a dark object as the wall around it, and finds objects in their tree", async () => {
    const { tab, problems } = await open();
    const seen = meshes(tab);
    await tab.getByRole("button", { name: /^Dark object 1/ }).click();
    await expect.poll(() => seen.length).toBeGreaterThan(0);
    expect(seen[0]?.asked.has("contour")).toBe(true);
    expect(await tab.locator(".object code").textContent()).toContain("--contour");
    await tab.keyboard.press("t");
    await tab.locator(".tree .mark").nth(3).click();
    expect(await tab.locator(".object h2").textContent()).toMatch(/^Object/);
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("saves a surface that is closed", async () => {
    const { tab } = await open();
    await tab.getByRole("combobox", { name: "format" }).selectOption("ply");
    const [download] = await Promise.all([tab.waitForEvent("download"), tab.getByRole("button", { name: "Save the surface" }).click()]);
    await download.saveAs(join(folder, "saved.ply"));
    expect(isoatlas("verify", "saved.ply")).toContain("all 8 guarantees hold");
    await tab.close();
  });

  it("draws something, and says its keys", async () => {
    const { tab } = await open();
    await tab.waitForTimeout(500);
    const colours = await tab.evaluate(() => {
      const canvas = document.querySelector("canvas") as HTMLCanvasElement;
      const copy = document.createElement("canvas");
      [copy.width, copy.height] = [64, 64];
      const context = copy.getContext("2d") as CanvasRenderingContext2D;
      context.drawImage(canvas, 0, 0, 64, 64);
      return new Set(new Uint32Array(context.getImageData(0, 0, 64, 64).data.buffer)).size;
    });
    expect(colours).toBeGreaterThan(20);
    await tab.keyboard.press("?");
    expect(await tab.getByRole("dialog").isVisible()).toBe(true);
    await tab.close();
  });

  it("says why when the token is wrong", async () => {
    const tab = await browser.newPage();
    await tab.goto(address.replace(/token=.*/, "token=none"));
    expect(await tab.getByRole("alert").textContent()).toContain("token");
    await tab.close();
  });
});
