// A file of several time steps: its menu, and the pages of the other volumes.
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { cameraOf, commonHash, pathOf, timeText } from "../src/viewer/panels/volume_menu";
import { NOTHING, shownAt } from "../src/viewer/state/state";
import { canServe, Served } from "./viewer_harness";

const SIDE = 24;
const STEPS = 3;

/** Step t has t + 1 balls in a row. */
function ballsOverTime(): Buffer {
  const header = `NRRD0004\ntype: uint8\ndimension: 4\nsizes: ${SIDE} ${SIDE} ${SIDE} ${STEPS}\nspacings: 1 1 1 2.5\nencoding: raw\n\n`;
  const samples = Buffer.alloc(SIDE ** 3 * STEPS);
  let at = 0;
  for (let t = 0; t < STEPS; ++t) {
    for (let z = 0; z < SIDE; ++z) {
      for (let y = 0; y < SIDE; ++y) {
        for (let x = 0; x < SIDE; ++x) {
          const distances = Array.from({ length: t + 1 }, (_, k) => Math.hypot(x - 4 - 7 * k, y - 12, z - 12));
          samples[at++] = Math.max(0, Math.round(220 - 50 * Math.min(...distances)));
        }
      }
    }
  }
  return Buffer.concat([Buffer.from(header), samples]);
}

describe("what pages of other volumes get", () => {
  it("is the camera and the whole isosurface", () => {
    const view = [1, 2, 3, 0, 0, 0];
    expect(cameraOf(commonHash({ ...NOTHING, shown: [shownAt(2, 90)], view }))).toEqual(view);
    expect(commonHash({ ...NOTHING, shown: [shownAt(2, 90), shownAt(-1, 80)], view })).toBe("#scene=-1,80,1,1&selected=0&view=1,2,3,0,0,0");
    expect(commonHash(NOTHING)).toBe("");
    expect(cameraOf("#scene=&selected=-1")).toBeNull();
  });

  it("is at an address beside, also below a path of a proxy", () => {
    expect(pathOf("/", 4)).toBe("/volume/4/");
    expect(pathOf("/volume/4/", 5)).toBe("/volume/5/");
    expect(pathOf("/proxy/8888/volume/12/", 0)).toBe("/proxy/8888/volume/0/");
  });

  it("has times in the unit of the file", () => {
    const volumes = { volume: 0, channels: [""], time_steps: 2, times: [0, 0.1 + 0.2], time_unit: "s" };
    expect(timeText(volumes, 1)).toBe("1 at 0.3 s");
    expect(timeText({ ...volumes, times: [] }, 1)).toBe("1");
  });
});

describe.skipIf(!canServe)("a file of several time steps", () => {
  let served: Served;
  const folder = mkdtempSync(join(tmpdir(), "isoatlas-steps-"));
  beforeAll(async () => {
    writeFileSync(join(folder, "steps.nrrd"), ballsOverTime());
    served = await Served.file(join(folder, "steps.nrrd"), false);
  }, 240_000);
  afterAll(async () => {
    await served.close();
    rmSync(folder, { recursive: true });
  });

  it("opens any of them from a menu, built where it is asked for, and keeps the camera", async () => {
    const { tab } = await served.open();
    const slider = tab.getByRole("slider", { name: "time step" });
    expect(await slider.inputValue()).toBe("0");
    expect(await slider.getAttribute("aria-valuetext")).toContain("0");
    await tab.getByRole("status").getByText("1 object").first().waitFor();
    await tab.keyboard.press("ArrowRight"); // turns the camera
    await tab.getByRole("button", { name: "next time step" }).click();
    await tab.waitForURL(/\/volume\/1\//);
    await tab.waitForSelector(".objects [role=tab]", { timeout: 120_000 });
    expect(await tab.getByRole("slider", { name: "time step" }).inputValue()).toBe("1");
    await tab.getByRole("button", { name: "next time step" }).click();
    await tab.waitForURL(/\/volume\/2\//);
    await tab.waitForSelector(".objects [role=tab]", { timeout: 120_000 });
    const screenshots = process.env.ISOATLAS_SCREENSHOTS;
    if (screenshots) await tab.screenshot({ path: join(screenshots, "volumes.png") });
    const authorised = { headers: { Authorization: `Bearer ${served.token}` } };
    const answer = await fetch(`${served.origin}/volume/2/api/objects?tau=150`, authorised);
    const objects = (await answer.json()) as { objects: unknown[] };
    expect(objects.objects).toHaveLength(3);
    await tab.reload();
    await tab.waitForSelector(".objects [role=tab]");
    expect(await tab.getByRole("slider", { name: "time step" }).inputValue()).toBe("2");
    const missing = await fetch(`${served.origin}/volume/3/api/atlas`, authorised);
    expect(missing.status).toBe(404);
  }, 300_000);
});
