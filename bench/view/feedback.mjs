// How long from a step, a drag or a number that is typed until the page says what the surface there will cost. Needs Debian's Chromium.
//
//     node bench/view/feedback.mjs build/release/web build/release/bin/isoatlas STORE [TIMES]
//
// The first argument is where the page was bundled: playwright-core is installed there. Milliseconds in the page, from the event until the
// words stand beside the isovalue, TIMES for each; the number itself is there when the event has been handled. Drawn without a graphics card.
import { argumentsOf, launched, said, served, share, tabOf } from "./viewer.mjs";

const { web, isoatlas, store, number: times } = argumentsOf("feedback.mjs", "TIMES", 20);

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

const browser = await launched(web);
const server = await served(isoatlas, store);
const tab = await tabOf(browser);
await tab.goto(server.address);
await said(tab, "triangles$");
await new Promise((done) => setTimeout(done, 3000));
for (const [kind, list] of Object.entries(await tab.evaluate(measure, times))) {
  const [median, most, worst] = [0.5, 0.9, 1].map((part) => Math.round(share(list, part)));
  console.log(`${kind}: median ${median}, 90 % ${most}, worst ${worst} ms`);
}
await browser.close();
server.end();
