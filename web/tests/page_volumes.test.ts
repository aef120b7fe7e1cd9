// Pages of six real volumes, opened from disk without a network. Skipped without Chromium, isoatlas, or the volumes.
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, statSync, symlinkSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, join, resolve } from "node:path";
import { chromium, type Browser, type Locator, type Page as Tab } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { SOFTWARE_DRAWING } from "./viewer_harness";

const browserFile = ["/usr/bin/chromium", "/usr/bin/chromium-browser"].find((file) => existsSync(file));
const cli = process.env.ISOATLAS_CLI ?? "";
const volumes = ["fuel/fuel", "dens40/dens40", "emd3001/emd3001", "nuclei/nuclei", "lung_ct/lung_lo", "frog_labels/frog_labels"].map(
  (name) => join(process.env.ISOATLAS_DATA ?? "", `${name}.nrrd`),
);

for (const volume of volumes)
  describe.skipIf(!browserFile || !existsSync(cli) || !existsSync(volume))(`the page of ${basename(volume)}`, () => {
    const folder = mkdtempSync(join(tmpdir(), "isoatlas-volumes-"));
    const file = join(folder, "a.html");
    const problems: string[] = [];
    let browser: Browser;
    let tab: Tab;
    beforeAll(async () => {
      const named = join(folder, `${"a_long_name_without_a_place_to_break_".repeat(4)}${basename(volume)}`); // on the page, in commands
      symlinkSync(resolve(volume), named);
      execFileSync(cli, [named, "--top", "5", "-o", file, "--quiet"], { cwd: folder });
      browser = await chromium.launch({ executablePath: browserFile, args: ["--no-sandbox", ...SOFTWARE_DRAWING] });
      tab = await browser.newPage({ viewport: { width: 1400, height: 900 } });
      await tab.context().setOffline(true);
      tab.on("pageerror", (error) => problems.push(error.message));
      tab.on("console", (message) => message.type() === "error" && problems.push(message.text()));
      tab.on("request", (request) => /^(file|data|blob):/.test(request.url()) || problems.push(`asked for ${request.url()}`));
      await tab.goto(`file://${file}`);
    });
    afterAll(async () => {
      await browser?.close();
      rmSync(folder, { recursive: true });
    });
    const pictures = (): Locator => tab.locator(".card .turntable:visible");

    it("has five pictures above the fold of 1400 x 900, in at most 5 MB", async () => {
      expect(statSync(file).size).toBeLessThanOrEqual(5_000_000);
      const boxes = await Promise.all((await pictures().all()).map((picture) => picture.boundingBox()));
      expect(boxes.slice(0, 5).map((box) => box!.y + box!.height <= 900)).toEqual(Array(Math.min(5, boxes.length)).fill(true));
    });

    it("has two columns at 390 pixels", async () => {
      await tab.setViewportSize({ width: 390, height: 844 });
      const areSideBySide = async (): Promise<boolean> => {
        const [left, right] = await Promise.all([0, 1].map((i) => pictures().nth(i).boundingBox())); // the page is laid out anew
        return left?.y === right?.y && (left?.x ?? 0) < (right?.x ?? 0);
      };
      await expect.poll(areSideBySide).toBe(true);
      expect(await tab.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(390);
      await tab.setViewportSize({ width: 1400, height: 900 });
    });

    it("turns an object and saves it as a closed surface", async () => {
      await tab.locator(".card").first().locator("a, button").first().click();
      const canvas = tab.locator(".solid canvas");
      await canvas.waitFor();
      const view = (): Promise<string | null> => canvas.getAttribute("data-view");
      await expect.poll(view).toBeTruthy();
      const before = await view();
      await canvas.focus();
      await tab.keyboard.press("ArrowRight");
      await expect.poll(view).not.toBe(before);
      const [download] = await Promise.all([tab.waitForEvent("download"), tab.locator(".save-stl").first().click()]);
      const stl = join(folder, "a.stl");
      await download.saveAs(stl);
      expect(readFileSync(stl).readUInt32LE(80)).toBeGreaterThan(100);
      expect(execFileSync(cli, ["verify", stl, "--quiet"], { encoding: "utf8" })).toContain("all 8 guarantees hold");
    });

    it("has no error and asks for nothing", () => expect(problems).toEqual([]));
  });
