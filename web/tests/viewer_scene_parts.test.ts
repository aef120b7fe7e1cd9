// Parts of scenes and exports, without a browser.
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { deflateSync } from "node:zlib";
import { describe, expect, it } from "vitest";
import { animatedPng, chunksOf } from "../src/viewer/export/apng";
import { allText, bytesText } from "../src/viewer/panels/surface_estimate";
import { ConnectionError, failureText, ServerError, type Api, type Eye } from "../src/viewer/api/api";
import { eventNear, eventsOf } from "../src/viewer/state/events";
import { DragBudget } from "../src/viewer/api/drag_budget";
import { Latest } from "../src/viewer/api/latest";
import { factsOf } from "../src/viewer/panels/object_measures";
import { PALETTE } from "../src/viewer/state/palette";
import { renderCommand, type Camera } from "../src/viewer/export/render_command";
import { countComponents } from "../src/viewer/api/count_components";
import "../src/viewer/state/volume_state";
import { readScene, writeScene } from "../src/viewer/export/scene_file";
import { noteOf } from "../src/viewer/panels/scene_panel";
import { closedAgain, liesInside, SEE_THROUGH, seenThrough } from "../src/viewer/state/see_through";
import { add, change, isolate, NOTHING, remove, shownAt, type State } from "../src/viewer/state/state";
import { Surfaces } from "../src/viewer/api/surfaces";
import { cell, tableCsv } from "../src/viewer/export/table_csv";
import type { Mesh } from "../src/shared/wire";
import { branch, entry, page as samplePage, scene as page } from "./sample";

const schemaFile = join(process.env.ISOATLAS_SCHEMAS ?? "nowhere", "scene.schema.json");
const camera: Camera = { view: [-1, 2, 3, 0, 0, 0.5], up: [0, 0, 1], flat: false, height: 12.5, cut: null };
const two: State = { ...change(add(isolate(NOTHING, 0, 10), 1, 20.5), 1, { colour: "#12ab00", opacity: 0.5 }), view: [1, 2, 3, 4, 5, 6] };

describe("what lies inside another object", () => {
  // 0 holds 1, which holds the cavity 2; 3 is beside them.
  const nested = samplePage([branch({})], [entry({}), entry({ inside: 0 }), entry({ around: 1 }), entry({})]);
  const opacities = (state: State): number[] => state.shown.map((shown) => shown.opacity);
  const added = (state: State, i: number): State => seenThrough(nested, add(state, i, 10), i);

  it("is found through all that is between", () => {
    expect([0, 1, 3, -1].map((outer) => liesInside(nested, 2, outer))).toEqual([true, true, false, true]);
    expect([1, 2, 3].map((inner) => liesInside(nested, 0, inner))).toEqual([false, false, false]);
    expect([liesInside(nested, 1, 1), liesInside(nested, -1, 0), liesInside(nested, -1, -1)]).toEqual([false, false, false]);
  });

  it("makes the outer one transparent, whichever comes first", () => {
    const skin = isolate(NOTHING, 0, 10);
    expect(opacities(added(skin, 3))).toEqual([1, 1]);
    expect(opacities(added(skin, 2))).toEqual([SEE_THROUGH, 1]);
    expect(opacities(added(isolate(NOTHING, 2, 10), 0))).toEqual([1, SEE_THROUGH]);
    expect(opacities(added(isolate(NOTHING, -1, 10), 3))).toEqual([SEE_THROUGH, 1]);
    expect(opacities(added(change(skin, 0, { opacity: 0.8 }), 2))).toEqual([0.8, 1]); // as the user wants it
    expect(opacities(added(change(added(skin, 2), 0, { opacity: 1 }), 3))).toEqual([1, 1, 1]);
  });

  it("leaves it opaque again when the last one is removed", () => {
    const all = added(added(isolate(NOTHING, 0, 10), 1), 2);
    expect(opacities(all)).toEqual([SEE_THROUGH, SEE_THROUGH, 1]);
    const without = closedAgain(nested, remove(all, 2), 2);
    expect(opacities(without)).toEqual([SEE_THROUGH, 1]);
    expect(opacities(closedAgain(nested, remove(without, 1), 1))).toEqual([1]);
    const chosen = change(isolate(NOTHING, 0, 10), 0, { opacity: 0.6 });
    expect(opacities(closedAgain(nested, remove(added(chosen, 1), 1), 1))).toEqual([0.6]);
  });
});

describe("surfaces", () => {
  interface Asked {
    tau: number;
    most: number;
    answer(mesh: Partial<Mesh>): void;
    aborted: boolean;
  }
  function lanes(): { surfaces: Surfaces; asked: Asked[]; loaded: (number | null)[] } {
    const [asked, loaded]: [Asked[], (number | null)[]] = [[], []];
    const api = {
      surface: (_: string, tau: number, _target: null, most: number) =>
        new Promise<Mesh>((resolve) =>
          asked.push({ tau, most, answer: (mesh) => resolve({ triangles: 5, bytes: 9, coarse: false, ...mesh } as Mesh), aborted: false }),
        ),
      abort: () => asked.forEach((one) => (one.aborted = true)),
    } as unknown as Api;
    return {
      surfaces: new Surfaces(
        api,
        (_, mesh, tau) => loaded.push(mesh ? tau : null),
        () => undefined,
      ),
      asked,
      loaded,
    };
  }
  const request = (tau: number) => ({ tau, target: null, walls: "all" as const });
  const rest = (): Promise<void> => new Promise((resolve) => setTimeout(resolve));

  it("load one at a time during a drag, coarse, then the last one; full at its end", async () => {
    const { surfaces, asked, loaded } = lanes();
    for (let tau = 1; tau <= 20; ++tau) surfaces.request(0, request(tau), true);
    expect(asked.map(({ tau }) => tau)).toEqual([1]);
    asked[0]?.answer({ coarse: true });
    await rest();
    expect(asked.map(({ tau }) => tau)).toEqual([1, 20]);
    surfaces.request(0, request(21), false);
    expect(asked.map(({ tau, most }) => [tau, most < 1e6])).toEqual([
      [1, true],
      [20, true],
      [21, true],
    ]);
    asked[1]?.answer({ coarse: true });
    asked[2]?.answer({ coarse: true });
    await rest();
    expect(asked[3]).toMatchObject({ tau: 21, most: 1e8 });
    asked[3]?.answer({ triangles: 99 });
    await surfaces.settled();
    expect(loaded).toEqual([1, 21, 21]); // what rested ended what was dragged
    expect(surfaces.loadStateOf(0)).toMatchObject({ key: "21 all", triangles: 99, coarse: false, waiting: false });
  });
  it("are not loaded twice; a small one is complete at once", async () => {
    const { surfaces, asked } = lanes();
    surfaces.request(0, request(1), true);
    asked[0]?.answer({});
    await surfaces.settled();
    surfaces.request(0, request(1), false);
    expect(asked.length).toBe(1);
    for (let i = 0; i < 3; ++i) surfaces.request(0, request(2), false); // as when its colour changes meanwhile
    expect(asked.length).toBe(2);
  });
  it("that are coarse are completed without a second coarse one", async () => {
    const { surfaces, asked } = lanes();
    surfaces.request(0, request(1), true);
    asked[0]?.answer({ coarse: true });
    await rest();
    surfaces.request(0, request(1), false);
    expect(asked.map(({ most }) => most)).toEqual([20_000, 1e8]);
    surfaces.remove(0);
    expect(asked[1]?.aborted).toBe(true);
  });
  it("that are dragged have as many triangles as arrive in time", async () => {
    const { surfaces, asked } = lanes();
    for (let tau = 1; tau <= 8; ++tau) {
      surfaces.request(0, request(tau), true);
      asked.at(-1)?.answer({ coarse: tau < 7 });
      await surfaces.settled();
    }
    expect(asked.map(({ most }) => most / 20_000)).toEqual([1, 2, 4, 8, 16, 32, 32, 32]);

    const budget = new DragBudget(20_000);
    const after = (milliseconds: number, isCoarse = true, frame = 0): number => {
      budget.took(milliseconds, isCoarse, frame);
      return budget.triangles;
    };
    expect([199, 99, 99].map((quick) => after(quick))).toEqual([40_000, 80_000, 160_000]);
    expect([after(99, false), after(300), after(500), after(500, false)]).toEqual([160_000, 160_000, 40_000, 20_000]);
    expect([after(99, true, 90), after(99, true, 70), after(99, true, 170)]).toEqual([20_000, 40_000, 20_000]);
  });
});

describe("large surfaces with levels of detail", () => {
  const request = (tau: number) => ({ tau, target: null, walls: "all" as const });
  it("are fine where the eye is near, and loaded again where it goes", async () => {
    const asked: string[] = [];
    const api = {
      surface: (_: string, tau: number, __: unknown, most: number, ___: unknown, eye?: Eye) => {
        asked.push(`${tau} at most ${most}${eye ? ` from ${eye.at.join()}` : ""}`);
        return Promise.resolve({ triangles: 8, bytes: 9, coarse: true, within: 2, ...(eye && { pixels: 0.5 }) } as Mesh);
      },
      abort: () => undefined,
    } as unknown as Api;
    const eye = { at: [1, 2, 3], pixel: 0.01, towards: [0, 1, 0], angle: 40 };
    const surfaces = new Surfaces(
      api,
      () => undefined,
      () => undefined,
      () => ({ ...eye }),
    );
    surfaces.request(0, request(1), false);
    await surfaces.settled();
    expect(asked).toEqual(["1 at most 20000", "1 at most 1000000 from 1,2,3"]);
    expect(surfaces.loadStateOf(0)).toMatchObject({ coarse: false, within: 2, pixels: 0.5, waiting: false });
    surfaces.request(0, request(1), false);
    expect(asked.length).toBe(2);
    eye.at = [4, 5, 6];
    surfaces.request(0, request(1), true); // while an isovalue is dragged, the view is not what counts
    expect(asked.length).toBe(2);
    surfaces.request(0, request(1), false);
    await surfaces.settled();
    expect(asked.slice(2)).toEqual(["1 at most 1000000 from 4,5,6"]);
    eye.towards = [1, 0, 0]; // what comes into the view was coarse
    surfaces.request(0, request(1), false);
    await surfaces.settled();
    expect(asked.slice(3)).toEqual(["1 at most 1000000 from 4,5,6"]);
    surfaces.request(1, request(1), false); // they share what may be drawn
    await surfaces.settled();
    expect(asked.slice(4)).toEqual(["1 at most 20000", "1 at most 500000 from 4,5,6"]);
  });
  it("are exact at last where the coarse one was no level", async () => {
    const asked: string[] = [];
    const api = {
      surface: (_: string, __: number, ___: unknown, most: number, ____: unknown, eye?: Eye) => {
        asked.push(`at most ${most}${eye ? " from there" : ""}`);
        return Promise.resolve({ triangles: most, bytes: 9, coarse: most <= 1_000_000, ...(most <= 1_000_000 && { within: 2 }) } as Mesh);
      },
      abort: () => undefined,
    } as unknown as Api;
    const eye = { at: [1, 2, 3], pixel: 0.01, towards: [0, 1, 0], angle: 40 };
    const surfaces = new Surfaces(
      api,
      () => undefined,
      () => undefined,
      () => ({ ...eye }),
    );
    surfaces.request(0, request(1), false);
    await surfaces.settled();
    expect(asked).toEqual(["at most 20000", "at most 1000000 from there", "at most 100000000"]);
    expect(surfaces.loadStateOf(0)).toMatchObject({ coarse: false, within: null, triangles: 100_000_000 });
    eye.at = [4, 5, 6];
    surfaces.request(0, request(1), false);
    expect(asked.length).toBe(3);
  });
});

describe("surfaces as points", () => {
  const request = (tau: number) => ({ tau, target: null, walls: "all" as const });
  it("are some of their points while they have too many triangles", async () => {
    const some = { triangles: 0, positions: new Uint16Array(3 * 40), bytes: 9, coarse: true, isOpen: false, spacing: 0.5 } as Mesh;
    const asked: number[] = [];
    const api = {
      surface: (_: string, __: number, ___: unknown, most: number) => (
        asked.push(most), Promise.resolve(most < 1e8 ? some : { ...some, triangles: 8, coarse: false, spacing: undefined })
      ),
    } as unknown as Api;
    const surfaces = new Surfaces(
      api,
      () => undefined,
      () => undefined,
    );
    surfaces.request(0, request(1), true);
    await surfaces.settled();
    expect(surfaces.loadStateOf(0)).toMatchObject({ points: 40, triangles: 0, coarse: true, within: null });
    surfaces.request(0, request(1), false);
    await surfaces.settled();
    expect(surfaces.loadStateOf(0)).toMatchObject({ points: 0, triangles: 8, coarse: false });
    expect(asked).toEqual([20_000, 100_000_000]);
  });

  it("come after coarse triangles, and again as triangles", async () => {
    const asked: string[] = [];
    const mesh = { triangles: 8, bytes: 9, coarse: false, isOpen: false } as Mesh;
    const api = {
      surface: (_: string, tau: number, __: unknown, most: number) => (asked.push(`${tau} at most ${most}`), Promise.resolve(mesh)),
      points: (_: string, tau: number) => (asked.push(`points ${tau}`), Promise.resolve({ ...mesh, isOpen: true })),
    } as unknown as Api;
    const surfaces = new Surfaces(
      api,
      () => undefined,
      () => undefined,
    );
    surfaces.drawAsPoints(true);
    surfaces.request(0, request(1), false);
    await surfaces.settled();
    expect(asked).toEqual(["1 at most 20000", "points 1"]);
    expect(surfaces.loadStateOf(0)).toMatchObject({ key: "1 all", points: 4, coarse: false });
    surfaces.drawAsPoints(false);
    surfaces.request(0, request(1), false);
    await surfaces.settled();
    expect(asked.slice(2)).toEqual(["1 at most 20000"]);
    expect(surfaces.loadStateOf(0)).toMatchObject({ points: 0, triangles: 8 });
  });
});

describe("the state of a surface", () => {
  const nothing = { points: 0, bytes: 0, within: null, pixels: null, walls: null, error: "" };
  const there = { ...nothing, key: "5 all", triangles: 1234, coarse: true, waiting: true };
  it("is its load state in words", () => {
    const shown = shownAt(0, 5);
    expect(noteOf(shown, { ...there, coarse: false })).toBe("at 5, 1,234 triangles");
    expect(noteOf(shown, { ...there, within: 3.9375 })).toBe("at 5, 1,234 triangles, coarse: exact topology, within 3.938 voxels");
    const seen = { ...there, coarse: false, within: 3, pixels: 0.52 };
    expect(noteOf(shown, seen)).toBe("at 5, 1,234 triangles: exact topology, within 0.52 pixels");
    expect(noteOf(shown, { ...there, points: 617 })).toBe("at 5, 617 points of it");
    expect(noteOf(shown, { ...there, points: 617, coarse: false })).toBe("at 5, 617 points");
    expect(noteOf({ ...shown, tau: 6 }, there)).toBe("at 6, loading");
    expect(noteOf({ ...shown, visible: false }, there)).toBe("at 5, hidden");
    expect(noteOf(shown, { ...there, triangles: 0, error: failureText(new ServerError(404, "no")) })).toBe("at 5, does not exist");
    expect(noteOf(shown, { ...there, triangles: 0, error: failureText(new ConnectionError()) })).toBe("at 5, no connection");
    expect(noteOf({ ...shown, walls: "cavities" }, { ...there, key: "5 cavities", walls: 2, coarse: false })).toBe(
      "at 5, 2 cavities, 1,234 triangles",
    );
    expect(noteOf({ ...shown, walls: "cavities" }, { ...there, key: "5 cavities", triangles: 0 })).toBe("at 5, no cavities");
  });
});

describe("components of a mesh", () => {
  it("are counted by connected triangles", () => {
    const corners = new Uint32Array([0, 1, 2, 2, 1, 3, 4, 5, 6, 9, 8, 7, 8, 7, 6]);
    expect(countComponents(corners)).toBe(2);
    expect(countComponents(new Uint32Array())).toBe(0);
  });
});

describe("the latest request", () => {
  it("follows the pending one; those in between are skipped", async () => {
    const asked: number[] = [];
    const answers: (() => void)[] = [];
    const latest = new Latest<number>((n) => new Promise((resolve) => (asked.push(n), answers.push(resolve))));
    for (const n of [1, 2, 3, 3]) latest.request(n, String(n));
    answers[0]?.();
    await new Promise((resolve) => setTimeout(resolve));
    latest.request(3, "3");
    expect(asked).toEqual([1, 3]);
  });
});

describe("events", () => {
  it("are described, ascending", () => {
    const events = eventsOf(page);
    expect(events.map(({ tau }) => tau)).toEqual([...events.map(({ tau }) => tau)].sort((p, q) => p - q));
    expect(events.some(({ text }) => /^Object \d+ appears at /.test(text))).toBe(true);
    expect(events.some(({ text }) => /merges into object \d+ at 30/.test(text))).toBe(true);
    const [first] = events;
    expect(eventNear(events, (tau) => tau, first?.tau ?? 0, 1)).toEqual(first);
    expect(eventNear(events, (tau) => tau, 1e6, 1)).toBeNull();
  });
});

describe("the estimate of a surface", () => {
  it("has its size", () => {
    const preview = {
      tau: 3,
      objects: 1,
      contours: 3,
      tunnels: 0,
      cavities: 2,
      triangles: [1000, 2000] as [number, number],
      bytes: [0, 0] as [number, number],
    };
    expect(allText(preview)).toBe("all at 3: 1 object, no tunnels, 2 cavities, 1,000 to 2,000 triangles, at most 5 kB");
    expect([5, 999_999, 2_345_678].map(bytesText)).toEqual(["5 bytes", "1000 kB", "2.3 MB"]);
  });
});

describe("measures", () => {
  const shape = {
    sphericity: 0.81234,
    feret: { max: 25.42, min: 4, mean: 11 },
    values: { mean: 61.25, min: 50, max: 99, sum: 735, deviation: 3 },
    touches_border: false,
  };
  it("are in units of the file", () => {
    const there = { id: 4, tunnels: 1, cavities: 0, voxels: [10, 12] as [number, number], area: 250, volume: 1234, ...shape };
    expect(factsOf(there, 4, 50, "mm", 110)).toEqual([
      ["at 50", "about 1.23 cm³, 10 to 12 voxels"],
      ["enclosed volume", "1.23 cm³"],
      ["area", "2.5 cm²"],
      ["diameters", "2.54 cm by 4 mm"],
      ["sphericity", "0.8123"],
      ["values", "mean 61.25, 50 to 99"],
      ["topology", "1 tunnel, no cavities"],
    ]);
    expect(factsOf({ ...there, voxels: [12, 12] }, 4, 50, "mm", 110)[0]?.[1]).toBe("1.32 cm³, 12 voxels"); // as on its card
    expect(factsOf(there, 7, 50, null, 1)[0]?.[1]).toBe("part of a larger object: about 1,230 voxels");
  });
  it("are in voxels and their faces where the file has no unit, as far as they are known", () => {
    const there = { id: 4, tunnels: 1, cavities: 0, voxels: [11, 11] as [number, number], area: 1234.4, volume: 11.2, ...shape };
    expect(factsOf(there, 4, 50, null, 1).map(([, text]) => text)).toEqual([
      "11 voxels",
      "11 voxels",
      "1,234 voxel faces",
      "25.4 voxels by 4 voxels",
      "0.8123",
      "mean 61.25, 50 to 99",
      "1 tunnel, no cavities",
    ]);
    expect(factsOf({ ...there, feret: { max: 2, min: null, mean: null } }, 4, 50, "mm", 1)[3]?.[1]).toBe("2 mm by flat");
    expect(factsOf({ ...there, area: 1 }, 4, 50, null, 1)[2]?.[1]).toBe("1 voxel face");
    const vague = { ...there, voxels: [0, 64_000] as [number, number] };
    expect(factsOf(vague, 4, 50, null, 1)[0]?.[1]).toBe("about 11 voxels");
    expect(factsOf(vague, 4, 50, "mm", 1)[0]?.[1]).toBe("about 11.2 mm³");
  });
});

describe("the command line of a scene", () => {
  it("has every object at its isovalue, its colour and its opacity, and the camera", () => {
    const command = renderCommand(page, two.shown, camera, [640, 480], false);
    const [first] = page.entries;
    const colours = `--colour '${first?.colour.toUpperCase()}' --colour '#12AB00'`;
    expect(command).toContain(`--object 1@10 --object 2@20.5 ${colours} --opacity 1 --opacity 0.5`);
    expect(command).toContain("--eye=-1,2,3 --target=0,0,0.5 --height 12.5 --perspective --size 640x480 --plain -o scene.png");
  });
  it("says what is up, unless it is z", () => {
    const command = (up: number[]): string => renderCommand(page, two.shown, { ...camera, up }, [9, 9], false);
    const up = (direction: number[]): string => / --up=\S+/.exec(command(direction))?.[0] ?? "";
    expect([up([0, 0, 1]), up([0, 0, -1]), up([-1, 0, 0])]).toEqual(["", " --up=-z", " --up=-x"]);
    expect(up([0.6, 0, 0.8])).toBe(" --up=0.6,0,0.8");
  });
  it("follows the order of the command line, omits hidden objects, and clips", () => {
    const all = add({ ...two, shown: two.shown.map((one, i) => ({ ...one, visible: i > 0 })) }, -1, 7);
    const cut = { normal: [-0.6, 0, 0.8], offset: -3 };
    expect(renderCommand(page, all.shown, { ...camera, flat: true, cut }, [9, 9], true)).toMatch(
      /--tau 7 --object 2@20.5 --colour '#999999' --colour '#12AB00' .*--height 12.5 --cut='-0.6x\+0.8z>-3' --size 9x9 --background dark/,
    );
  });
});

describe("a scene as a file", () => {
  it("is the same after reading it", () => {
    expect(readScene(page, writeScene(page, two))).toEqual(two);
    expect(readScene(page, writeScene(page, NOTHING))).toEqual(NOTHING);
    const old = writeScene(page, NOTHING).replace('"parts": {}', '"parts": { "matter": "2" }'); // its key before version 0.2
    expect(readScene(page, old).parts).toEqual({ volume: "2" });
  });
  it.skipIf(!existsSync(schemaFile))("conforms to its schema", () => {
    const schema = JSON.parse(readFileSync(schemaFile, "utf8")) as {
      required: string[];
      properties: { shown: { items: { required: string[]; properties: object } } };
    };
    const file = JSON.parse(writeScene(page, two)) as { shown: object[] };
    expect(Object.keys(file).sort()).toEqual([...schema.required].sort());
    const { required, properties } = schema.properties.shown.items;
    for (const shown of file.shown) expect(Object.keys(shown)).toEqual(expect.arrayContaining(required));
    for (const shown of file.shown) expect(Object.keys(properties)).toEqual(expect.arrayContaining(Object.keys(shown)));
  });
  it("is rejected with the position and what was expected", () => {
    const good = JSON.parse(writeScene(page, two)) as Record<string, unknown> & { shown: Record<string, unknown>[] };
    const [first, second] = good.shown;
    const cases: [unknown, string][] = [
      [[], 'no "schema"'],
      [3, "an object was expected"],
      [{ ...good, schema: "isoatlas/scene/2" }, 'this viewer reads "isoatlas/scene/1"'],
      [{ ...good, volume: { name: "x", size: [1, 2, 3] } }, "a volume of 1 x 2 x 3 samples"],
      [{ ...good, shown: [{ ...first, tau: "high" }] }, 'shown[0].tau is "high"; a number'],
      [{ ...good, shown: [{ ...first, opacity: 2 }] }, "shown[0].opacity is 2; a number from 0 to 1"],
      [{ ...good, shown: [first, { ...second, colour: "red" }] }, "shown[1].colour"],
      [{ ...good, shown: [{ ...first, id: 1e9 }] }, "of another volume"],
      [{ ...good, shown: [{ ...first, entry: 400_000 }] }, "shown[0].entry is 400000"],
      [{ ...good, shown: [first, first] }, "shown[1] is a duplicate"],
      [{ ...good, shown: 7 }, "shown is 7; a list"],
      [{ ...good, selected: 2 }, "selected is 2"],
      [{ ...good, view: [1, 2] }, "view has 2 numbers"],
      [{ ...good, parts: { nothing: "1" } }, "parts.nothing"],
    ];
    for (const [file, says] of cases) expect(() => readScene(page, JSON.stringify(file)), says).toThrow(says);
    expect(() => readScene(page, "{")).toThrow("This is not JSON");
  });
});

describe("the table", () => {
  it("has a line for every object, and quotes where needed", () => {
    const lines = tableCsv(page, two).trimEnd().split("\r\n");
    expect(lines.length).toBe(page.entries.length + 1);
    expect(lines[1]?.split(",").slice(0, 5)).toEqual(["Object 1", "1", `v${page.entries[0]?.id}`, "object", String(page.entries[0]?.tau)]);
    expect(lines[2]?.endsWith(",20.5")).toBe(true);
    expect(['a"b', "a,b", null, 3].map(cell)).toEqual(['"a""b"', '"a,b"', "", "3"]);
  });
});

describe("an animated PNG", () => {
  const chunk = (type: string, bytes: Uint8Array): Buffer => {
    const length = Buffer.alloc(4);
    length.writeUInt32BE(bytes.length);
    return Buffer.concat([length, Buffer.from(type), bytes, Buffer.alloc(4)]);
  };
  const picture = (side: number, grey: number): Uint8Array => {
    const header = Buffer.from([0, 0, 0, side, 0, 0, 0, side, 8, 0, 0, 0, 0]);
    const lines = deflateSync(Buffer.concat(Array.from({ length: side }, () => Buffer.from([0, ...new Array<number>(side).fill(grey)]))));
    return new Uint8Array(
      Buffer.concat([
        Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]),
        chunk("IHDR", header),
        chunk("IDAT", lines),
        chunk("IEND", Buffer.alloc(0)),
      ]),
    );
  };
  it("contains the data of all frames in order", () => {
    const frames = [1, 2, 3].map((grey) => picture(2, grey));
    const chunks = chunksOf(animatedPng(frames, 12));
    expect(chunks.map(({ type }) => type)).toEqual(["IHDR", "acTL", "fcTL", "IDAT", "fcTL", "fdAT", "fcTL", "fdAT", "IEND"]);
    expect(chunks[2]?.bytes.length).toBe(26);
    expect([...(chunks[1]?.bytes ?? [])]).toEqual([0, 0, 0, 3, 0, 0, 0, 0]);
    expect(chunks.filter(({ type }) => type === "fcTL" || type === "fdAT").map(({ bytes }) => bytes[3])).toEqual([0, 1, 2, 3, 4]);
    expect(Buffer.from(chunks[7]?.bytes.subarray(4) ?? [])).toEqual(Buffer.from(chunksOf(frames[2] as Uint8Array)[1]?.bytes ?? []));
  });
  it("rejects frames of different size or type", () => {
    expect(() => animatedPng([picture(2, 1), picture(3, 1)], 12)).toThrow("size");
    expect(() => animatedPng([new Uint8Array(20)], 12)).toThrow("not a PNG");
  });
});

describe("the palette", () => {
  // Simulated dichromats: Machado, Oliveira, Fernandes 2009, table 1, severity 1, of linear red, green, blue.
  const eyes: Record<string, number[][]> = {
    all: [
      [1, 0, 0],
      [0, 1, 0],
      [0, 0, 1],
    ],
    protanopia: [
      [0.152286, 1.052583, -0.204868],
      [0.114503, 0.786281, 0.099216],
      [-0.003882, -0.048116, 1.051998],
    ],
    deuteranopia: [
      [0.367322, 0.860646, -0.227968],
      [0.280085, 0.672501, 0.047413],
      [-0.01182, 0.04294, 0.968881],
    ],
    tritanopia: [
      [1.255528, -0.076749, -0.178779],
      [-0.078411, 0.930809, 0.147602],
      [0.004733, 0.691367, 0.3039],
    ],
  };
  const linear = (hex: string): number[] =>
    [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16) / 255).map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4));
  const times = (matrix: number[][], v: number[]): number[] => matrix.map((row) => row.reduce((sum, m, i) => sum + m * (v[i] ?? 0), 0));
  const lab = (rgb: number[]): [number, number, number] => {
    const [x = 0, y = 0, z = 0] = times(
      [
        [0.4124, 0.3576, 0.1805],
        [0.2126, 0.7152, 0.0722],
        [0.0193, 0.1192, 0.9505],
      ],
      rgb.map((c) => Math.min(Math.max(c, 0), 1)),
    );
    const [fx, fy, fz] = [x / 0.9505, y, z / 1.089].map((t) => (t > 0.008856 ? Math.cbrt(t) : 7.787 * t + 16 / 116)) as [
      number,
      number,
      number,
    ];
    return [116 * fy - 16, 500 * (fx - fy), 200 * (fy - fz)];
  };
  it("is distinct for all kinds of colour vision", () => {
    for (const [eye, matrix] of Object.entries(eyes)) {
      const seen = PALETTE.map(([name, colour]) => ({ name, lab: lab(times(matrix, linear(colour))) }));
      for (const p of seen)
        for (const q of seen)
          if (p !== q)
            expect(Math.hypot(...p.lab.map((c, i) => c - (q.lab[i] ?? 0))), `${p.name} and ${q.name}, ${eye}`).toBeGreaterThan(11);
    }
  });
});
