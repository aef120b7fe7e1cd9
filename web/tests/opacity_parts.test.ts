// Opacity curves: their table against the sum of tents, their text, edits, presets, and the command line.
import { describe, expect, it } from "vitest";
import { layersOf, meanBetween, PLACES, transferTable, type OpacityTent } from "../src/viewer/api/transfer_function";
import { readScene, writeScene } from "../src/viewer/export/scene_file";
import { fromHash, toHash } from "../src/viewer/state/address";
import { colourOfLight, linearOf } from "../src/viewer/state/light";
import {
  addPoint,
  cutOff,
  extinctionOf,
  highestOpacity,
  layersIn,
  layersText,
  matterAt,
  movePoint,
  opacityOf,
  removePoint,
  scaledBy,
  type CurvePoint,
  type Layer,
} from "../src/viewer/state/opacity_curve";
import { renderOptions } from "../src/viewer/state/render_options";
import { isHounsfield } from "../src/viewer/state/hounsfield";
import { GREY } from "../src/viewer/state/slice_state";
import { NOTHING, shownAt, type State } from "../src/viewer/state/state";
import { VOLUME_CURVE, VOLUME_DENSITY, voxelLength } from "../src/viewer/state/volume_state";
import { presetsOf } from "../src/viewer/tools/opacity_presets";
import { madeTransparent, opaqueOf } from "../src/viewer/tools/hidden_volume_note";
import { scene as page } from "./sample";
import { tableOfTents } from "./tents";

/** Numbers from 0 to 1, the same in every run. */
function randomNumbers(seed: number): () => number {
  let state = seed;
  return () => (state = (state * 1103515245 + 12345) % 2147483648) / 2147483648;
}

function anyTents(random: () => number): OpacityTent[] {
  const colours = ["#ff8000", "#0072b2", "#ffffff", "#009e73"];
  return Array.from({ length: 1 + Math.floor(random() * 6) }, () => {
    const low = -30 + 120 * random();
    return {
      tau: Math.floor(3 * random()),
      low,
      high: low + 0.5 + 60 * random(),
      ramp: random() < 0.2 ? 0 : 0.5 * random(),
      density: 0.01 + random(),
      colour: colours[Math.floor(random() * colours.length)]!,
    };
  });
}

const points: CurvePoint[] = [
  { value: 20, opacity: 0, colour: "#ff0000" },
  { value: 40, opacity: 0.5, colour: "#ff0000" },
  { value: 80, opacity: 0.1, colour: "#0000ff" },
];
const layer: Layer = { points, visible: true, tau: null };

describe("layers of the tents of the tree", () => {
  it("have the table of the sum of the tents, for any tents and any voxel", () => {
    const random = randomNumbers(7);
    for (let run = 0; run < 200; ++run) {
      const byTau = new Map<number, string>(); // tents of an object have its colour
      const tents = anyTents(random).map((tent) => {
        if (!byTau.has(tent.tau)) byTau.set(tent.tau, tent.colour);
        return { ...tent, colour: byTau.get(tent.tau)! };
      });
      const [low, high, voxel] = [-10 + 20 * random(), 60 + 40 * random(), 0.1 + random()];
      const expected = tableOfTents(tents, low, high);
      const table = transferTable(layersOf(tents, low, high, voxel), low, high, voxel);
      const largest = Math.max(...expected.map(Math.abs), 1);
      const off = Math.max(...table.map((n, i) => Math.abs(n - expected[i]!)));
      expect(off / largest, `run ${run}`).toBeLessThan(1e-6); // of 32 bit floats
    }
  });
  it("have it after they were written in a link, to its seven digits", () => {
    const tents: OpacityTent[] = [
      { tau: 300, low: 250.123456, high: 700, ramp: 0.3, density: 0.31, colour: "#d55e00" },
      { tau: 300, low: 250.123456, high: 1500, ramp: 0.1, density: 0.004, colour: "#d55e00" },
      { tau: 1200, low: 1150, high: 4000, ramp: 0.05, density: 1.7, colour: "#f0e442" },
    ];
    const layers = layersOf(tents, 0, 3926, 1.5);
    expect(layers.map(({ tau }) => tau)).toEqual([300, 1200]);
    const read = layersIn(layersText(layers))!;
    const [table, again] = [layers, read].map((some) => transferTable(some, 0, 3926, 1.5));
    const largest = Math.max(...table!);
    expect(Math.max(...table!.map((n, i) => Math.abs(n - again![i]!))) / largest).toBeLessThan(1e-6);
  });
  it("are listed by object, and end at the ends of the values", () => {
    const solid: OpacityTent = { tau: 5, low: 90, high: 110, ramp: 0.1, density: 0.2, colour: "#ffffff" };
    const [one] = layersOf([solid], 0, 100, 1);
    expect(one!.points.at(-1)).toEqual({ value: 100, opacity: expect.closeTo(1 - Math.exp(-0.2), 9), colour: "#ffffff" });
    expect(layersOf([{ ...solid, low: 200, high: 300 }], 0, 100, 1)).toEqual([]);
  });
});

describe("an opacity curve", () => {
  it("has an extinction, and an extinction times light, that are linear between its points", () => {
    const table = transferTable([layer], 0, 102.4, 2);
    for (const value of [25, 39, 45, 60, 79]) {
      const mean = meanBetween(table, 10 * value - 1, 10 * value + 1);
      const { extinction, light } = matterAt(points, value);
      const expected = [...light.map((part) => part * extinction), extinction].map((n) => n / 2);
      mean.forEach((part, i) => expect(part, `${value} ${i}`).toBeCloseTo(expected[i]!, 4));
    }
    const [red, , blue] = matterAt(points, 60).light;
    const [p, q] = [extinctionOf(0.5), extinctionOf(0.1)];
    expect([red, blue]).toEqual([expect.closeTo(p / (p + q), 9), expect.closeTo(q / (p + q), 9)]);
    expect([matterAt(points, 19).extinction, matterAt(points, 81).extinction]).toEqual([0, 0]);
    expect(meanBetween(transferTable([{ ...layer, visible: false }], 0, 102.4, 2), 0, PLACES)[3]).toBe(0);
  });
  it("has opacities of a voxel: twice its length absorbs twice", () => {
    for (const opacity of [0, 0.01, 0.5, 0.999]) expect(opacityOf(extinctionOf(opacity))).toBeCloseTo(opacity, 12);
    const [one, two] = [1, 2].map((voxel) => meanBetween(transferTable([layer], 0, 102.4, voxel), 400, 401)[3]);
    expect(one! / two!).toBeCloseTo(2, 6);
  });
  it("jumps where two points have one value", () => {
    const jump = [
      points[0]!,
      { ...points[0]!, value: 50 },
      { ...points[0]!, value: 50, opacity: 0.3 },
      { ...points[0]!, value: 100, opacity: 0.3 },
    ];
    const table = transferTable([{ ...layer, points: jump }], 0, 102.4, 1);
    expect(meanBetween(table, 300, 499)[3]).toBe(0);
    expect(meanBetween(table, 501, 900)[3]).toBeCloseTo(extinctionOf(0.3), 4);
  });
  it("stays the same when a point is added on it", () => {
    const { points: more, at } = addPoint(points, 50)!;
    expect(at).toBe(2);
    expect(more.map(({ value }) => value)).toEqual([20, 40, 50, 80]);
    const [before, after] = [points, more].map((some) => transferTable([{ ...layer, points: some }], 0, 100, 1));
    const off = Math.max(...before!.map((n, i) => Math.abs(n - after![i]!)));
    expect(off / Math.max(...before!)).toBeLessThan(5e-3); // a colour has 8 bits
    expect(
      addPoint(
        Array.from({ length: 64 }, (_, i) => ({ ...points[0]!, value: i })),
        50,
      ),
    ).toBeNull();
    expect(addPoint(points, 90, 0.25)!.points.at(-1)).toMatchObject({ value: 90, opacity: 0.25 });
  });
  it("keeps the order of its points, and two of them", () => {
    expect(movePoint(points, 1, 95, 2)[1]).toEqual({ value: 80, opacity: 0.999, colour: "#ff0000" });
    expect(movePoint(points, 1, -5, -1)[1]).toEqual({ value: 20, opacity: 0, colour: "#ff0000" });
    expect(movePoint(points, 0, -5, 0.2)[0]!.value).toBe(-5);
    expect(removePoint(points, 1)).toHaveLength(2);
    expect(removePoint(removePoint(points, 1), 0)).toHaveLength(2);
  });
  it("is scaled in its extinction", () => {
    expect(scaledBy(points, 2)[1]!.opacity).toBeCloseTo(0.75, 12);
    expect(highestOpacity(scaledBy(points, 0.5))).toBeCloseTo(1 - Math.SQRT1_2, 12);
  });
  it("is cut off without changing what is left", () => {
    const rest = cutOff(points, 30, 60);
    expect(rest.map(({ value }) => value)).toEqual([30, 40, 60]);
    for (const value of [30, 35, 50, 60])
      expect(matterAt(rest, value).extinction).toBeCloseTo(matterAt(points, value).extinction, 12);
  });
  it("converts colours without loss", () => {
    for (const colour of ["#000000", "#010203", "#7f8081", "#d55e00", "#ffffff"])
      expect(colourOfLight(linearOf(colour))).toBe(colour);
  });
});

describe("an opacity curve in a link", () => {
  const layers: Layer[] = [
    { points, visible: true, tau: null },
    { points: points.map((point) => ({ ...point, colour: "#00ff00" })), visible: false, tau: -12.5 },
  ];
  const text = "20:0:ff0000,40:0.5,80:0.1:0000ff;!-12.5@20:0:00ff00,40:0.5,80:0.1";
  it("is a short text that is read back", () => {
    expect(layersText(layers)).toBe(text);
    expect(layersIn(text)).toEqual(layers);
    const state = VOLUME_CURVE.with(VOLUME_DENSITY.with(NOTHING, 2), layers);
    expect(toHash(state)).toBe(`#scene=&selected=-1&curve=${text}&volume=2`);
    expect(VOLUME_CURVE.of(fromHash(toHash(state), 3)!)).toEqual(layers);
    expect(VOLUME_CURVE.with(state, null).parts).toEqual({ volume: "2" });
  });
  it("is in the scene file, which rejects an invalid one by its name", () => {
    const text = writeScene(page, VOLUME_CURVE.with(NOTHING, layers));
    expect(VOLUME_CURVE.of(readScene(page, text))).toEqual(layers);
    const wrong = text.replace(layersText(layers), "1:0:ffffff,2:7");
    expect(wrong).not.toBe(text);
    expect(() => readScene(page, wrong)).toThrow('parts.curve is "1:0:ffffff,2:7"');
  });
  it("is rejected when it is invalid", () => {
    const bad = [
      "",
      "1:0:ffffff",
      "1:0,2:0.5",
      "1:0:ffffff,2",
      "1:0:ffffff,2:1",
      "1:0:ffffff,2:-0.1",
      "2:0:ffffff,1:0.5",
      "1:0:fff,2:0.5",
      "1:0:FFFFFF,2:0.5",
      "1:0:ffffff,x:0.5",
      "1:0:ffffff,2:0.5:ffffff:1",
      "x@1:0:ffffff,2:0.5",
      "@1:0:ffffff,2:0.5",
      "!!1:0:ffffff,2:0.5",
      "1:0:ffffff,2:0.5;",
      Array.from({ length: 65 }, (_, i) => `${i}:0:ffffff`).join(","),
      Array.from({ length: 17 }, () => "1:0:ffffff,2:0.5").join(";"),
    ];
    for (const wrong of bad) expect(VOLUME_CURVE.accepts(wrong), wrong).toBe(false);
    expect(fromHash("#scene=&curve=1:2:3&volume=1", 0)?.parts).toEqual({ volume: "1" });
  });
});

describe("the command line of an opacity curve", () => {
  const state = VOLUME_CURVE.with(VOLUME_DENSITY.with(NOTHING, 2), [layer, { ...layer, visible: false }]);
  it("has an option for each visible layer, with the density in its opacities", () => {
    expect(renderOptions(page, state)).toEqual(["--transfer='20:0:#FF0000,40:0.75,80:0.19:#0000FF'"]);
    expect(renderOptions(page, VOLUME_CURVE.with(state, [{ ...layer, visible: false }]))).toEqual([]);
  });
  it("is that of the proposal, or --volume before it is known", () => {
    const on = VOLUME_DENSITY.with(NOTHING, 1);
    expect(renderOptions(page, on)).toEqual(["--volume"]);
    expect(renderOptions(page, on, [layer])).toEqual(["--transfer='20:0:#FF0000,40:0.5,80:0.1:#0000FF'"]);
    expect(renderOptions(page, NOTHING, [layer])).toEqual([]);
  });
  it("refers to the smallest distance of two samples", () => {
    expect(voxelLength({ volume: { ...page.volume, spacing: [3, 0.5, 2] } })).toBe(0.5);
  });
});

describe("presets", () => {
  const volume = { ...page.volume, type: "int16", low: -1024, high: 2000, valueUnit: "HU" };
  const hu = { ...page, volume, axis: { low: -1024, high: 2000, bend: null } };
  const selected: State = { ...NOTHING, shown: [shownAt(0, 60)], selected: 0 };
  const named = (of: typeof page, state: State): string[] => presetsOf(of, state).map(({ name }) => name);
  it("are a ramp over the window of the slices, and the values beyond the selected isovalue", () => {
    expect(named(page, NOTHING)).toEqual(["Ramp over window"]);
    expect(named(page, selected)).toEqual(["Ramp over window", "Only ≥ 60"]);
    const [ramp, only] = presetsOf(page, GREY.with(selected, [30, 50]));
    expect(ramp!.layers[0]!.points.map(({ value }) => value)).toEqual([30, 50, page.axis.high]);
    expect(matterAt(only!.layers[0]!.points, 58).extinction).toBe(0);
    expect(matterAt(only!.layers[0]!.points, 60).extinction).toBeGreaterThan(0.3);
    const low = presetsOf({ ...page, polarity: "low" }, { ...selected, shown: [shownAt(-1, 60)] });
    expect(low.map(({ name }) => name)).toContain("Only ≤ 60");
  });
  it("of CT are there for Hounsfield units only, and say so where the file does not", () => {
    expect([isHounsfield(hu), isHounsfield(page)]).toEqual([true, false]);
    expect(named(hu, NOTHING)).toEqual(["Ramp over window", "CT bone", "CT soft tissue", "CT lung"]);
    const unsaid = { ...hu, volume: { ...hu.volume, valueUnit: null } };
    expect(isHounsfield(unsaid)).toBeNull();
    expect(presetsOf(unsaid, NOTHING).at(-1)!.title).toContain("if the values are Hounsfield units");
    const shifted = { ...unsaid, volume: { ...unsaid.volume, low: 0, high: 3926 }, axis: { low: 0, high: 3926, bend: null } };
    expect(isHounsfield(shifted)).toBe(false);
    expect(named(shifted, NOTHING)).toEqual(["Ramp over window"]);
    expect(named({ ...hu, axis: { low: -1024, high: 100, bend: null } }, NOTHING)).not.toContain("CT bone");
  });
  it("are valid curves", () => {
    for (const { name, layers } of presetsOf(hu, selected)) {
      expect(layersIn(layersText(layers)), name).not.toBeNull();
      for (const { value } of layers[0]!.points) expect(value >= -1024 && value <= 2000, name).toBe(true);
    }
  });
});

describe("surfaces that hide the volume", () => {
  const state: State = {
    ...NOTHING,
    shown: [shownAt(0, 1), { ...shownAt(1, 2), opacity: 0.5 }, { ...shownAt(2, 3), visible: false }],
  };
  it("are the opaque ones in view", () => {
    expect(opaqueOf(state)).toEqual([shownAt(0, 1)]);
    expect(madeTransparent(state).shown.map(({ opacity }) => opacity)).toEqual([0.35, 0.5, 1]);
    expect(opaqueOf(madeTransparent(state))).toEqual([]);
  });
});
