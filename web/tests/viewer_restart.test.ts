// The server ends and is started again: what the open page says and does, and what a link shows.
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import type { Page as Tab } from "playwright-core";
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import { canServe, meshes, Served } from "./viewer_harness";

const SIZE = [96, 96, 96]; // of the phantom
const SCENE = { schema: "isoatlas/scene/1", volume: { name: "demo", size: SIZE }, view: null, parts: {} };

/** A tab of a browser that can have more of them. */
async function opened(served: Served): Promise<Tab> {
  const context = await served.browser.newContext({ viewport: { width: 1000, height: 700 } });
  await context.addInitScript(() => localStorage.setItem("isoatlas-tour", "seen"));
  const tab = await context.newPage();
  await tab.goto(await served.address());
  await tab.waitForSelector(".objects [role=tab]");
  return tab;
}

const hash = (tab: Tab): Promise<string> => tab.evaluate(() => location.hash);

describe.skipIf(!canServe)("a server that is started again", () => {
  let served: Served;
  beforeEach(async () => (served = await Served.phantom("demo")), 240_000);
  afterEach(async () => served.close());

  it("is found by the page, which loads what it could not", async () => {
    const { tab } = await served.open();
    await served.kill();
    const alert = tab.getByText("isoatlas view has ended");
    await alert.waitFor();
    await tab.getByRole("button", { name: /^Object 3/ }).first().click(); // not loaded
    await tab.getByText("no connection").first().waitFor();
    const before = await hash(tab);
    const loaded = meshes(tab);
    await served.restart();
    await tab.getByRole("status").getByText("connected again").waitFor();
    expect(await alert.isVisible()).toBe(false);
    await tab.getByText("no connection").first().waitFor({ state: "detached" });
    await expect.poll(() => loaded.some(({ coarse }) => !coarse)).toBe(true);
    expect((await hash(tab)).split("&view")[0]).toBe(before.split("&view")[0]);
    await tab.getByText("enclosed volume").first().waitFor(); // measures, which had failed too
  }, 240_000);

  it("is missed by controls that need it, which say so and work again", async () => {
    const { tab } = await served.open();
    await served.kill();
    await tab.getByText("isoatlas view has ended").waitFor();
    await tab.keyboard.press("F2");
    await tab.getByRole("status").getByText("Rename selected object...: needs isoatlas view, which has ended").waitFor();
    expect(await tab.getByRole("textbox", { name: "name of the object" }).isVisible()).toBe(false);
    await tab.locator("summary", { hasText: "Export" }).click();
    const inMenu = tab.getByRole("button", { name: "Surface as STL" });
    expect(await inMenu.getAttribute("aria-disabled")).toBe("true");
    expect(await inMenu.getAttribute("title")).toContain("needs isoatlas view");
    expect(await tab.getByRole("button", { name: "Scene file" }).getAttribute("aria-disabled")).toBeNull();
    await tab.getByRole("button", { name: "Export..." }).click();
    const save = tab.getByRole("button", { name: "Save the surface" });
    expect(await save.getAttribute("aria-disabled")).toBe("true");
    expect(await tab.getByRole("button", { name: "Save the scene" }).getAttribute("aria-disabled")).toBeNull();
    await served.restart();
    await tab.locator("button:not([aria-disabled])", { hasText: "Save the surface" }).waitFor();
    const download = tab.waitForEvent("download");
    await save.click();
    expect((await download).suggestedFilename()).toMatch(/\.stl$/);
  }, 240_000);

  it("opens a link of before at the same view, without a new address", async () => {
    const tab = await opened(served);
    await tab.getByRole("button", { name: /^Object 2/ }).first().click();
    await expect.poll(() => tab.url(), { timeout: 60_000 }).toContain("view=");
    const link = tab.url();
    await served.kill();
    await served.restart();
    const other = await tab.context().newPage();
    await other.goto(link);
    await other.waitForSelector(".objects [role=tab]");
    expect(other.url()).toBe(link);
    await other.getByRole("heading", { name: /^Object 2/ }).waitFor();
  }, 240_000);

  it("with another volume is not taken for the first one", async () => {
    const tab = await opened(served);
    await served.kill();
    await tab.getByText("isoatlas view has ended").waitFor();
    served.isoatlas("phantom", "torus-chain", "--size", "32", "-o", "chain.nrrd", "--quiet");
    served.isoatlas("build", "chain.nrrd", "-o", "chain.atlas", "--quiet");
    await served.restart("chain.atlas");
    await tab.getByText("The token of this page is invalid").waitFor();
    const other = await tab.context().newPage(); // in the same browser: the page gets its key
    await other.goto(await served.address());
    await tab.getByText("The server now shows another volume, chain").waitFor();
    await tab.getByRole("button", { name: "Reload" }).click();
    await tab.waitForSelector(".objects [role=tab]");
    expect(await tab.title()).toContain("chain");
  }, 240_000);

  it("with a scene begins with it, unless the link has another view", async () => {
    const tab = await opened(served);
    await tab.getByRole("button", { name: /^Object 2/ }).first().click();
    await expect.poll(() => tab.url(), { timeout: 60_000 }).toContain("view=");
    const link = await hash(tab);
    await tab.locator("summary", { hasText: "Export" }).click();
    const download = tab.waitForEvent("download");
    await tab.getByRole("button", { name: "Scene file" }).click();
    const file = join(served.folder, "saved.json");
    await (await download).saveAs(file);
    await served.kill();
    await served.restart(served.store, "--scene", "saved.json");
    const other = await opened(served);
    await expect.poll(() => hash(other)).toBe(link);
    await other.goto(`${served.origin}/#scene=0,100,1,1&selected=0`);
    await other.reload();
    await other.waitForSelector(".objects [role=tab]");
    expect(await hash(other)).toContain("scene=0,100,1,1");
    await served.kill();
    const scene = { ...SCENE, shown: [{ entry: 0, id: 7, tau: 1, opacity: 1, visible: true, colour: null, walls: "all" }], selected: 0 };
    writeFileSync(file, JSON.stringify(scene));
    await served.restart(served.store, "--scene", "saved.json");
    const wrong = await opened(served);
    await wrong.getByRole("status").getByText("saved.json is not shown. shown[0].id is 7").waitFor();
  }, 240_000);
});
