// The bundled page in a browser, opened from disk. Skipped where there is no Chromium.
import { existsSync, mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { chromium, type Browser, type Page as Tab } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import type { Label, LabelPage } from "../src/page/labels";
import type { Page, Smoothed } from "../src/shared/page";
import { branch, entry, page, scene } from "./sample";
import { stableBox } from "./viewer_harness";

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

  async function open(data: Page | LabelPage | null, hash = ""): Promise<{ tab: Tab; problems: string[] }> {
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

  it("begins with five pictures, and has two columns on a phone", async () => {
    const many = page(
      Array.from({ length: 9 }, (_, i) => branch({ id: i, rank: i, appears: 90 - i })),
      Array.from({ length: 9 }, (_, i) => entry({ branch: i, id: i, picture: { image: pixel, frames: 1, side: 4 } })),
    );
    many.notes = ["-999 looks like a fill value"];
    const { tab, problems } = await open(many);
    await tab.setViewportSize({ width: 1400, height: 900 });
    const boxes = await Promise.all((await tab.locator(".card .turntable").all()).map((picture) => picture.boundingBox()));
    expect(boxes.slice(0, 5).map((box) => box!.y + box!.height < 500 && box!.y === boxes[0]!.y)).toEqual(Array(5).fill(true));
    const chart = (await tab.locator(".overview").boundingBox())!;
    expect([chart.y > boxes[4]!.y, chart.y < boxes[5]!.y]).toEqual([true, true]);
    const above = await tab.evaluate(() => {
      const main = document.querySelector("main") as HTMLElement;
      return main.innerText.slice(0, main.innerText.indexOf("Object 1"));
    });
    expect(above.match(/\d+/g)?.length ?? 0).toBeLessThanOrEqual(5);
    expect(await tab.locator("body").innerText()).not.toContain("--top");
    await tab.getByRole("link", { name: "How it was read" }).click();
    expect(await tab.locator(".about").innerText()).toContain("-999 looks like a fill value");
    await tab.setViewportSize({ width: 390, height: 844 });
    const places = (): Promise<number[][]> =>
      tab.evaluate(() =>
        [...document.querySelectorAll(".card")].map((one) => one.getBoundingClientRect()).map(({ x, y }) => [x, y]),
      );
    const isTwoColumns = async (): Promise<boolean> => {
      const [left, right, below] = await places(); // the page is laid out anew
      if (!left || !right || !below) return false;
      return left[1] === right[1] && right[0]! > left[0]! && below[0] === left[0] && below[1]! > left[1]!;
    };
    await expect.poll(isTwoColumns).toBe(true);
    expect(await tab.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(390);
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
    const box = await stableBox(picture);
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

  it("has one card for an object that looks the same, and folds the outline of the scanned field away", async () => {
    const same = page(
      [branch({}), branch({ merges: 20 })],
      [
        entry({ number: 1, card: 1, background: true, tau: 10 }),
        entry({ number: 2, card: 2, tau: 30 }),
        entry({ number: 3, card: 2, tau: 50, overlap: 0.8 }),
        entry({ branch: 1, number: 4, card: 4, tau: 40 }),
      ],
    );
    const { tab, problems } = await open(same);
    const titles = (where: string): Promise<string[]> => tab.locator(`${where} .card .title`).allTextContents();
    expect(await titles("section")).toEqual(["Object 2", "Object 4"]);
    expect(await titles(".field")).toEqual(["Object 1"]);
    expect(await tab.locator(".field .card").isVisible()).toBe(false);
    expect(await tab.locator(".range .further").count()).toBe(1);
    await tab.getByRole("button", { name: "50 (object 3)" }).click();
    expect(await tab.getByRole("dialog", { name: "Object 3" }).textContent()).toContain("Object 2 at 30");
    await tab.keyboard.press("Escape");
    await tab.locator(".field summary").click();
    expect(await tab.locator(".field .card").isVisible()).toBe(true);
    expect(problems).toEqual([]);
    await tab.close();
    const alone = await open(page([branch({})], [entry({ number: 1, card: 1, background: true })]));
    expect(await alone.tab.locator(".field .card").isVisible()).toBe(true);
    await alone.tab.close();
  });

  it("shows a smoothed picture beside the noisy one", async () => {
    const noisy = page([branch({})], [entry({})]);
    const shown = (objects: number): Smoothed => ({ objects, tunnels: 2 * objects, picture: { image: pixel, frames: 1, side: 1 } });
    const command = "isoatlas scan.nrrd --gaussian 1 -o scan.smooth.html";
    noisy.smoothing = { noisePart: 0.0462, sigma: 1, command, comparison: { tau: 50, asItIs: shown(594), smooth: shown(14) } };
    const { tab, problems } = await open(noisy);
    expect(await tab.locator(".smoothing").textContent()).toContain("4.6 % of the range");
    expect(await tab.locator(".smoothing code").textContent()).toBe(command);
    expect(await tab.locator(".smoothing figcaption").allTextContents()).toEqual([
      "as it is 594 objects, 1,188 tunnels",
      "smoothed with --gaussian 1 14 objects, 28 tunnels",
    ]);
    expect(await tab.locator(".smoothing img").count()).toBe(2);
    expect(problems).toEqual([]);
    await tab.close();
    noisy.smoothing.comparison = null;
    const without = await open(noisy);
    expect(await without.tab.locator(".smoothing figure").count()).toBe(0);
    await without.tab.close();
  });

  it("has a card for each label of a label volume", async () => {
    const label = (changes: Partial<Label>): Label => ({
      ...{ label: 1, name: null, voxels: 10, measure: 20, components: 1, tunnels: 0, cavities: 0, colour: "#56b4e9" },
      picture: { image: pixel, frames: 4, side: 1 },
      commands: [{ name: "surface", line: "isoatlas extract a.nrrd --object 1 -o label-1.ply" }],
      ...changes,
    });
    const labels: LabelPage = {
      schema: "isoatlas/label-page/1",
      version: "0.2.0",
      volume: { name: "organs.seg.nrrd", size: [10, 20, 30], type: "uint8", spacing: [1, 1, 2], unit: "mm" },
      notes: ["the samples look like labels"],
      interpolant: "trilinear",
      background: 5000,
      labels: [label({ label: 5, name: "liver", voxels: 600, measure: 1200 }), label({ label: 2, tunnels: 3, picture: null })],
    };
    const { tab, problems } = await open(labels);
    expect(await tab.title()).toBe("organs.seg.nrrd – labels");
    expect(await tab.locator(".card h3").allTextContents()).toEqual(["liver", "Label 2"]);
    expect(await tab.locator(".card").first().textContent()).toContain("1.2 cm³");
    expect(await tab.locator(".card").first().textContent()).toContain("600 (10 %)");
    await tab.selectOption("select[name=order]", "label");
    expect(await tab.locator(".card h3").allTextContents()).toEqual(["Label 2", "liver"]);
    expect(await tab.locator(".about").textContent()).toContain("the samples look like labels");
    await tab.locator(".card .commands summary").first().click();
    expect(await tab.locator(".card code").first().textContent()).toContain("--object 1");
    await tab.setViewportSize({ width: 360, height: 700 });
    expect(await tab.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(360);
    expect(problems).toEqual([]);
    await tab.close();
  });

  it("fits a phone", async () => {
    const { tab } = await open(scene);
    await tab.setViewportSize({ width: 360, height: 700 });
    await tab.locator('.overview[viewBox^="0 0 430"]').waitFor(); // drawn anew, or its letters would be too small
    expect(await tab.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(360);
    await tab.close();
  });
});
