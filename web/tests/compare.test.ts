// The page of `isoatlas compare`, opened from disk without a network. Skipped without Chromium or isoatlas.
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import AxeBuilder from "axe-core";
import { chromium, type Browser, type Page as Tab } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";

const browserFile = ["/usr/bin/chromium", "/usr/bin/chromium-browser"].find((file) => existsSync(file));
const cli = process.env.ISOATLAS_CLI ?? "";

describe.skipIf(!browserFile || !existsSync(cli))("the page of compare", () => {
  const folder = mkdtempSync(join(tmpdir(), "isoatlas-compare-"));
  const name = `${"a_long_name_without_a_place_to_break_".repeat(4)}.nrrd`; // in the title, in the command
  const problems: string[] = [];
  let browser: Browser;
  let tab: Tab;
  beforeAll(async () => {
    execFileSync(cli, ["phantom", "noise", "--size", "10", "-o", name, "--quiet"], { cwd: folder });
    const growth = ["--isovalues", "4", "--sizes", "3"];
    execFileSync(cli, ["compare", name, "--tau", "0.5", "--methods", "all", ...growth, "-o", "compare.html", "--quiet"], { cwd: folder });
    browser = await chromium.launch({ executablePath: browserFile, args: ["--no-sandbox"] });
    tab = await browser.newPage({ viewport: { width: 1400, height: 900 } });
    await tab.context().setOffline(true);
    tab.on("pageerror", (error) => problems.push(error.message));
    tab.on("console", (message) => message.type() === "error" && problems.push(message.text()));
    tab.on("request", (request) => /^(file|data):/.test(request.url()) || problems.push(`asked for ${request.url()}`));
    await tab.goto(`file://${join(folder, "compare.html")}`);
  });
  afterAll(async () => {
    await browser?.close();
    rmSync(folder, { recursive: true });
  });
  const widthNeeded = (): Promise<number> => tab.evaluate(() => document.documentElement.scrollWidth);

  it("loads nothing from elsewhere", async () => {
    expect(await tab.title()).toContain("a_long_name");
    const sections = ["Surfaces", "Surfaces in numbers", "Volume rendering", "Active cells", "How it grows", "What the methods do"];
    expect(await tab.locator("h2").allTextContents()).toEqual(sections);
    expect(problems).toEqual([]);
  });

  it("shows every picture, and says what it shows", async () => {
    const pictures = await tab.locator("img").evaluateAll((all) =>
      all.map((one) => one as HTMLImageElement).map(({ complete, naturalWidth, alt }) => ({ isDrawn: complete && naturalWidth > 0, alt })),
    );
    expect(pictures.length).toBeGreaterThanOrEqual(18); // ray casting, methods that make surfaces, optical models, projections
    expect(pictures.filter(({ isDrawn, alt }) => !isDrawn || !alt.includes(":"))).toEqual([]);
    expect(new Set(pictures.map(({ alt }) => alt)).size).toBe(pictures.length);
    expect(pictures.find(({ alt }) => alt.startsWith("Marching Cubes of 1987"))?.alt).toMatch(/\d triangles; .*edges of holes/);
    const plots = await tab.locator("svg[role=img]").evaluateAll((all) => all.map((one) => one.getAttribute("aria-label") ?? ""));
    expect(plots.filter((label) => / over /.test(label)).length).toBeGreaterThanOrEqual(2);
  });

  it("has tables with a caption and a header for every row and column", async () => {
    const tables = await tab.locator("table").evaluateAll((all) =>
      all.map((one) => ({
        caption: one.querySelector("caption")?.textContent ?? "",
        columns: one.querySelectorAll("thead th[scope=col]").length,
        wrong: [...one.querySelectorAll("tbody tr")].filter((row) => !row.querySelector("th[scope=row]")).length,
        cells: [...one.querySelectorAll("tbody tr")].map((row) => row.children.length),
      })),
    );
    expect(tables.length).toBeGreaterThanOrEqual(4);
    for (const { caption, columns, wrong, cells } of tables) {
      expect(caption).not.toBe("");
      expect(wrong, caption).toBe(0);
      expect(cells, caption).toEqual(cells.map(() => columns));
    }
  });

  it("leads from a method to what it does", async () => {
    const link = tab.locator("table a", { hasText: "Marching Cubes 33" }).first();
    const target = (await link.getAttribute("href"))!;
    await link.click();
    await expect.poll(() => tab.evaluate(() => location.hash)).toBe(target);
    expect(await tab.locator(target).evaluate((one) => one.closest("section")?.textContent)).toContain("Chernyaev");
    const broken = await tab.locator("a[href^='#']").evaluateAll((all) =>
      all.map((one) => one.getAttribute("href")!).filter((href) => !document.getElementById(href.slice(1))),
    );
    expect(broken).toEqual([]);
  });

  for (const [colorScheme, width] of [
    ["light", 1400],
    ["dark", 1400],
    ["light", 390],
    ["dark", 390],
  ] as const)
    it(`violates no rule of axe-core and needs no sideways scrolling, ${colorScheme}, ${width} pixels wide`, async () => {
      await tab.emulateMedia({ colorScheme });
      await tab.setViewportSize({ width, height: 844 });
      await expect.poll(() => tab.evaluate(() => innerWidth)).toBe(width);
      const paper = await tab.evaluate(() => getComputedStyle(document.body).backgroundColor.match(/\d+/g)!.map(Number));
      expect(paper.every((part) => (colorScheme === "dark" ? part < 64 : part > 192))).toBe(true);
      await tab.locator("details").evaluateAll((all) => all.forEach((one) => ((one as HTMLDetailsElement).open = true)));
      expect(await widthNeeded()).toBeLessThanOrEqual(width);
      await tab.evaluate(AxeBuilder.source);
      const violations = await tab.evaluate(async () => {
        const { axe } = globalThis as unknown as { axe: { run(): Promise<{ violations: { id: string; nodes: { html: string }[] }[] }> } };
        return (await axe.run()).violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html.slice(0, 160)).join(" ")}`);
      });
      expect(violations).toEqual([]);
    });

  it("has asked for nothing by the end", () => expect(problems).toEqual([]));
});
