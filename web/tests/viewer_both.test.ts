// A viewer of a store of both polarities: one list, one scene, files as those of the command line.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { canServe, Served } from "./viewer_harness";

interface Listed {
  reference: string;
  best_tau: number;
  like: object | null;
}

describe.skipIf(!canServe)("a viewer of objects of high and of low values", () => {
  let served: Served;
  let listed: Listed[];
  beforeAll(async () => {
    served = await Served.building(["demo", "--size", "40"]);
    const table = served.isoatlas("objects", "demo.nrrd", "--polarity", "both", "--json", "--quiet");
    listed = (JSON.parse(table) as { objects: Listed[] }).objects.filter(({ like }) => like === null); // the others are on their cards
  });
  afterAll(() => served?.close());

  it("lists both in one order, and opens the object of an address", async () => {
    const { tab, problems } = await served.open("#low1");
    const titles = tab.locator(".card b");
    await expect.poll(() => titles.count()).toBe(listed.length + 1); // and the whole isosurface
    expect((await titles.allInnerTexts()).slice(0, listed.length)).toEqual(listed.map(({ reference }) => `Object ${reference}`));
    await expect.poll(() => tab.locator(".object h2").innerText()).toBe("Object low1");
    expect(await tab.locator(".card.selected").innerText()).toContain("values at most");
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("shows both in one scene, each at its isovalue, and saves them as the command line does", async () => {
    const { tab, problems } = await served.open("#low1");
    await tab.getByRole("checkbox", { name: "show object 1", exact: true }).check();
    await expect.poll(() => tab.locator(".scene").innerText()).toMatch(/Object low1[\s\S]*triangles[\s\S]*Object 1[\s\S]*triangles/);
    await expect.poll(() => tab.evaluate(() => location.hash)).toMatch(/^#scene=\d+,[^;]+;\d+,/);
    const { tab: other } = await served.open(await tab.evaluate(() => location.hash));
    await expect.poll(() => other.locator(".scene").innerText()).toMatch(/Object low1[\s\S]*Object 1/);
    await other.close();
    await tab.keyboard.press("s");
    const [download] = await Promise.all([tab.waitForEvent("download"), tab.getByRole("button", { name: "Save all surfaces" }).click()]);
    const file = join(served.folder, "saved.glb");
    await download.saveAs(file);
    served.isoatlas("extract", "demo.atlas", "--object", "low1", "1", "-o", "same.glb", "--quiet");
    expect(readFileSync(file).equals(readFileSync(join(served.folder, "same.glb")))).toBe(true);
    expect(problems).toEqual([]);
    await tab.close();
  });
});
