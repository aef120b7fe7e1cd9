// Names of objects, and files of everything that is shown; compared with the command line.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import type { Page as Tab } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { canServe, Served } from "./viewer_harness";

describe.skipIf(!canServe)("names and numbers of objects", () => {
  let served: Served;
  beforeAll(async () => {
    served = await Served.phantom("demo", "--size", "40");
  });
  afterAll(() => served?.close());

  const title = (tab: Tab) => tab.locator(".object h2");
  const rename = async (tab: Tab, name: string): Promise<void> => {
    await title(tab).dblclick();
    await tab.getByRole("textbox", { name: "name of the object" }).fill(name);
    await tab.keyboard.press("Enter");
  };

  it("are given by a double click, and known to the command line and after a reload", async () => {
    const { tab, problems } = await served.open();
    await tab.locator(".card .picture").nth(1).click();
    const number = Number((await title(tab).innerText()).replace("Object ", ""));
    await rename(tab, "big ball");
    await expect.poll(() => title(tab).innerText()).toBe("big ball");
    expect(await tab.locator(".card.selected b").innerText()).toBe("big ball");
    const { names } = JSON.parse(served.isoatlas("name", served.store, "--json")) as { names: { name: string; number: number }[] };
    expect(names).toMatchObject([{ name: "big ball", number }]);
    await tab.reload();
    await expect.poll(() => title(tab).innerText()).toBe("big ball");
    await tab.keyboard.press("F2");
    await tab.keyboard.press("Escape");
    expect(await title(tab).isVisible()).toBe(true);
    await rename(tab, "v3");
    await expect.poll(() => tab.locator(".message").innerText()).toContain("number of an object");
    expect(await title(tab).innerText()).toBe("big ball");
    await rename(tab, "");
    await expect.poll(() => title(tab).innerText()).toBe(`Object ${number}`);
    expect(problems.filter((text) => !text.includes("400"))).toEqual([]);
    await tab.close();
  });

  it("stand in the file of everything that is shown, as on the command line", async () => {
    const { tab, problems } = await served.open();
    await tab.locator(".card .picture").nth(1).click();
    await tab.locator(".card").nth(3).getByRole("checkbox").check();
    const titles = await tab.locator(".card b").allInnerTexts();
    const shown = [titles[1] ?? "", titles[3] ?? ""].map((text) => text.replace("Object ", ""));
    await tab.keyboard.press("s");
    for (const [button, format, verb] of [
      ["Save all surfaces", "glb", "extract"],
      ["Save all labels", "seg.nrrd", "label"],
    ] as const) {
      const [download] = await Promise.all([tab.waitForEvent("download"), tab.getByRole("button", { name: button }).click()]);
      expect(download.suggestedFilename()).toMatch(new RegExp(`\\.${format.replace(".", "\\.")}$`));
      const file = join(served.folder, `saved.${format}`);
      await download.saveAs(file);
      served.isoatlas(verb, served.store, "--object", ...shown, "-o", `same.${format}`, "--quiet");
      expect(readFileSync(file).equals(readFileSync(join(served.folder, `same.${format}`)))).toBe(true);
    }
    expect(problems).toEqual([]);
    await tab.close();
  });
});
