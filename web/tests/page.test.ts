// The bundled page in a browser, opened from disk. Skipped where there is no Chromium.
import { existsSync, mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { chromium, type Browser, type Page as Tab } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import type { Page } from "../src/shared/page";
import { branch, entry, page, scene } from "./sample";

const browserFile = ["/usr/bin/chromium", "/usr/bin/chromium-browser"].find((file) => existsSync(file));
const bundled = fileURLToPath(new URL("../dist/atlas.html", import.meta.url));
const pixel =
  "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAQAAAABCAYAAAD5PA/NAAAAE0lEQVR42mNk+M9Qz4AEGBmRBQAvAgQBv9W0VAAAAABJRU5ErkJggg==";

describe.skipIf(!browserFile || !existsSync(bundled))("the page", () => {
  let browser: Browser;
  beforeAll(async () => {
    browser = await chromium.launch({ executablePath: browserFile, args: ["--no-sandbox"] });
  });
  afterAll(() => browser.close());

  async function open(data: Page | null, hash = ""): Promise<{ tab: Tab; problems: string[] }> {
    const json = JSON.stringify(data).replaceAll("<", "\\u003c");
    const file = join(mkdtempSync(join(tmpdir(), "isoatlas-page-")), "a.html");
    writeFileSync(file, readFileSync(bundled, "utf8").replace('json">null<', () => `json">${json}<`));
    const tab = await browser.newPage({ viewport: { width: 1000, height: 900 } });
    const problems: string[] = [];
    tab.on("pageerror", (error) => problems.push(error.message));
    tab.on("console", (message) => message.type() === "error" && problems.push(message.text()));
    tab.on("request", (request) => /^(file|data):/.test(request.url()) || problems.push(`asked for ${request.url()}`));
    await tab.goto(`file://${file}${hash}`);
    return { tab, problems };
  }

  it("shows a card for every object, and loads nothing from elsewhere", async () => {
    const { tab, problems } = await open(scene);
    expect(await tab.title()).toBe("scan – atlas");
    expect(await tab.locator(".card").count()).toBe(4);
    expect(await tab.locator(".overview .mark").count()).toBe(4);
    expect(await tab.locator(".overview .branch").count()).toBe(3);
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("shows more or fewer objects, by keyboard too, and how many are hidden", async () => {
    const { tab, problems } = await open(scene);
    const keep = tab.getByRole("slider", { name: /^Show the/ });
    expect(await keep.inputValue()).toBe("3");
    await keep.focus();
    await tab.keyboard.press("Home");
    expect(await tab.locator(".card .title").allTextContents()).toEqual(["Object 1", "Object 2"]);
    expect(await tab.locator(".overview .branch").count()).toBe(1);
    await tab.keyboard.press("End");
    expect(await keep.getAttribute("aria-valuetext")).toBe("4 of 4 objects");
    expect(await tab.locator(".overview .branch").count()).toBe(4);
    expect(await tab.locator(".others tbody tr").count()).toBe(1);
    await tab.getByRole("button", { name: "Automatic" }).click();
    expect(await keep.inputValue()).toBe("3");
    expect(await tab.locator(".others").count()).toBe(0);
    expect(await tab.locator(".about").textContent()).toContain("1,231 not shown");
    expect(
      await tab.getByRole("img", { name: "1,234 objects without a threshold, 3 in the automatic choice" }).count(),
    ).toBe(1);
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("shows cavities with what encloses them", async () => {
    const old = await open(scene, "#dark-1"); // an address before version 0.2
    expect(await old.tab.getByRole("dialog", { name: "Cavity 1" }).isVisible()).toBe(true);
    await old.tab.close();
    const { tab } = await open(scene, "#cavity-1");
    expect(await tab.locator(".card.cavity").count()).toBe(1);
    expect(await tab.locator(".card.cavity").textContent()).toContain("a cavity of object 1");
    const dialog = tab.getByRole("dialog", { name: "Cavity 1" });
    expect(await dialog.textContent()).toContain("grows with the isovalue");
    await dialog.getByRole("button", { name: "Object 1", exact: true }).click();
    expect(await tab.getByRole("dialog", { name: "Object 1" }).textContent()).toContain("at 30: Object 3");
    expect(await tab.getByRole("dialog").textContent()).toContain("and 40 more objects without a picture");
    await tab.close();
  });

  it("shows counts at an isovalue, by keyboard", async () => {
    const { tab } = await open(scene);
    const at = tab.getByRole("slider", { name: "Isovalue of the counts" });
    await at.focus();
    await tab.keyboard.press("Home");
    expect(await tab.locator(".readout").textContent()).toBe("above 0 up to 25: 1 object, 1 contour, no tunnels, no cavities");
    await tab.keyboard.press("ArrowRight");
    expect(await at.getAttribute("aria-valuetext")).toContain("20 objects, 3 contours, 2 to 5 tunnels, 1 cavity");
    await tab.selectOption("select[name=counted]", "significant");
    expect(await tab.locator(".readout").textContent()).toContain("2 objects");
    await tab.close();
  });

  it("gives every control an accessible name", async () => {
    const { tab } = await open(scene, "#object-1");
    const nameless = await tab.evaluate(() =>
      [...document.querySelectorAll("button, select, input, [tabindex='0'], [role=img], [role=button]")]
        .filter((e) => !(e.getAttribute("aria-label") || e.textContent?.trim() || (e as HTMLInputElement).labels?.length))
        .map((e) => e.outerHTML.slice(0, 80)),
    );
    expect(nameless).toEqual([]);
    await tab.close();
  });

  it("sorts and filters", async () => {
    const { tab } = await open(scene);
    await tab.selectOption("select[name=order]", "size");
    expect(await tab.locator(".card .title").allTextContents()).toEqual(["Object 1", "Object 2", "Cavity 1", "Object 3"]);
    await tab.selectOption("select[name=side]", "cavity");
    expect(await tab.locator(".card").count()).toBe(1);
    expect(await tab.locator(".message").textContent()).toBe("1 of 4 pictures shown");
    await tab.close();
  });

  it("opens an object by click, keyboard and address, and follows links to related objects", async () => {
    const { tab } = await open(scene, "#object-3");
    const dialog = tab.locator("dialog");
    expect(await dialog.locator("h2").textContent()).toBe("Object 3");
    expect(await dialog.locator("code").count()).toBe(1);
    await dialog.getByRole("button", { name: "Object 1", exact: true }).first().click();
    expect(await dialog.locator("h2").textContent()).toBe("Object 1");
    expect(await tab.evaluate(() => location.hash)).toBe("#object-1");
    await tab.keyboard.press("ArrowLeft");
    expect(await dialog.locator("h2").textContent()).toBe("Cavity 1");
    await tab.keyboard.press("Escape");
    expect(await dialog.isVisible()).toBe(false);
    await tab.locator(".overview .mark").nth(1).focus();
    await tab.keyboard.press("Enter");
    expect(await dialog.locator("h2").textContent()).toBe("Object 2");
    await tab.close();
  });

  it("links an isovalue of a wall to its cavity", async () => {
    const { tab } = await open(scene, "#object-1");
    const dialog = tab.locator("dialog");
    const advice = dialog.locator("dd", { hasText: "45: the wall of one of its cavities" });
    await advice.getByRole("button", { name: "Cavity 1" }).click();
    expect(await dialog.locator("h2").textContent()).toBe("Cavity 1");
    await tab.close();
  });

  it("shows the isovalues of tunnels, and whether they are exact", async () => {
    const { tab } = await open(scene, "#object-1");
    const tunnels = tab.locator("dialog .tunnels");
    expect(await tunnels.locator("li").allTextContents()).toEqual(["opens at 80, closes at 20", "opens at 40, closes at 30"]);
    expect(await tunnels.locator(".note").textContent()).toContain("and 1 shorter one. Exact. Some tunnels outlive the object.");
    await tab.close();
  });

  it("turns pictures by keyboard and pointer", async () => {
    const { tab } = await open(page([branch({})], [entry({ picture: { image: pixel, frames: 4, side: 1 } })]));
    const picture = tab.locator(".card .turntable");
    await picture.focus();
    await tab.keyboard.press("ArrowRight");
    expect(await picture.getAttribute("data-frame")).toBe("1");
    const box = (await picture.boundingBox())!;
    await tab.mouse.move(box.x + box.width * 0.9, box.y + box.height / 2);
    expect(await picture.getAttribute("data-frame")).toBe("3");
    await tab.close();
  });

  it("says when there is nothing to show, and escapes names", async () => {
    const nothing = page([], []);
    nothing.volume.name = "</script><b>x";
    nothing.spectrum = null;
    const { tab, problems } = await open(nothing);
    expect(await tab.locator("h1").textContent()).toBe("</script><b>x");
    expect(await tab.locator(".about").textContent()).toContain("No objects to show");
    const constant = page([branch({})], [entry({})]);
    constant.volume.high = constant.volume.low;
    const same = await open(constant);
    expect(await same.tab.locator("main").textContent()).toContain("All samples have the same value");
    expect(await same.tab.locator(".card, .overview").count()).toBe(0);
    await same.tab.close();
    const noise = page([branch({})], [entry({})]);
    noise.volume.noise = 30;
    const noisy = await open(noise);
    expect(await noisy.tab.locator(".about").textContent()).toContain("may be only noise");
    await noisy.tab.close();
    const empty = await open(null);
    expect(await empty.tab.locator("main").textContent()).toContain("no data");
    expect([...problems, ...empty.problems]).toEqual([]);
    await tab.close();
    await empty.tab.close();
  });

  it("fits a phone", async () => {
    const { tab } = await open(scene);
    await tab.setViewportSize({ width: 360, height: 700 });
    await tab.locator('.overview[viewBox^="0 0 430"]').waitFor(); // drawn anew, or its letters would be too small
    expect(await tab.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(360);
    await tab.close();
  });
});
