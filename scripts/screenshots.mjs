// Screenshots of pages: light, dark, on a phone, and with the first object opened; PNG files beside each page. Needs Debian's Chromium.
//
//     node scripts/screenshots.mjs build/release/web gallery/*.atlas.html
//
// The first argument is the folder of the bundles: playwright-core is installed there. Prints the time of the first paint.
import { createRequire } from "node:module";
import { resolve } from "node:path";

const [web, ...pages] = process.argv.slice(2);
if (!web || pages.length === 0) {
  console.error("usage: node scripts/screenshots.mjs WEB-BUILD PAGE...");
  process.exit(2);
}
const { chromium } = createRequire(resolve(web, "package.json"))("playwright-core");
const views = [
  { name: "light", width: 1200, colorScheme: "light", hash: "", fullPage: true },
  { name: "dark", width: 1200, colorScheme: "dark", hash: "", fullPage: true },
  { name: "phone", width: 380, colorScheme: "light", hash: "", fullPage: true },
  { name: "detail", width: 1200, colorScheme: "light", hash: "#object-1", fullPage: false },
];
const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox"] });
for (const page of pages) {
  for (const { name, width, colorScheme, hash, fullPage } of views) {
    const tab = await browser.newPage({ viewport: { width, height: 900 }, colorScheme });
    tab.on("pageerror", (error) => console.error(`${page}: ${error.message}`));
    await tab.goto(`file://${resolve(page)}${hash}`);
    await tab.screenshot({ path: page.replace(/\.html$/, `.${name}.png`), fullPage });
    const paint = await tab.evaluate(() => performance.getEntriesByName("first-contentful-paint")[0]?.startTime);
    console.log(`${page} ${name}: first paint after ${Math.round(paint)} ms`);
    await tab.close();
  }
}
await browser.close();
