// How long from opening the page of `isoatlas view` until the first object stands in the picture, coarse and whole. Needs Debian's Chromium.
//
//     node bench/view/first_picture.mjs build/release/web build/release/bin/isoatlas STORE [RUNS]
//
// The first argument is where the page was bundled: playwright-core is installed there. Every run has a server of its own; the store's
// pages are in the system's cache. Milliseconds from the browser's request for the page, drawn without a graphics card.
import { spawn } from "node:child_process";
import { createRequire } from "node:module";
import { resolve } from "node:path";

const [web, isoatlas, store, runs = "5"] = process.argv.slice(2);
if (!store) {
  console.error("usage: node bench/view/first_picture.mjs WEB-BUILD ISOATLAS STORE [RUNS]");
  process.exit(2);
}
const { chromium } = createRequire(resolve(web, "package.json"))("playwright-core");
const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"] });
const middle = (numbers) => [...numbers].sort((p, q) => p - q)[Math.floor(numbers.length / 2)];
const coarse = [], whole = [];
for (let run = 0; run < Number(runs); ++run) {
  const server = spawn(resolve(isoatlas), ["view", store, "--no-browser", "--quiet"]);
  const address = await new Promise((found) => server.stdout.once("data", (bytes) => found(String(bytes).trim())));
  const tab = await browser.newPage({ viewport: { width: 1280, height: 800 }, bypassCSP: true });
  await tab.goto(address, { waitUntil: "commit" });
  const seen = (words) => tab.waitForFunction((pattern) => {
    const state = document.querySelector(".scene .state")?.textContent ?? "";
    return new RegExp(pattern).test(state) && performance.now();
  }, words, { polling: 10 }).then((handle) => handle.jsonValue());
  coarse.push(await seen("triangles|coarse"));
  whole.push(await seen("triangles$"));
  await tab.close();
  server.kill("SIGINT");
}
await browser.close();
console.log(`${store}: first picture ${Math.round(middle(coarse))} ms (worst ${Math.round(Math.max(...coarse))}), whole ${Math.round(middle(whole))} ms (worst ${Math.round(Math.max(...whole))}), ${runs} runs`);
