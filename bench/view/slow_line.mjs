// How long until every object of a store has its first picture where the line to the page has 1 MB/s and 100 ms? Needs Debian's Chromium.
//
//     node bench/view/slow_line.mjs build/release/web build/release/bin/isoatlas STORE [OBJECTS]
//
// The browser makes every answer wait. Milliseconds in the page: until the first object of the opened page is in the scene, coarse or
// whole; then for each other card (at most OBJECTS) from the click that shows its object alone. Wanted: 2 s.
import { argumentsOf, launched, said, served, share, tabOf } from "./viewer.mjs";

const LINE = { offline: false, latency: 100, downloadThroughput: 1e6, uploadThroughput: 1e6 }; // ms, bytes a second

/** In the page: milliseconds until each object has a surface or points of it, and what it has. */
async function clicked(most) {
  const pause = (time) => new Promise((done) => setTimeout(done, time));
  const buttons = [...document.querySelectorAll(".cards .card:not(.selected) .picture")].slice(0, most);
  const found = [];
  for (const button of buttons) {
    performance.clearResourceTimings();
    const begun = performance.now();
    button.click();
    const isThere = () =>
      performance.getEntriesByType("resource").some(({ name }) => name.includes("/api/surface")) &&
      /\d (triangles|points)/.test(document.querySelector(".scene .state")?.textContent ?? "");
    while (!isThere() && performance.now() - begun < 60_000) await pause(10);
    found.push({ time: performance.now() - begun, words: document.querySelector(".scene .state")?.textContent ?? "" });
    await pause(3000); // the whole surface comes, too, and is drawn
  }
  return found;
}

const { web, isoatlas, store, number: most } = argumentsOf("slow_line.mjs", "OBJECTS", 100);
const browser = await launched(web);
const server = await served(isoatlas, store);
const tab = await tabOf(browser);
const session = await tab.context().newCDPSession(tab);
await session.send("Network.enable");
await session.send("Network.emulateNetworkConditions", LINE);
await tab.goto(server.address, { waitUntil: "commit" });
const opened = await said(tab, "triangles|points");
await said(tab, "triangles$");
await new Promise((done) => setTimeout(done, 3000));
const objects = await tab.evaluate(clicked, most);
const times = objects.map(({ time }) => time);
const late = objects.filter(({ time }) => time > 2000).length;
const [median, worst] = [0.5, 1].map((part) => Math.round(share(times, part)));
console.log(`${store}: page and first object ${Math.round(opened)} ms; ${times.length} objects, median ${median}, worst ${worst} ms, ${late} after 2 s`);
for (const { time, words } of objects) if (time > 2000) console.log(`${Math.round(time)} ms: ${words}`);
await browser.close();
server.end();
