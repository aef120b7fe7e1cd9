// Accessibility: screen readers, phones, dark theme, first use.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import type { Page as Tab } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { canServe, Served } from "./viewer_harness";

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

interface Violation {
  id: string;
  nodes: { html: string; failureSummary: string }[];
}

async function violations(tab: Tab): Promise<string[]> {
  await tab.evaluate(axe);
  const found = await tab.evaluate(
    async () => (await (window as unknown as { axe: { run(): Promise<{ violations: Violation[] }> } }).axe.run()).violations,
  );
  return found.flatMap(({ id, nodes }) => nodes.map((node) => `${id}: ${node.html.slice(0, 160)} ${node.failureSummary.slice(0, 200)}`));
}

describe.skipIf(!canServe)("accessibility of the viewer", () => {
  let served: Served;
  beforeAll(async () => {
    served = await Served.phantom("demo", "--size", "48");
  });
  afterAll(() => served?.close());

  for (const colorScheme of ["light", "dark"] as const) {
    it(`violates no rule of axe-core, ${colorScheme}, with every tool, menu and dialog`, async () => {
      const { tab } = await served.open("", { colorScheme, viewport: { width: 1280, height: 800 } }, true);
      await tab.waitForSelector(".tour");
      expect(await violations(tab), "the tour").toEqual([]);
      await tab.keyboard.press("Escape");
      await tab
        .getByRole("button", { name: /^Object [2-9]/ })
        .first()
        .click({ modifiers: ["Shift"] });
      await tab.keyboard.press("g");
      expect(await violations(tab), "two objects").toEqual([]);
      for (const menu of await tab.locator(".menus summary").all()) {
        await menu.click();
        expect(await violations(tab), `menu ${(await menu.textContent()) ?? ""}`).toEqual([]);
        await tab.keyboard.press("Escape");
      }
      for (const key of ["1", "2", "3", "4"]) {
        await tab.keyboard.press(key);
        await tab.waitForSelector(`.objects [role="tab"]:nth-child(${key})[aria-selected="true"]`);
        expect(await violations(tab), `objects by ${key}`).toEqual([]);
      }
      for (const key of ["k", "c", "m", "v"]) {
        await tab.keyboard.press(key);
        expect(await violations(tab), `tool of ${key}`).toEqual([]);
      }
      for (const key of ["s", "?"]) {
        await tab.keyboard.press(key);
        await tab.waitForSelector("dialog[open]");
        expect(await violations(tab), `dialog of ${key}`).toEqual([]);
        await tab.keyboard.press("Escape");
      }
      await tab.close();
    });
  }

  it("moves through a menu by arrow keys, without moving the camera", async () => {
    const { tab } = await served.open();
    await expect.poll(() => tab.url()).toContain("&view="); // the scene has been fitted to the view
    const before = tab.url();
    const summary = tab.locator(".menus summary", { hasText: "View" });
    await summary.focus();
    await tab.keyboard.press("Enter");
    await tab.waitForSelector(".menus details[open] button");
    const names = await tab.locator(".menus details[open] button span").allTextContents();
    for (const [key, name] of [
      ["ArrowDown", names[0]],
      ["ArrowDown", names[1]],
      ["ArrowUp", names[0]],
      ["ArrowUp", names.at(-1)],
    ]) {
      await tab.keyboard.press(key ?? "");
      expect(await tab.evaluate(() => document.activeElement?.querySelector("span")?.textContent)).toBe(name);
    }
    await tab.keyboard.press("Escape");
    expect(await summary.evaluate((element) => element === document.activeElement)).toBe(true);
    expect(tab.url()).toBe(before);
    await tab.close();
  });

  it("has each key once, with a name", async () => {
    const { tab } = await served.open();
    await tab.keyboard.press("?");
    const keys = (await tab.locator(".help dt").allTextContents())
      .flatMap((text) => text.split(", "))
      .filter((key) => key.length > 0 && !/click|Enter/.test(key));
    expect(new Set(keys).size, keys.join(" ")).toBe(keys.length);
    await tab.close();
  });

  it("shows an introduction on first use, which blocks no key, and again from the menu", async () => {
    const { tab } = await served.open("", {}, true);
    const tour = tab.getByRole("dialog", { name: "Objects, not thresholds" });
    expect(await tour.isVisible()).toBe(true);
    await tab.keyboard.press("b"); // keys work behind it
    await tab.getByRole("button", { name: "Next (1 of 4)" }).click();
    expect(await tab.locator(".tour h2").textContent()).toContain("own isovalue");
    await tab.keyboard.press("Escape");
    expect(await tab.locator(".tour").isVisible()).toBe(false);
    await tab.reload();
    await tab.waitForSelector(".objects li");
    expect(await tab.locator(".tour").isVisible()).toBe(false);
    await tab.locator(".menus summary", { hasText: "Help" }).click();
    await tab.getByRole("button", { name: "Introduction" }).click();
    for (const step of ["Next (1 of 4)", "Next (2 of 4)", "Next (3 of 4)", "Done"])
      await tab.getByRole("button", { name: step, exact: true }).click();
    expect(await tab.locator(".tour").isVisible()).toBe(false);
    await tab.close();
  });

  it("has a light and a dark theme, and remembers the choice", async () => {
    const { tab } = await served.open("", { colorScheme: "light" });
    const paper = (): Promise<string> => tab.evaluate(() => getComputedStyle(document.body).backgroundColor);
    const light = await paper();
    await tab.keyboard.press("d"); // light, whatever the system has
    expect(await paper()).toBe(light);
    await tab.keyboard.press("d");
    const dark = await paper();
    expect(dark).not.toBe(light);
    await tab.reload();
    await tab.waitForSelector(".objects li");
    expect(await paper()).toBe(dark);
    await tab.keyboard.press("s");
    expect(await tab.locator(".export code").textContent()).toContain("--background dark");
    await tab.close();
  });

  it("fits a phone", async () => {
    const { tab } = await served.open("", { viewport: { width: 390, height: 844 } });
    expect(await tab.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(390);
    for (const part of [".viewport", ".axis", ".inspector", ".side"]) {
      const box = await tab.locator(part).boundingBox();
      expect(box?.width, part).toBeGreaterThan(380);
    }
    expect(await violations(tab)).toEqual([]);
    await tab.close();
  });
});
