// The viewer in a frame of a page of another origin, as a notebook has it, also below the path of a proxy; the scene that it shares.
import { createServer, request, type Server } from "node:http";
import type { AddressInfo } from "node:net";
import type { Frame, Page as Tab } from "playwright-core";
import { afterAll, afterEach, beforeAll, describe, expect, it } from "vitest";
import { canServe, Served } from "./viewer_harness";

const PREFIX = "/user/a/proxy/1";

interface Scene {
  shown: { entry: number; id: number | null; tau: number; name?: string }[];
  selected: number;
}

/** Listens on the name localhost: another origin than that of the viewer. */
async function listening(server: Server): Promise<string> {
  await new Promise<void>((resolve) => server.listen(0, "localhost", resolve));
  return `http://localhost:${(server.address() as AddressInfo).port}`;
}

/** A page that has the frame of the address of its query. */
const notebook = (): Server =>
  createServer((asked, answer) => {
    const frame = new URL(asked.url ?? "", "http://localhost").searchParams.get("frame") ?? "";
    answer.setHeader("Content-Type", "text/html");
    answer.end(`<!doctype html><title>a notebook</title><iframe src="${frame}" width="950" height="600"></iframe>`);
  });

/** Forwards what is below PREFIX, with the Host of the browser, as jupyter-server-proxy does. */
const proxy = (origin: string): Server =>
  createServer((asked, answer) => {
    if (!asked.url?.startsWith(`${PREFIX}/`)) return void answer.writeHead(404).end();
    const { port } = new URL(origin);
    const options = { host: "127.0.0.1", port, path: asked.url.slice(PREFIX.length), method: asked.method, headers: asked.headers };
    const forwarded = request(options, (told) => {
      answer.writeHead(told.statusCode ?? 500, told.headers);
      told.pipe(answer);
    });
    forwarded.on("error", () => answer.destroy());
    answer.on("close", () => forwarded.destroy());
    asked.pipe(forwarded);
  });

describe.skipIf(!canServe)("the viewer in a frame", () => {
  let served: Served;
  let around = "";
  let proxied = "";
  const servers: Server[] = [];
  const tabs: Tab[] = [];

  beforeAll(async () => {
    served = await Served.phantom("demo", "--size", "64");
    servers.push(notebook(), proxy(served.origin));
    [around = "", proxied = ""] = await Promise.all(servers.map(listening));
  });
  afterEach(async () => {
    for (const tab of tabs.splice(0)) await tab.close();
  });
  afterAll(async () => {
    servers.forEach((server) => server.closeAllConnections());
    servers.forEach((server) => server.close());
    await served?.close();
  });

  const asked = async (path: string, options: RequestInit = {}): Promise<Response> =>
    fetch(served.origin + path, { ...options, headers: { Authorization: `Bearer ${served.token}` } });
  const scene = async (): Promise<Scene | null> => ((await (await asked("/api/scene")).json()) as { scene: Scene | null }).scene;
  const setScene = async (to: unknown): Promise<void> => {
    expect((await asked("/api/scene", { method: "PUT", body: JSON.stringify(to) })).status).toBe(200);
  };
  const setTau = async (tau: number): Promise<void> => {
    const now = (await scene()) as Scene;
    await setScene({ ...now, shown: now.shown.map((one, i) => (i === now.selected ? { ...one, tau } : one)) });
  };
  const address = async (): Promise<string> => ((await (await asked("/api/address?for=frame")).json()) as { address: string }).address;

  const opened = async (frame: string): Promise<{ frame: Frame; tab: Tab; problems: string[] }> => {
    const tab = await served.browser.newPage({ viewport: { width: 1000, height: 700 } });
    tabs.push(tab);
    const problems: string[] = [];
    tab.on("pageerror", (error) => problems.push(error.message));
    const isHarmless = (text: string): boolean => /409 \(Conflict\)|Blocked autofocusing/.test(text); // superseded; focus is the notebook's
    tab.on("console", (said) => said.type() === "error" && !isHarmless(said.text()) && problems.push(said.text()));
    await tab.goto(`${around}/?frame=${encodeURIComponent(frame)}`);
    const inner = await (await tab.waitForSelector("iframe")).contentFrame();
    if (!inner) throw new Error("no frame");
    return { frame: inner, tab, problems };
  };
  const tauOf = (frame: Frame): Promise<string> => frame.getByRole("textbox", { name: "isovalue" }).inputValue();
  const isDrawn = (frame: Frame): Promise<void> =>
    expect.poll(() => frame.locator(".scene .state").allTextContents()).toEqual([expect.stringMatching(/triangles$/)]);

  const ways: [string, () => Promise<string>][] = [
    ["of its server", address],
    ["of a proxy, with another name and below a path", async () => (await address()).replace(served.origin, proxied + PREFIX)],
  ];
  for (const [name, where] of ways) {
    it(`draws, is changed from outside, and tells its changes: at the address ${name}`, async () => {
      const { frame, problems } = await opened(await where());
      await isDrawn(frame);
      await expect.poll(async () => (await scene())?.shown[0]?.tau).toBe(Number(await tauOf(frame)));

      await setTau(120.5);
      await expect.poll(() => tauOf(frame)).toBe("120.5");
      await isDrawn(frame);

      await frame.getByRole("textbox", { name: "isovalue" }).fill("130");
      await frame.getByRole("textbox", { name: "isovalue" }).press("Enter");
      await expect.poll(async () => (await scene())?.shown[0]?.tau).toBe(130);
      expect(await frame.evaluate(() => document.cookie)).toBe("");
      expect(await frame.locator("meta[name=isoatlas-frame]").count()).toBe(0);
      expect(problems).toEqual([]);
    });
  }

  it("shares its scene with other frames; a tab begins with it and shares nothing", async () => {
    const [first, second] = [await opened(await address()), await opened(await address())];
    await isDrawn(first.frame);
    await isDrawn(second.frame);
    await setTau(111);
    await expect.poll(() => tauOf(first.frame)).toBe("111");
    await expect.poll(() => tauOf(second.frame)).toBe("111");
    await first.frame.getByRole("textbox", { name: "isovalue" }).fill("112");
    await first.frame.getByRole("textbox", { name: "isovalue" }).press("Enter");
    await expect.poll(() => tauOf(second.frame)).toBe("112");
    await expect.poll(async () => (await scene())?.shown[0]?.tau).toBe(112);

    const { tab } = await served.open();
    tabs.push(tab);
    await expect.poll(() => tab.getByRole("textbox", { name: "isovalue" }).inputValue()).toBe("112");
    await setTau(113);
    await expect.poll(() => tauOf(first.frame)).toBe("113");
    expect(await tab.getByRole("textbox", { name: "isovalue" }).inputValue()).toBe("112");
  });

  it("says why it shows something else than was set", async () => {
    const { frame } = await opened(await address());
    await isDrawn(frame);
    const before = (await scene()) as Scene;
    await setScene({ ...before, shown: [{ ...before.shown[0], id: 1 }] });
    await frame.getByText("the scene is of another volume").waitFor();
    await expect.poll(scene).toEqual(before);
  });

  it("is shown once, and says what to do", async () => {
    const once = await address();
    const { frame } = await opened(once);
    await isDrawn(frame);
    const again = await opened(once);
    await again.frame.getByText("Run the cell of the notebook again").waitFor();
  });

  it("is not shown at the addresses of tabs", async () => {
    const { problems } = await opened(await served.address());
    await expect.poll(() => problems.join()).toContain("frame-ancestors 'none'");
  });
});
