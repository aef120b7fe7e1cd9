// How long from opening the page of `isoatlas view` until the first object stands in the picture, coarse and whole. Needs Debian's Chromium.
//
//     node bench/view/first_picture.mjs build/release/web build/release/bin/isoatlas STORE [RUNS]
//
// The first argument is where the page was bundled: playwright-core is installed there. Every run has a server of its own; the store's
// pages are in the system's cache. Milliseconds from the browser's request for the page, drawn without a graphics card.
import { argumentsOf, launched, said, served, share, tabOf } from "./viewer.mjs";

const { web, isoatlas, store, number: runs } = argumentsOf("first_picture.mjs", "RUNS", 5);
const browser = await launched(web);
const coarse = [], whole = [];
for (let run = 0; run < runs; ++run) {
  const server = await served(isoatlas, store);
  const tab = await tabOf(browser);
  await tab.goto(server.address, { waitUntil: "commit" });
  coarse.push(await said(tab, "triangles|points"));
  whole.push(await said(tab, "triangles$"));
  await tab.close();
  server.end();
}
await browser.close();
const words = (times) => `${Math.round(share(times, 0.5))} ms (worst ${Math.round(Math.max(...times))})`;
console.log(`${store}: first picture ${words(coarse)}, whole ${words(whole)}, ${runs} runs`);
