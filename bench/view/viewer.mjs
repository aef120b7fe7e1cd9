// `isoatlas view` and Debian's Chromium, which draws without a graphics card; shared by what measures the page.
import { spawn } from "node:child_process";
import { createRequire } from "node:module";
import { resolve } from "node:path";

/** WEB-BUILD ISOATLAS STORE [NUMBER] of the command line; where they are missing the program ends. */
export function argumentsOf(script, name, usual) {
  const [web, isoatlas, store, number = usual] = process.argv.slice(2);
  if (store) return { web, isoatlas, store, number: Number(number) };
  console.error(`usage: node bench/view/${script} WEB-BUILD ISOATLAS STORE [${name}]`);
  process.exit(2);
}

/** web: where the page was bundled; playwright-core is installed there. */
export function launched(web) {
  const { chromium } = createRequire(resolve(web, "package.json"))("playwright-core");
  const drawing = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
  return chromium.launch({ executablePath: "/usr/bin/chromium", args: drawing });
}

/** A server of a store: the address of its page, and what ends it. */
export async function served(isoatlas, store) {
  const server = spawn(resolve(isoatlas), ["view", store, "--no-browser", "--quiet"]);
  const address = await new Promise((found) => server.stdout.once("data", (bytes) => found(String(bytes).trim())));
  return { address, end: () => server.kill("SIGINT") };
}

/** A tab without the tour. */
export async function tabOf(browser) {
  const tab = await browser.newPage({ viewport: { width: 1280, height: 800 }, bypassCSP: true });
  await tab.addInitScript(() => localStorage.setItem("isoatlas-tour", "seen"));
  return tab;
}

/** Milliseconds in the page's time when the words beside the first object of the scene match; polled every 10 ms. */
export async function said(tab, words) {
  const match = (pattern) => new RegExp(pattern).test(document.querySelector(".scene .state")?.textContent ?? "") && performance.now();
  return (await tab.waitForFunction(match, words, { polling: 10 })).jsonValue();
}

export const share = (numbers, part) => [...numbers].sort((p, q) => p - q)[Math.min(numbers.length - 1, Math.floor(part * numbers.length))];
