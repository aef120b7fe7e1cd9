// The panels of the viewer, in a browser: the selected object and its relations, small windows, nothing shown, menus, search.
import type { Page as Tab } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { firstRelations, type Relation } from "../src/viewer/panels/relations";
import { canServe, Served } from "./viewer_harness";

describe("the first relations of an object", () => {
  const all = (...kinds: string[]): Relation[] => kinds.map((kind, entry) => ({ kind, entry, words: "" }));
  const kept = (limit: number, ...kinds: string[]): string =>
    firstRelations(all(...kinds), limit)
      .map(({ kind, entry }) => `${kind}${entry}`)
      .join();

  it("are all of a short list", () => {
    expect(kept(5, "inside", "contains")).toBe("inside0,contains1");
  });

  it("have some of each kind, in their order", () => {
    expect(kept(3, "contains", "contains", "contains", "merged", "same")).toBe("contains0,merged3,same4");
    expect(kept(4, "contains", "contains", "contains", "merged", "same")).toBe("contains0,contains1,merged3,same4");
  });
});

describe.skipIf(!canServe)("the panels of the viewer", () => {
  let served: Served;
  beforeAll(async () => {
    served = await Served.phantom("demo", "--size", "48");
  });
  afterAll(() => served?.close());

  const title = (tab: Tab): Promise<string> => tab.locator(".object h2").innerText();

  /** Selects the object with the most relations. */
  async function openRelated(tab: Tab): Promise<void> {
    const cards = tab.locator(".cards").first().locator(".card .picture");
    for (let i = 0; i < (await cards.count()); ++i) {
      await cards.nth(i).click();
      if ((await tab.locator(".relations details").count()) > 0) return;
    }
    throw new Error("no object has more than five relations");
  }

  it("shows five related objects with thumbnails, and folds the others away", async () => {
    const { tab, problems } = await served.open();
    await openRelated(tab);
    const relations = tab.locator(".relations");
    expect(await relations.locator("li:visible").count()).toBe(5);
    await relations.scrollIntoViewIfNeeded();
    await expect.poll(() => relations.locator("li:visible .thumb img").count()).toBeGreaterThan(0);
    const width = await relations.locator(".thumb").first().evaluate((element) => element.getBoundingClientRect().width);
    expect(width).toBeLessThan(60);
    const more = relations.locator("summary");
    const folded = Number(/^(\d+) more$/.exec(await more.innerText())?.[1]);
    await more.click();
    await expect.poll(() => relations.locator("li:visible").count()).toBe(5 + folded);
    const link = relations.locator(".link").first();
    const other = await link.innerText();
    await link.click();
    expect(await title(tab)).toBe(other);
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("leaves most of a window of 800 by 600 to the 3D view, with one panel at a time", async () => {
    const { tab, problems } = await served.open("", { viewport: { width: 800, height: 600 } });
    const box = async (selector: string) => (await tab.locator(selector).boundingBox()) ?? { x: 0, y: 0, width: 0, height: 0 };
    const share = async (): Promise<number> => {
      const { width, height } = await box(".viewport > canvas");
      return (width * height) / (800 * 600);
    };
    const outside = (): Promise<string[]> =>
      tab.evaluate(() =>
        [...document.querySelectorAll(".menus summary, .panel-switch button, .axis *, .cube, .scale, .unit, .side, .inspector")]
          .map((element): [string, DOMRect] => [element.outerHTML.slice(0, 80), element.getBoundingClientRect()])
          .filter(([, { left, top, right, bottom }]) => left < 0 || top < 0 || right > 800.5 || bottom > 600.5)
          .map(([what]) => what),
      );
    const panels = tab.getByRole("group", { name: "panels" });
    for (const [name, shown, hidden] of [
      ["Objects", ".side", ".inspector"],
      ["Scene", ".inspector", ".side"],
    ] as const) {
      if (name === "Scene") await panels.getByRole("button", { name }).click();
      expect(await panels.getByRole("button", { name }).getAttribute("aria-pressed")).toBe("true");
      expect(await tab.locator(hidden).isVisible()).toBe(false);
      await expect.poll(share).toBeGreaterThanOrEqual(0.55);
      const [panel, canvas] = [await box(shown), await box(".viewport > canvas")];
      expect(panel.x + panel.width).toBeLessThanOrEqual(canvas.x + 0.5);
      expect(await outside()).toEqual([]);
      const tops = await tab.locator(".menus summary").evaluateAll((all) => all.map((element) => element.getBoundingClientRect().top));
      expect(new Set(tops).size).toBe(1); // one line
    }
    await panels.getByRole("button", { name: "Scene" }).click();
    await expect.poll(share).toBeGreaterThanOrEqual(0.7);
    await tab.keyboard.press("2"); // opens its panel as well
    expect(await tab.locator(".side").isVisible()).toBe(true);
    expect(await tab.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(800);
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("says what to do while nothing is shown, and tells no measures then", async () => {
    const { tab, problems } = await served.open();
    const badge = tab.locator(".axis .badge");
    const hint = tab.getByRole("region", { name: "nothing is shown" });
    await expect.poll(() => badge.textContent()).toContain("this object");
    expect(await hint.isVisible()).toBe(false);
    const before = await title(tab);
    await tab.keyboard.press("h");
    expect(await hint.innerText()).toContain("Everything is hidden");
    await hint.getByRole("button", { name: "Show all objects" }).click();
    expect(await hint.isVisible()).toBe(false);
    await tab.keyboard.press("Delete");
    expect(await hint.innerText()).toContain("Click an object in the list");
    await expect.poll(() => badge.textContent()).toBe("");
    expect(await tab.locator(".object").isVisible()).toBe(false);
    expect(await tab.getByRole("textbox", { name: "isovalue", exact: true }).inputValue()).toBe("");
    expect(await tab.getByRole("button", { name: "play upwards" }).isDisabled()).toBe(true);
    await hint.getByRole("button", { name: "Undo" }).click();
    expect(await title(tab)).toBe(before);
    await tab.keyboard.press("Delete");
    await tab.keyboard.press("v"); // the volume itself is shown
    await expect.poll(() => hint.isVisible()).toBe(false);
    await tab.keyboard.press("v");
    await hint.getByRole("button", { name: "Show the first object" }).click();
    expect(await hint.isVisible()).toBe(false);
    await expect.poll(() => badge.textContent()).toContain("this object");
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("names the buttons that play", async () => {
    const { tab, problems } = await served.open();
    for (const [name, title] of [
      ["play downwards", /lower the isovalue/],
      ["play upwards", /raise the isovalue/],
    ] as const)
      expect(await tab.getByRole("button", { name, exact: true }).getAttribute("title")).toMatch(title);
    expect(await tab.getByRole("group", { name: "play" }).innerText()).toContain("play");
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("has menus in sections with headings and icons", async () => {
    const { tab, problems } = await served.open();
    const names: string[] = [];
    for (const summary of await tab.locator(".menus summary").all()) {
      await summary.click();
      const box = tab.locator(".menus details[open] .box");
      const buttons = box.getByRole("button");
      await buttons.first().waitFor();
      names.push(...(await buttons.locator("span").allTextContents()));
      expect(await buttons.locator('svg[aria-hidden="true"]').count()).toBe(await buttons.count());
      const headings = await box.locator("p").allTextContents();
      expect(headings).not.toContain("Other"); // each action has its place
      for (const heading of headings) expect(await box.getByRole("list", { name: heading, exact: true }).count()).toBe(1);
      await tab.keyboard.press("Escape");
    }
    const some = ["Fit to view", "Orthographic", "Volume rendering", "Export...", "Pick object at crosshair"];
    expect(names).toEqual(expect.arrayContaining(some));
    expect(names.filter((name) => name.startsWith("Orbit"))).toEqual([]); // arrow keys
    await tab.keyboard.press("?");
    expect(await tab.locator(".help dd").allTextContents()).toContain("Orbit left");
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("finds objects by number, reference, isovalue and name; arrows, Enter and Escape work", async () => {
    const { tab, problems } = await served.open();
    const said = tab.locator(".objects > p[role=status]");
    const all = await said.innerText();
    const titles = (): Promise<string[]> => tab.locator(".items .card > button b").allTextContents();
    const type = async (text: string): Promise<void> => {
      await tab.keyboard.press("Control+a");
      await tab.keyboard.type(text);
    };
    const table = JSON.parse(served.isoatlas("objects", served.store, "--json")) as { objects: { number: number; best_tau: number }[] };
    const third = table.objects.find(({ number }) => number === 3)!;
    await tab.keyboard.press("/");
    for (const [text, found] of [
      ["c1", "Cavity 1"],
      [third.best_tau.toFixed(1), "Object 3"],
      [`@${third.best_tau.toFixed(1)}`, "Object 3"],
      ["whole", "Whole isosurface"],
    ] as const) {
      await type(text);
      await expect.poll(titles).toEqual([found]);
    }
    await type("c1");
    await tab.keyboard.press("Enter");
    expect(await title(tab)).toBe("Cavity 1");
    await type("nonesuch");
    await expect.poll(() => said.innerText()).toMatch(/^none: .*nonesuch/);
    expect(await titles()).toEqual([]);
    await tab.keyboard.press("Escape");
    await expect.poll(() => said.innerText()).toBe(all);
    await tab.keyboard.type("object");
    await expect.poll(() => said.innerText()).toMatch(/^found: /);
    const focused = (): Promise<string | null | undefined> => tab.evaluate(() => document.activeElement?.querySelector("b")?.textContent);
    const [first, second] = await titles();
    await tab.keyboard.press("ArrowDown");
    expect(await focused()).toBe(first);
    await tab.keyboard.press("ArrowDown");
    expect(await focused()).toBe(second);
    await tab.keyboard.press("Enter");
    expect(await title(tab)).toBe(second);
    await tab.keyboard.press("Escape");
    expect(await tab.evaluate(() => document.activeElement?.getAttribute("type"))).toBe("search");
    expect(problems).toEqual([]);
    await tab.close();
  });
});
