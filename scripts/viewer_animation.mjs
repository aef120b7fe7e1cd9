// The animation of README.md: first steps in the viewer, on the demonstration volume. Needs Debian's Chromium and ffmpeg.
//
//     node scripts/viewer_animation.mjs build/dev/web build/dev/bin/isoatlas docs/images/viewer.webp
//
// The first argument is the folder of the bundles: playwright-core is installed there.
import { execFileSync, spawn } from "node:child_process";
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";

const [web, isoatlas, out] = process.argv.slice(2);
if (!out) {
  console.error("usage: node scripts/viewer_animation.mjs WEB-BUILD ISOATLAS OUT.webp");
  process.exit(2);
}
const { chromium } = createRequire(resolve(web, "package.json"))("playwright-core");
const FRAMES_A_SECOND = 8;
const program = resolve(isoatlas);
const folder = mkdtempSync(join(tmpdir(), "isoatlas-animation-"));
execFileSync(program, ["phantom", "demo", "-o", "demo.nrrd", "--quiet"], { cwd: folder });
execFileSync(program, ["build", "demo.nrrd", "-o", "demo.atlas", "--quiet"], { cwd: folder });
const server = spawn(program, ["view", "demo.atlas", "--no-browser", "--quiet"], { cwd: folder });
const address = await new Promise((found) => server.stdout.once("data", (bytes) => found(String(bytes).trim())));
const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"] });
const tab = await browser.newPage({ viewport: { width: 1200, height: 680 }, colorScheme: "light", bypassCSP: true });
await tab.addInitScript(() => localStorage.setItem("isoatlas-tour", "seen"));
let frames = 0;

/** Repeats the current frame, for some seconds. */
async function hold(seconds) {
  const shot = await tab.screenshot();
  for (let i = 0; i < Math.round(seconds * FRAMES_A_SECOND); ++i) {
    writeFileSync(join(folder, `${String(frames++).padStart(4, "0")}.png`), shot);
  }
}
async function settled() {
  await tab.waitForFunction(() => [...document.querySelectorAll(".scene .state")].every((state) => /triangles$|hidden$/.test(state.textContent ?? "")));
  await tab.waitForTimeout(150);
}
async function press(key, times, seconds = 1 / FRAMES_A_SECOND) {
  for (let i = 0; i < times; ++i) {
    await tab.keyboard.press(key);
    await settled();
    await hold(seconds);
  }
}

await tab.goto(address);
await tab.waitForSelector(".objects li");
await settled();
await tab.waitForFunction(() => document.querySelectorAll(".objects img").length >= 2);
await tab.waitForTimeout(3000);
await hold(1.5);
await press("}", 4, 0.6); // to the next events
await tab.getByRole("button", { name: /^Object 3/ }).first().click();
await settled();
await hold(1);
await tab.getByRole("button", { name: /^Object 4/ }).first().click({ modifiers: ["Shift"] }); // the ring, at its own isovalue
await settled();
await tab.keyboard.press("f");
await hold(1);
await tab.keyboard.press("c"); // clip: one ball is hollow
await settled();
await tab.getByRole("button", { name: "clip along z" }).click();
await tab.getByRole("button", { name: "flip the clipping plane" }).click();
await settled();
await hold(1);
await press("ArrowLeft", 8);
await press("ArrowUp", 3);
await hold(1.5);
await browser.close();
server.kill("SIGINT");
mkdirSync(dirname(resolve(out)), { recursive: true });
execFileSync("ffmpeg", ["-y", "-loglevel", "error", "-framerate", String(FRAMES_A_SECOND), "-i", join(folder, "%04d.png"), "-loop", "0", "-quality", "70", "-compression_level", "6", resolve(out)]);
rmSync(folder, { recursive: true });
console.log(`${out}: ${frames} frames`);
