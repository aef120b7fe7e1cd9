// Finding objects among thousands, in a browser, on a noisy volume; numbers are compared with the command line.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import type { Page as Tab } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { canServe, meshes, Served, stableBox } from "./viewer_harness";

interface Listed {
  id: number;
  number: number;
  best_tau: number;
  appears: number;
  merges: number;
  voxels: number;
  tunnels: number;
  note: string;
  like: { line: number } | null;
}

interface Table {
  branches: number;
  hidden: number;
  objects: Listed[];
}

describe.skipIf(!canServe)("the list of objects", () => {
  let served: Served;
  beforeAll(async () => {
    served = await Served.phantom("random-field", "--size", "40", "--noise", "0.05");
  });
  afterAll(() => served?.close());

  const table = (...words: string[]): Table => JSON.parse(served.isoatlas("objects", served.store, ...words, "--json")) as Table;
  const said = (tab: Tab): Promise<string> => tab.locator(".objects > p[role=status]").innerText();
  const title = (tab: Tab): Promise<string> => tab.locator(".object h2").innerText();
  const isField = ({ note, voxels }: Listed): boolean => note.startsWith("outline") && voxels > (2 / 3) * 40 ** 3;
  const withCards = ({ objects }: Table): string[] =>
    objects.filter((object) => object.like === null && !isField(object)).map(({ number }) => `Object ${number}`);
  const count = (n: number): string => n.toLocaleString("en");

  it("opens with cards with turntables; a click isolates, the checkbox adds", async () => {
    const { tab, problems } = await served.open();
    const first = table();
    const cards = withCards(first);
    expect(await tab.locator(".cards").first().locator(".card").count()).toBe(cards.length + 1);
    expect(await said(tab)).toContain(`${first.branches - first.hidden} of ${count(first.branches)} objects shown`);
    const card = tab.locator(".card").first();
    await card.locator(".turntable").focus();
    await expect.poll(() => card.locator("img").evaluate((image) => image.style.width)).toBe("1200%"); // all around
    await tab.keyboard.press("ArrowRight");
    expect(await card.locator(".turntable").getAttribute("data-frame")).toBe("1");
    await tab.locator(".card .picture").nth(1).click();
    expect(await title(tab)).toBe(cards[1]);
    await tab.locator(".card").nth(2).getByRole("checkbox").check();
    expect(await tab.locator(".objects input:checked").count()).toBe(2);
    expect(await tab.locator(".card.selected b").innerText()).toBe(cards[2]);
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("folds the outline of the scanned field away, until it is in the scene", async () => {
    const { tab, problems } = await served.open();
    const field = table().objects.find(isField)!;
    expect(await title(tab)).not.toBe(`Object ${field.number}`); // the viewer begins with another one
    expect(await tab.locator(".field .card").isVisible()).toBe(false);
    expect(await tab.locator(".field .card b").textContent()).toBe(`Object ${field.number}`);
    await tab.locator(".field summary").click();
    await tab.locator(".field .picture").click();
    expect(await title(tab)).toBe(`Object ${field.number}`);
    expect(await tab.locator(".field").count()).toBe(0);
    expect(await tab.locator(".card.selected b").innerText()).toBe(`Object ${field.number}`);
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("takes lengths to be in the chosen unit, as the file has none", async () => {
    const { tab, problems } = await served.open();
    const facts = (): Promise<string> => tab.locator(".object").innerText();
    await expect.poll(facts).toMatch(/enclosed volume\s+[\d.,]+ voxels/);
    const before = await facts();
    await tab.getByRole("combobox", { name: "unit of lengths" }).selectOption("µm");
    await expect.poll(facts).toMatch(/enclosed volume\s+[\d.,]+ µm³/);
    const [was, is] = [before, await facts()].map((text) => /enclosed volume\s+([\d.,]+)/.exec(text)?.[1]);
    expect(is).toBe(was);
    await tab.keyboard.press("s");
    expect(await tab.locator(".export code").textContent()).toContain("--unit um");
    await tab.getByRole("combobox", { name: "format of the surface" }).selectOption("ply");
    const [download] = await Promise.all([tab.waitForEvent("download"), tab.getByRole("button", { name: "Save the surface" }).click()]);
    const file = join(served.folder, "micro.ply");
    await download.saveAs(file);
    expect(readFileSync(file, "utf8").slice(0, 1000)).toContain("comment unit µm");
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("filters by typed limits like the command line, undoes it, and restores it from a link", async () => {
    const { tab, problems } = await served.open();
    await tab.keyboard.press("4");
    const before = await said(tab);
    await tab.getByRole("spinbutton", { name: "contrast, at least" }).fill("1.5");
    await tab.getByRole("spinbutton", { name: "size, at least" }).fill("6");
    await tab.keyboard.press("Tab");
    const line = await tab.locator(".same-list code").innerText();
    expect(line).toMatch(/--persistence 1\.5 --min-voxels 6$/);
    const chosen = table(...line.split(" ").slice(3));
    expect(chosen.branches - chosen.hidden).toBeGreaterThan(20);
    const words = `${count(chosen.branches - chosen.hidden)} of ${count(chosen.branches)} objects shown`;
    expect(await said(tab)).toContain(words);
    const other = await served.open(new URL(tab.url()).hash);
    expect(await said(other.tab)).toContain(words);
    expect(await other.tab.getByRole("tab", { selected: true }).innerText()).toBe("Filter");
    await other.tab.close();
    await tab.locator("h1").click();
    await tab.keyboard.press("Control+z");
    await tab.keyboard.press("Control+z");
    expect(await said(tab)).toBe(before);
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("shows an object that is not on the page in cards, list, tree and viewport", async () => {
    const { tab, problems } = await served.open();
    await tab.keyboard.press("4");
    await tab.getByRole("spinbutton", { name: "number of most important objects" }).fill("30");
    await tab.keyboard.press("Tab");
    await tab.getByRole("tab", { name: "List" }).click();
    const seen = meshes(tab);
    await tab.getByRole("button", { name: /^Object of rank 12 / }).click();
    await expect.poll(() => seen.filter((mesh) => !mesh.coarse).length).toBeGreaterThan(0);
    const asked = seen.at(-1)?.asked;
    const [object, tau] = [asked?.get("object") ?? "", asked?.get("tau") ?? ""];
    const words = ["extract", served.store, "--object", object, "--tau", tau, "-o", "x.ply", "--json"];
    const extracted = JSON.parse(served.isoatlas(...words)) as { triangles: number };
    expect(seen.at(-1)?.triangles).toBe(extracted.triangles);
    expect(await title(tab)).toBe("Object of rank 12");
    await tab.keyboard.press("1");
    expect(await tab.locator(".card.selected b").innerText()).toBe("Object of rank 12");
    await tab.locator(".card.selected .turntable img").waitFor();
    await tab.keyboard.press("t");
    expect(await tab.locator('.tree [role="treeitem"][aria-selected="true"]').getAttribute("aria-label")).toContain("Object of rank 12");
    expect(await tab.locator(".tree [data-branch].selected").count()).toBe(1);
    const same = table("--keep", "12").objects.at(-1);
    const range = await tab.locator(".object dl").last().innerText();
    expect(range).toContain(String(Number(same?.appears.toPrecision(4))));
    const link = await served.open(new URL(tab.url()).hash);
    expect(await title(link.tab)).toBe("Object of rank 12");
    expect([...problems, ...link.problems]).toEqual([]);
    await tab.close();
    await link.tab.close();
  });

  it("filters by a box in the scatter plot; a click on a dot shows its object", async () => {
    const { tab, problems } = await served.open("#scene=&tab=scatter");
    const plot = tab.locator(".scatter");
    const dots = tab.locator(".scatter .u-over"); // between the axes
    await tab.getByText("a dot each").waitFor(); // all objects are known
    const box = await stableBox(plot);
    await tab.mouse.move(box.x + box.width * 0.6, box.y + box.height * 0.55);
    await tab.mouse.down();
    await tab.mouse.move(box.x + box.width - 1, box.y + 1, { steps: 4 });
    await tab.mouse.up();
    const line = await tab.locator(".same-list code").innerText();
    expect(line).toMatch(/--persistence [\d.]+ --min-voxels [\d.]+$/);
    const chosen = table(...line.split(" ").slice(3));
    expect(await said(tab)).toContain(`${count(chosen.branches - chosen.hidden)} of ${count(chosen.branches)} objects shown`);
    expect(await plot.getAttribute("aria-label")).toContain(`${count(chosen.branches - chosen.hidden)} of them chosen`);
    const { width, height } = (await dots.boundingBox()) ?? box;
    await dots.click({ position: { x: width * 0.97, y: height * 0.03 } });
    expect(await title(tab)).toMatch(/^Object/);
    await tab.keyboard.press("2");
    expect(await tab.locator(".rows li.selected").count()).toBe(1);
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("folds, navigates and searches the tree by keys alone", async () => {
    const { tab, problems } = await served.open("#scene=&choice=,40,,,,");
    await tab.keyboard.press("3");
    await tab.keyboard.press("Tab"); // from the tab to the slider
    await tab.keyboard.press("End");
    const items = tab.locator('.tree [role="treeitem"]');
    await expect.poll(() => items.count()).toBeGreaterThanOrEqual(40);
    const all = await items.count();
    await tab.keyboard.press("Tab");
    expect(await tab.evaluate(() => document.activeElement?.getAttribute("role"))).toBe("treeitem");
    await tab.keyboard.press("Home");
    await tab.keyboard.press("ArrowLeft");
    await expect.poll(() => items.count()).toBeLessThan(all);
    expect(await tab.locator(".tree [role=treeitem]").first().getAttribute("aria-expanded")).toBe("false");
    await tab.keyboard.press("ArrowRight");
    await expect.poll(() => items.count()).toBe(all);
    await tab.keyboard.press("ArrowDown");
    await tab.keyboard.press("Enter");
    const walked = await title(tab);
    expect(walked).toMatch(/^(Object|Cavity)/);
    expect(await tab.locator('.tree [aria-selected="true"]').count()).toBe(1);
    await tab.keyboard.press("/");
    await tab.keyboard.type("rank 17");
    await expect.poll(() => items.count()).toBeLessThanOrEqual(2);
    expect(await items.filter({ hasText: "rank 17" }).count()).toBe(1);
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("shows how many objects are hidden, and steps through the objects by key", async () => {
    const { tab, problems } = await served.open();
    await tab.getByText("Hidden objects").click();
    const { branches } = table();
    expect(await tab.locator(".hidden-words").innerText()).toContain(`${count(branches)} objects in all`);
    await tab.getByRole("button", { name: "The 100 most important" }).click();
    expect(await said(tab)).toContain(`100 of ${count(branches)} objects shown`);
    expect(await tab.locator(".cards").first().locator(".card").count()).toBe(60);
    await tab.locator(".more").first().click();
    expect(await tab.locator(".cards").first().locator(".card").count()).toBeGreaterThan(100);
    await tab.locator("h1").click();
    const names: string[] = [];
    for (let i = 0; i < 3; ++i) {
      await tab.keyboard.press("n");
      names.push(await title(tab));
    }
    expect(new Set(names).size).toBe(3);
    await tab.keyboard.press("N");
    expect(await title(tab)).toBe(names[1]);
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("works on a phone: the viewport stays, cards scroll, no horizontal overflow", async () => {
    const { tab, problems } = await served.open("", { viewport: { width: 360, height: 740 }, hasTouch: true, isMobile: true });
    for (const name of ["Cards", "List", "Tree", "Filter"]) {
      await tab.getByRole("tab", { name }).tap();
      expect(await tab.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(360);
      expect((await tab.locator(".viewport").boundingBox())?.y).toBeGreaterThanOrEqual(-1);
    }
    await tab.getByRole("tab", { name: "Cards" }).tap();
    await tab.locator(".card .picture").nth(1).tap();
    expect(await title(tab)).toBe(withCards(table())[1]);
    expect(problems).toEqual([]);
    await tab.close();
  });
});
