// How long from a step, a drag or a number that is typed until the page says what the surface there will cost. Needs Debian's Chromium.
//
//     node bench/view/feedback.mjs build/release/web build/release/bin/isoatlas STORE [TIMES]
//
// The first argument is where the page was bundled: playwright-core is installed there. Milliseconds in the page, from the event until the
// words stand beside the isovalue, TIMES for each; the number itself is there when the event has been handled. Drawn without a graphics card.
import { spawn } from "node:child_process";
import { createRequire } from "node:module";
import { resolve } from "node:path";

const [web, isoatlas, store, times = "20"] = process.argv.slice(2);
if (!store) {
  console.error("usage: node bench/view/feedback.mjs WEB-BUILD ISOATLAS STORE [TIMES]");
  process.exit(2);
}

/** In the page: milliseconds of each kind. */
async function measure(times) {
  const [badge, slider, box] = [".badge", ".drawn input", '.axis input[aria-label="isovalue"]'].map((what) => document.querySelector(what));
  const pause = (time) => new Promise((done) => setTimeout(done, time));
  const said = () => new Promise((done) => {
    const words = badge.textContent;
    const observer = new MutationObserver(() => badge.textContent !== words && (observer.disconnect(), done(performance.now())));
    observer.observe(badge, { childList: true, characterData: true, subtree: true });
  });
  const fire = (input, value, event) => ((input.value = String(value)), input.dispatchEvent(new Event(event)));
  const kinds = {
    step: () => document.dispatchEvent(new KeyboardEvent("keydown", { key: "]", bubbles: true })),
    drag: () => fire(slider, Number(slider.value) - 37, "input"),
    type: () => fire(box, (Number(box.value) * 1.013).toPrecision(4), "change"),
  };
  const found = { "the event itself": [] };
  for (const [kind, act] of Object.entries(kinds)) {
    found[kind] = [];
    for (let i = 0; i < times; ++i) {
      const begun = performance.now();
      const words = said();
      act();
      found["the event itself"].push(performance.now() - begun);
      found[kind].push((await words) - begun);
      await pause(kind === "drag" ? 200 : 1000); // the surface comes, too
    }
  }
  return found;
}

const { chromium } = createRequire(resolve(web, "package.json"))("playwright-core");
const drawing = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: drawing });
const server = spawn(resolve(isoatlas), ["view", store, "--no-browser", "--quiet"]);
const address = await new Promise((found) => server.stdout.once("data", (bytes) => found(String(bytes).trim())));
const tab = await browser.newPage({ viewport: { width: 1280, height: 800 }, bypassCSP: true });
await tab.addInitScript(() => localStorage.setItem("isoatlas-tour", "seen"));
await tab.goto(address);
await tab.waitForFunction(() => /triangles$/.test(document.querySelector(".scene .state")?.textContent ?? ""));
await new Promise((done) => setTimeout(done, 3000));
for (const [kind, list] of Object.entries(await tab.evaluate(measure, Number(times)))) {
  const sorted = list.sort((p, q) => p - q).map(Math.round);
  console.log(`${kind}: median ${sorted[sorted.length >> 1]}, 90 % ${sorted[Math.floor(0.9 * sorted.length)]}, worst ${sorted.at(-1)} ms`);
}
await browser.close();
server.kill("SIGINT");
