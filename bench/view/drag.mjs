// How many frames a second are drawn while a surface is turned, and while its isovalue is dragged; how soon do surfaces follow? Needs
// Debian's Chromium.
//
//     node bench/view/drag.mjs build/release/web build/release/bin/isoatlas STORE [SECONDS]
//
// Drawn without a graphics card, so that frames are to be compared with those of an empty scene that is turned in the same way. The surface
// of the first object is turned as a whole; its isovalue is dragged to and fro within a tenth of the range, a step each frame.
import { argumentsOf, launched, said, served, share, tabOf } from "./viewer.mjs";

/** How many frames are drawn meanwhile. */
async function framesDuring(tab, act) {
  await tab.evaluate(() => {
    window.drawn = 0;
    const look = () => window.drawn !== null && (++window.drawn, requestAnimationFrame(look));
    requestAnimationFrame(look);
  });
  await act();
  return tab.evaluate(() => {
    const frames = window.drawn;
    window.drawn = null;
    return frames;
  });
}

async function turn(tab, seconds) {
  const box = await tab.locator(".viewport canvas").first().boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  const until = performance.now() + 1000 * seconds;
  await tab.mouse.move(x, y);
  await tab.mouse.down();
  for (let step = 0; performance.now() < until; ++step) {
    await tab.mouse.move(x + 100 * Math.sin(step / 10), y + 60 * Math.cos(step / 13));
    await new Promise((done) => setTimeout(done, 16));
  }
  await tab.mouse.up();
}

/** In the page: of the surfaces that came meanwhile, milliseconds from the request to the last byte, and triangles. */
async function drag(seconds) {
  const slider = document.querySelector(".drawn input");
  const [middle, range] = [Number(slider.value), Number(slider.max) - Number(slider.min)];
  const begun = performance.now();
  performance.clearResourceTimings();
  performance.setResourceTimingBufferSize(10_000);
  const seen = new Set(); // numbers of triangles
  for (let step = 0; performance.now() - begun < 1000 * seconds; ++step) {
    slider.value = String(middle + (range / 20) * Math.sin(step / 20));
    slider.dispatchEvent(new Event("input"));
    await new Promise(requestAnimationFrame);
    const triangles = document.querySelector(".scene .state")?.textContent.match(/([\d,]+) triangles/)?.[1];
    if (triangles) seen.add(Number(triangles.replaceAll(",", "")));
  }
  const came = performance.getEntriesByType("resource").filter(({ name }) => name.includes("/api/surface"));
  slider.dispatchEvent(new Event("change"));
  return { times: came.map(({ duration }) => duration), triangles: [...seen] };
}

const { web, isoatlas, store, number: seconds } = argumentsOf("drag.mjs", "SECONDS", 5);
const browser = await launched(web);
const server = await served(isoatlas, store);
const tab = await tabOf(browser);
await tab.goto(server.address);
await said(tab, "triangles$");
const whole = await tab.locator(".scene .state").first().textContent();
const turned = await framesDuring(tab, () => turn(tab, seconds));
let came;
const dragged = await framesDuring(tab, async () => (came = await tab.evaluate(drag, seconds)));
await tab.goto(`${new URL(tab.url()).origin}/#scene=&selected=-1`);
await tab.reload();
await tab.waitForSelector(".cards .card");
await new Promise((done) => setTimeout(done, 2000)); // it has been drawn
const empty = await framesDuring(tab, () => turn(tab, seconds));
await browser.close();
server.end();

const rate = (frames) => `${(frames / seconds).toFixed(1)} frames a second`;
const [median, most] = [0.5, 0.9].map((part) => Math.round(share(came.times, part)));
console.log(`${store}, ${whole}`);
console.log(`turned: ${rate(turned)}; an empty scene: ${rate(empty)}`);
console.log(`dragged: ${rate(dragged)}; ${(came.times.length / seconds).toFixed(1)} surfaces a second, median ${median} ms, 90 % ${most}`);
const drawn = came.triangles.length > 0 ? `${share(came.triangles, 0)} to ${share(came.triangles, 1)}` : "none, points alone";
console.log(`triangles while dragged: ${drawn}`);
