// First steps in the viewer, in a browser with `isoatlas view`. Skipped without Chromium or isoatlas.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { canServe, meshes, Served, stableBox } from "./viewer_harness";

interface Listed {
  id: number;
  best_tau: number;
}

describe.skipIf(!canServe)("the viewer", () => {
  let served: Served;
  beforeAll(async () => {
    served = await Served.phantom("demo");
  });
  afterAll(() => served?.close());
  const open: Served["open"] = (...all) => served.open(...all);
  const isoatlas = (...words: string[]): string => served.isoatlas(...words);

  it("shows the first object at once, as many triangles as the command line extracts", async () => {
    const { tab, problems } = await open();
    await tab.waitForFunction(() => document.querySelector(".badge")?.textContent?.includes("triangles"));
    const listed = (JSON.parse(isoatlas("objects", "demo.atlas", "--json")) as { objects: Listed[] }).objects;
    expect(await tab.locator(".objects ol").first().locator("li").count()).toBe(listed.length + 1);
    const seen = meshes(tab);
    await tab.getByRole("button", { name: /^Object 2/ }).click();
    const object = listed[1] as Listed;
    const extracted = JSON.parse(
      isoatlas("extract", "demo.atlas", "--object", "2", "-o", "x.ply", "--json"),
    ) as { triangles: number };
    const whole = () => seen.filter((mesh) => !mesh.coarse && mesh.asked.get("object") === `v${object.id}`);
    await expect.poll(() => whole().map((mesh) => mesh.triangles)).toContain(extracted.triangles);
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("changes the isovalue of an object, undoes it, and restores it from its link", async () => {
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

  it("takes the keys of its actions while a slider or a menu has the focus", async () => {
    const { tab } = await open();
    await tab.getByRole("button", { name: /^Object 1/ }).click();
    const box = tab.getByRole("textbox", { name: "isovalue" });
    const before = await box.inputValue();
    const slider = tab.getByRole("slider", { name: "isovalue, on the histogram" });
    const area = await stableBox(slider);
    await tab.mouse.move(area.x + area.width / 2, area.y + area.height / 2);
    await tab.mouse.down();
    await tab.mouse.move(area.x + area.width * 0.6, area.y + area.height / 2, { steps: 3 });
    await tab.mouse.up();
    await expect.poll(() => box.inputValue()).not.toBe(before);
    expect(await slider.evaluate((element) => element === document.activeElement)).toBe(true);
    const dragged = await box.inputValue();
    await tab.keyboard.press("}");
    await expect.poll(() => box.inputValue()).not.toBe(dragged);
    const stepped = await box.inputValue();
    await tab.keyboard.press("ArrowLeft"); // of the slider
    await expect.poll(() => box.inputValue()).not.toBe(stepped);
    await tab.keyboard.press("?");
    expect(await tab.getByRole("dialog").isVisible()).toBe(true);
    await tab.close();
  });

  it("adds and removes objects, each at its own isovalue", async () => {
    const { tab } = await open();
    await tab.getByRole("button", { name: /^Object 4/ }).click();
    await tab.getByRole("button", { name: /^Object 5/ }).click({ modifiers: ["Shift"] });
    expect(await tab.locator(".objects input:checked").count()).toBe(2);
    await tab.getByRole("button", { name: "remove object 5" }).click();
    expect(await tab.locator(".objects input:checked").count()).toBe(1);
    expect(await tab.locator(".object h2").textContent()).toBe("Object 4");
    await tab.close();
  });

  it("shows a cavity as the wall around it, and finds objects in their tree", async () => {
    const { tab, problems } = await open();
    const seen = meshes(tab);
    await tab.getByRole("button", { name: /^Cavity 1/ }).click();
    await expect.poll(() => seen.some(({ asked }) => asked.has("contour"))).toBe(true);
    await tab.keyboard.press("s");
    expect(await tab.locator(".export code").textContent()).toContain("--contour");
    await tab.keyboard.press("Escape");
    await tab.keyboard.press("t");
    await tab.locator(".tree .mark").nth(3).click();
    expect(await tab.locator(".object h2").textContent()).toMatch(/^Object/);
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("saves a surface that is closed", async () => {
    const { tab } = await open();
    await tab.keyboard.press("s");
    await tab.getByRole("combobox", { name: "format of the surface" }).selectOption("ply");
    const [download] = await Promise.all([tab.waitForEvent("download"), tab.getByRole("button", { name: "Save the surface" }).click()]);
    await download.saveAs(join(served.folder, "saved.ply"));
    expect(isoatlas("verify", "saved.ply")).toContain("all 8 guarantees hold");
    await tab.close();
  });

  it("saves a surface with fewer triangles, near the exact one", async () => {
    const { tab } = await open();
    await tab.keyboard.press("s");
    await tab.getByRole("combobox", { name: "format of the surface" }).selectOption("ply");
    const save = async (name: string): Promise<number> => {
      const [download] = await Promise.all([tab.waitForEvent("download"), tab.getByRole("button", { name: "Save the surface" }).click()]);
      await download.saveAs(join(served.folder, name));
      expect(isoatlas("verify", name)).toContain("all 8 guarantees hold");
      return Number(/element face (\d+)/.exec(readFileSync(join(served.folder, name), "latin1"))?.[1]);
    };
    const all = await save("all.ply");
    await tab.getByRole("combobox", { name: "triangles of the surface" }).selectOption("0.5");
    const fewer = await save("fewer.ply");
    expect(fewer).toBeLessThan(all / 4);
    await tab.getByText(`${fewer} triangles within 0.`).first().waitFor();
    await tab.close();
  });

  it("draws something, and lists its keys", async () => {
    const { tab } = await open();
    await tab.waitForTimeout(500);
    const colours = await tab.evaluate(() => {
      const canvas = document.querySelector(".viewport canvas") as HTMLCanvasElement;
      const copy = document.createElement("canvas");
      [copy.width, copy.height] = [64, 64];
      const context = copy.getContext("2d") as CanvasRenderingContext2D;
      context.drawImage(canvas, 0, 0, 64, 64);
      return new Set(new Uint32Array(context.getImageData(0, 0, 64, 64).data.buffer)).size;
    });
    expect(colours).toBeGreaterThan(20);
    await tab.setViewportSize({ width: 800, height: 400 }); // lower than the list
    await tab.keyboard.press("?");
    expect(await tab.getByRole("dialog").isVisible()).toBe(true);
    expect(await tab.getByRole("dialog").evaluate((dialog) => dialog.scrollTop)).toBe(0);
    expect((await tab.getByRole("heading", { name: "Keyboard shortcuts" }).boundingBox())!.y).toBeGreaterThan(0);
    await tab.close();
  });

  it("opens in a browser once, without secrets in its address; then it can be reloaded, in other tabs and by links", async () => {
    const context = await served.browser.newContext({ viewport: { width: 1000, height: 700 } });
    await context.addInitScript(() => localStorage.setItem("isoatlas-tour", "seen"));
    const [tab, other] = [await context.newPage(), await context.newPage()];
    const address = await served.address();
    await tab.goto(address);
    await tab.waitForSelector(".objects [role=tab]");
    await expect.poll(() => new URL(tab.url()).hash).toContain("selected=");
    expect(tab.url()).toMatch(new RegExp(`^${served.origin}/#`));
    expect(await tab.evaluate(() => document.cookie)).toBe("");
    const [cookie] = await context.cookies();
    expect(cookie).toMatchObject({ name: `isoatlas-${new URL(served.origin).port}`, httpOnly: true, sameSite: "Strict" });
    expect(cookie?.expires).toBeGreaterThan(Date.now() / 1000); // a link opens again when the browser was closed
    await tab.reload();
    await tab.waitForSelector(".objects [role=tab]");
    await other.goto(tab.url());
    await other.waitForSelector(".objects [role=tab]");
    await other.goto(address);
    expect(await other.getByRole("alert").textContent()).toContain("token");
    await other.goto("about:blank"); // another site
    await other.evaluate((link) => location.assign(link), tab.url());
    await other.waitForSelector(".objects [role=tab]");
    expect(new URL(other.url()).pathname).toBe("/");
    await context.close();
  });

  it("explains why a browser without a key is rejected", async () => {
    const tab = await served.browser.newPage();
    await tab.goto(served.origin);
    expect(await tab.getByRole("alert").textContent()).toContain("token");
    await tab.goto(await served.address());
    await tab.waitForSelector(".objects [role=tab]");
    await tab.evaluate(() => localStorage.removeItem("isoatlas"));
    await tab.reload();
    await expect.poll(() => tab.getByRole("alert").textContent()).toContain("token");
    await tab.close();
  });
});
