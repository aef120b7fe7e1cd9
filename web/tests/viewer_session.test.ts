// A first session: open, isolate the largest object, change its isovalue, ghost the others, export, copy the link, restore.
// By mouse and by keyboard alone; on a phantom and, where it exists, on a scan of a tooth. Screenshots are kept for
// inspection.
import { existsSync, mkdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import type { Page as Tab } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { canServe, meshes, Served } from "./viewer_harness";

const tooth = join(process.env.ISOATLAS_DATA ?? "nowhere", "tooth/tooth.nrrd");
const pictures = process.env.ISOATLAS_SCREENSHOTS ?? "";
const permissions = ["clipboard-read", "clipboard-write"];

interface Listed {
  id: number;
  best_tau: number;
  voxels: number;
  number: number;
  note: string;
  like: { line: number } | null;
}

/** Steps of the session, by mouse or keys. */
interface InputDevice {
  name: string;
  /** isolates an entry of the list */
  choose(tab: Tab, title: string): Promise<void>;
  add(tab: Tab, title: string): Promise<void>;
  /** selects an object of the scene */
  select(tab: Tab, title: string): Promise<void>;
  type(tab: Tab, tau: number): Promise<void>;
  ghost(tab: Tab): Promise<void>;
  exportStl(tab: Tab): Promise<void>;
  copyLink(tab: Tab): Promise<void>;
}

const item = (tab: Tab, title: string) =>
  tab
    .locator(".side")
    .getByRole("button", { name: new RegExp(`^${title}\\b`) })
    .first();

/** Presses Tab until the element has the focus. */
async function tabTo(tab: Tab, isLoaded: () => Promise<boolean>): Promise<void> {
  for (let i = 0; i < 150; ++i) {
    if (await isLoaded()) return;
    await tab.keyboard.press("Tab");
  }
  throw new Error("Tab does not get there");
}

function focused(tab: Tab, selector: string, text: RegExp): () => Promise<boolean> {
  return () =>
    tab.evaluate(
      ([selector, source]) => {
        const { activeElement } = document;
        const name = activeElement?.getAttribute("aria-label") ?? activeElement?.textContent ?? "";
        return activeElement?.closest(selector) != null && new RegExp(source).test(name);
      },
      [selector, text.source] as const,
    );
}

const mouse: InputDevice = {
  name: "mouse",
  choose: (tab, title) => item(tab, title).click(),
  add: (tab, title) => item(tab, title).click({ modifiers: ["Shift"] }),
  select: (tab, title) =>
    tab
      .locator(".scene")
      .getByRole("button", { name: new RegExp(`^Select ${title} `) })
      .click(),
  async type(tab, tau) {
    await tab.getByRole("textbox", { name: "isovalue" }).fill(String(tau));
    await tab.getByRole("textbox", { name: "isovalue" }).press("Enter");
  },
  ghost: (tab) => tab.getByRole("button", { name: "Ghost others" }).click(),
  async exportStl(tab) {
    await tab.locator(".menus summary", { hasText: "Export" }).click();
    await tab.getByRole("button", { name: "Surface as STL" }).click();
  },
  async copyLink(tab) {
    await tab.locator(".menus summary", { hasText: "Export" }).click();
    await tab.getByRole("button", { name: /Copy link/ }).click();
  },
};

const keyboard: InputDevice = {
  name: "keyboard",
  async choose(tab, title) {
    await tabTo(tab, focused(tab, ".side", new RegExp(`^${title}\\b`)));
    await tab.keyboard.press("Enter");
  },
  async add(tab, title) {
    await tabTo(tab, focused(tab, ".side", new RegExp(`^show ${title.toLowerCase()}$`)));
    await tab.keyboard.press("Space");
  },
  async select(tab) {
    await tab.keyboard.press(".");
  },
  async type(tab, tau) {
    await tabTo(tab, focused(tab, ".axis", /^isovalue$/));
    await tab.keyboard.press("Control+a");
    await tab.keyboard.type(String(tau));
    await tab.keyboard.press("Enter");
    await tab.keyboard.press("Tab");
  },
  async ghost(tab) {
    await tabTo(tab, focused(tab, ".inspector", /./));
    await tab.keyboard.press("g");
  },
  async exportStl(tab) {
    await tab.keyboard.press("s");
    await tabTo(tab, focused(tab, ".export", /^Save the surface$/));
    await tab.keyboard.press("Enter");
    await tab.keyboard.press("Escape");
  },
  copyLink: (tab) => tab.keyboard.press("l"),
};

const volumes: [name: string, there: boolean, serve: () => Promise<Served>][] = [
  ["demo", true, () => Served.phantom("demo")],
  ["tooth", existsSync(tooth), () => Served.file(tooth)],
];

for (const [volume, there, serve] of volumes) {
  describe.skipIf(!canServe || !there)(`a first session with ${volume}`, () => {
    let served: Served;
    let listed: Listed[] = [];

    beforeAll(async () => {
      served = await serve();
    });
    afterAll(() => served?.close());

    const keepPicture = async (tab: Tab, name: string): Promise<void> => {
      if (!pictures) return;
      mkdirSync(pictures, { recursive: true });
      await tab.screenshot({ path: join(pictures, `${volume}-${name}.png`) });
    };
    const extracted = (id: number, tau: number): number => {
      const words = ["extract", served.store, "--object", `v${id}`, "--tau", String(tau), "-o", "asked.stl", "--json"];
      return (JSON.parse(served.isoatlas(...words)) as { triangles: number }).triangles;
    };

    for (const hand of [mouse, keyboard]) {
      it(`by ${hand.name}`, async () => {
        const { tab, problems } = await served.open("", { viewport: { width: 1280, height: 800 }, permissions });
        const step = (name: string): Promise<void> => keepPicture(tab, `${hand.name}-${name}`);
        listed = (JSON.parse(served.isoatlas("objects", served.store, "--json")) as { objects: Listed[] }).objects;
        const cards = listed.filter(({ like, note }) => like === null && !note.startsWith("outline")); // the scanned field is folded
        const largest = cards.reduce((most, object, i) => (object.voxels > (cards[most]?.voxels ?? 0) ? i : most), 0);
        const object = cards[largest] as Listed;
        const title = `Object ${object.number}`;
        const other = `Object ${cards[(largest + 1) % cards.length]?.number}`;
        const note = (): Promise<string[]> => tab.locator(".scene .state").allTextContents();
        await expect.poll(note).toEqual([expect.stringMatching(/triangles$/)]);
        await step("1-opened");

        const seen = meshes(tab);
        await hand.choose(tab, title);
        await expect
          .poll(note)
          .toEqual([expect.stringContaining(`${extracted(object.id, object.best_tau).toLocaleString("en")} triangles`)]);
        expect(await tab.getByRole("textbox", { name: "isovalue" }).inputValue()).toBe(String(Number(object.best_tau.toPrecision(7))));
        await step("2-isolated");

        const tau = Number((object.best_tau * 1.1).toPrecision(4));
        await hand.type(tab, tau);
        const triangles = extracted(object.id, tau);
        await expect.poll(note).toEqual([expect.stringContaining(`${triangles.toLocaleString("en")} triangles`)]);
        expect(seen.at(-1)?.asked.get("tau")).toBe(String(tau));
        const { objects } = JSON.parse(served.isoatlas("objects", served.store, "--tau", String(tau), "--json")) as { objects: unknown[] };
        await expect.poll(() => tab.locator(".badge").textContent()).toContain(`${objects.length.toLocaleString("en")} object`);
        await step("3-evolved");

        await hand.add(tab, other);
        await expect.poll(() => tab.locator(".scene li").count()).toBe(2);
        await hand.select(tab, title);
        await hand.ghost(tab);
        expect(await tab.locator('.scene [aria-current="true"] b').textContent()).toBe(title);
        expect(await tab.getByRole("button", { name: "Ghost others" }).getAttribute("aria-pressed")).toBe("true");
        await expect.poll(note).toEqual([expect.stringMatching(/triangles$/), expect.stringMatching(/triangles$/)]);
        await hand.select(tab, other);
        await step("4-ghosts");
        await hand.select(tab, title);

        const [download] = await Promise.all([tab.waitForEvent("download"), hand.exportStl(tab)]);
        const file = join(served.folder, "object.stl");
        await download.saveAs(file);
        expect(readFileSync(file).readUInt32LE(80)).toBe(triangles); // triangles of a binary STL
        expect(served.isoatlas("verify", "object.stl")).toContain("all 8 guarantees hold");

        await hand.copyLink(tab);
        const link = await tab.evaluate(() => navigator.clipboard.readText());
        const restored = await served.open(new URL(link).hash, { viewport: { width: 1280, height: 800 } });
        await expect.poll(() => restored.tab.locator(".scene .state").allTextContents()).toEqual(await note());
        expect(restored.tab.url()).toBe(link);
        await keepPicture(restored.tab, `${hand.name}-5-restored`);
        const drawn = (page: Tab): Promise<string> =>
          page.evaluate(() => document.querySelector<HTMLCanvasElement>(".viewport canvas")?.toDataURL() ?? "");
        await expect.poll(async () => (await drawn(restored.tab)) === (await drawn(tab))).toBe(true); // pixel by pixel
        expect([...problems, ...restored.problems]).toEqual([]);
        await restored.tab.close();
        await tab.close();
      });
    }
  });
}
