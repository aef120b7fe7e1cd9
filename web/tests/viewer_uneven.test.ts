// A volume with uneven steps between samples: slices and measures follow its coordinates.
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { Api } from "../src/viewer/api/api";
import { SlicedMesh } from "../src/viewer/scene/plane_cut";
import { AXES, Grid } from "../src/viewer/state/grid";
import { canServe, Served, stableBox } from "./viewer_harness";

const SIDE = 30;
const MIDDLE = SIDE / 2;
const RADIUS = 10;
const SAMPLES = 40;

/** A VTK file of a ball: values are 100 minus five times the distance from the middle; its radius is RADIUS at 50. */
function ball(): string {
  const [x, y, z] = [1.5, 1, 0.7].map((power) => Array.from({ length: SAMPLES }, (_, i) => SIDE * (i / (SAMPLES - 1)) ** power)) as [
    number[],
    number[],
    number[],
  ];
  const values = z.flatMap((c) => y.flatMap((b) => x.map((a) => 100 - 5 * Math.hypot(a - MIDDLE, b - MIDDLE, c - MIDDLE))));
  const list = (type: string, name: string, numbers: number[]): string =>
    `<DataArray type="${type}" Name="${name}" format="ascii">${numbers.join(" ")}</DataArray>`;
  const extent = Array.from({ length: 3 }, () => `0 ${SAMPLES - 1}`).join(" ");
  const coordinates = [x, y, z].map((numbers, axis) => list("Float64", "xyz"[axis]!, numbers)).join("");
  const piece = `<PointData Scalars="value">${list("Float32", "value", values)}</PointData><Coordinates>${coordinates}</Coordinates>`;
  const grid = `<RectilinearGrid WholeExtent="${extent}"><Piece Extent="${extent}">${piece}</Piece></RectilinearGrid>`;
  return `<VTKFile type="RectilinearGrid">${grid}</VTKFile>`;
}

describe.skipIf(!canServe)("a volume with uneven steps", () => {
  const folder = mkdtempSync(join(tmpdir(), "isoatlas-uneven-"));
  let served: Served;
  let api: Api;
  beforeAll(async () => {
    writeFileSync(join(folder, "ball.vtr"), ball());
    served = await Served.file(join(folder, "ball.vtr"));
    api = new Api(served.token, served.origin);
  });
  afterAll(async () => {
    await served?.close();
    rmSync(folder, { recursive: true });
  });

  it("has its samples at the positions of the server", async () => {
    const grid = new Grid(await api.page());
    for (const voxel of [[0, 0, 0], [39, 39, 39], [1, 20, 7], [30, 2, 38]] as const) {
      const { position } = (await (await api.request(`/api/at?voxel=${voxel.join()}`, "at")).json()) as { position: number[] };
      expect(grid.place(voxel)).toEqual(position.map((n) => expect.closeTo(n, 4)));
    }
  });

  it("has round contours on every slice of a ball", async () => {
    const grid = new Grid(await api.page());
    const mesh = await api.surface("all", 50, null, 10_000_000);
    for (const axis of AXES) {
      for (const index of [16, 20, 24]) {
        const pieces = new SlicedMesh(mesh, grid).cut(axis, index);
        const apart = grid.rulers[axis].length(index) - MIDDLE;
        if (Math.abs(apart) > 0.9 * RADIUS) continue;
        const radii = Array.from({ length: pieces.length / 2 }, (_, i) => Math.hypot(pieces[2 * i]! - MIDDLE, pieces[2 * i + 1]! - MIDDLE));
        expect(radii.length, `axis ${axis}`).toBeGreaterThan(40);
        const expected = Math.sqrt(RADIUS ** 2 - apart ** 2);
        for (const radius of radii) expect(Math.abs(radius - expected)).toBeLessThan(0.12); // values are interpolated
      }
    }
  });

  it("can be sliced and measured, and explains that volume rendering is not available", async () => {
    const { tab, problems } = await served.open("#scene=0,50,1,1&selected=0&slices=1&planes=1&measure=5,15,15,25,15,15");
    const [area, size] = [4 * Math.PI * RADIUS ** 2, (4 / 3) * Math.PI * RADIUS ** 3];
    const facts = (): Promise<string[]> => tab.locator(".object .here dd").allTextContents();
    await expect.poll(async () => (await facts()).length).toBeGreaterThan(1);
    const [measured, , sides] = (await facts()).map((text) => Number(text.replace(",", "").split(" ")[0]));
    expect(Math.abs((measured ?? 0) / size - 1)).toBeLessThan(0.02);
    expect(Math.abs((sides ?? 0) / area - 1)).toBeLessThan(0.02);
    expect(await tab.locator(".measures b").textContent()).toBe("20 units");

    const slice = tab.locator(".slices canvas").nth(2);
    const { rulers } = new Grid(await api.page());
    const ends = (axis: 0 | 1): number[] => [rulers[axis].length(-0.5), rulers[axis].length(SAMPLES - 0.5)];
    const [[left, right], [top, bottom]] = [ends(0), ends(1)] as [[number, number], [number, number]];
    const clickRight = async (away: number): Promise<number> => {
      const { width, height } = await stableBox(slice);
      const pixels = Math.min(width / (right - left), height / (bottom - top)); // of a unit of length
      await slice.click({ position: { x: width / 2 + away * pixels, y: height / 2 } });
      const cross = new URLSearchParams(new URL(tab.url()).hash.slice(1)).get("cross") ?? "";
      return Math.abs(rulers[0].length(Number(cross.split(",")[0])) - (left + right) / 2 - away);
    };
    for (const away of [-9, 4]) await expect.poll(() => clickRight(away)).toBeLessThan(0.7); // the sample nearby

    await tab.locator("h1").click();
    await tab.keyboard.press("v");
    await expect.poll(() => tab.locator(".message").textContent()).toContain("uneven");
    expect(problems).toEqual([]);
    await tab.close();
  });
});
