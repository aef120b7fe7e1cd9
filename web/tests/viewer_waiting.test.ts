// The page before its store is built: progress, errors, and loss of the connection.
import { describe, expect, it } from "vitest";
import { canServe, Served } from "./viewer_harness";

describe.skipIf(!canServe)("the viewer before its store is built", () => {
  it("shows the progress of the build, then the atlas, without a reload", async () => {
    const slow = ["--threads", "1"]; // enough to be seen; no budget, which a sanitizer exceeds by itself
    const served = await Served.building(["noise", "--size", "144", "--quantise", "8"], slow);
    const tab = await served.browser.newPage();
    tab.setDefaultTimeout(600_000); // on a busy machine, under a sanitizer
    const titles: string[] = [];
    await tab.exposeFunction("heard", (text: string) => titles.push(text));
    await tab.addInitScript(() => {
      new MutationObserver(() => {
        const title = document.querySelector(".waiting h1")?.textContent;
        if (title) void (window as unknown as { heard: (text: string) => void }).heard(title);
      }).observe(document, { childList: true, subtree: true, characterData: true });
    });
    await tab.goto(await served.address());
    await tab.waitForSelector(".objects");
    expect(titles.some((title) => /^building \d+ %$/.test(title))).toBe(true);
    expect(await tab.locator(".waiting").count()).toBe(0);
    await served.close();
  }, 600_000);

  it("shows why a build has failed, and what to do", async () => {
    const served = await Served.building(["demo"], ["--gaussian", "1e9"]);
    const tab = await served.browser.newPage();
    await tab.goto(await served.address());
    const alert = tab.getByRole("alert");
    await alert.waitFor();
    expect(await alert.textContent()).toContain("Next:");
    await served.close();
  });

  it("shows that the connection is lost, and keeps its content", async () => {
    const served = await Served.phantom("demo");
    const { tab } = await served.open();
    served.end();
    await tab.getByText("isoatlas view has ended").waitFor();
    expect(await tab.locator(".objects li").count()).toBeGreaterThan(0);
    await tab.getByRole("button", { name: /^Object 3/ }).first().click(); // not loaded
    await tab.getByText("no connection").first().waitFor();
    const box = tab.getByRole("textbox", { name: "isovalue" });
    await box.fill("200");
    await box.press("Enter");
    const text = await tab.locator("body").innerText();
    for (const wrong of ["Failed to fetch", "does not exist"]) expect(text).not.toContain(wrong);
    expect(text.match(/isoatlas view has ended/g)).toHaveLength(1);
    await tab.locator("summary", { hasText: "Tools" }).click({ timeout: 10_000 }); // the message covers no menu
    await served.close();
  });
});
