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
});
