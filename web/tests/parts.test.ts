import { describe, expect, it } from "vitest";
import { Axis, histogramPath } from "../src/axis";
import { chosen } from "../src/controls";
import { plural, value, volume } from "../src/format";
import { contentsOf, describe as said, nameOf, rangeOf } from "../src/names";
import { lanesOf } from "../src/overview";
import { readPage } from "../src/page";
import { page, scene } from "./sample";

describe("numbers", () => {
  it("have about four digits", () => {
    expect([0, 627.2656, 12345.6, 0.00012, 2.5e7, -3.25].map(value)).toEqual(["0", "627.3", "12346", "1.20e-4", "2.50e7", "-3.25"]);
  });
  it("count things", () => {
    expect(plural(0, "tunnel")).toBe("no tunnels");
    expect(plural(1, "cavity", "cavities")).toBe("1 cavity");
    expect(plural(12345, "voxel")).toBe("12,345 voxels");
  });
  it("take the largest unit in which a volume is at least 1", () => {
    expect(volume(2500, "mm")).toBe("2.5 cm³");
    expect(volume(999, "mm")).toBe("999 mm³");
    expect(volume(12, null)).toBe("12 voxels");
    expect(volume(12, "units")).toBe("12 units³");
  });
});

describe("the axis", () => {
  it("maps isovalues there and back", () => {
    const axis = new Axis(-100, 300, 1000, 20);
    for (const tau of [-100, 0, 17.5, 300]) expect(axis.tau(axis.x(tau))).toBeCloseTo(tau);
    expect(axis.x(1e9)).toBe(980);
  });
  it("has round ticks within its range, also for one value", () => {
    expect(new Axis(0, 255, 100).ticks(6)).toEqual([0, 50, 100, 150, 200, 250]);
    expect(new Axis(0.1, 0.3, 100).ticks(4)).toEqual([0.1, 0.15, 0.2, 0.25, 0.3]);
    expect(new Axis(5, 5, 100).ticks(4)).toEqual([5]);
  });
  it("draws a closed histogram", () => {
    expect(histogramPath({ low: 0, high: 2, counts: [0, 9] }, new Axis(0, 2, 100), 0, 50)).toBe("M0.0 50L0.0 50.0L50.0 50.0L50.0 0.0L100.0 0.0L100.0 50Z");
  });
});

describe("objects", () => {
  it("of one branch share a lane, and what merges into them lies below", () => {
    expect(lanesOf(scene)).toEqual([0, 0, 1, 2]);
    expect(lanesOf(page([]))).toEqual([]);
  });
  it("are sorted and filtered, ties by rank", () => {
    expect(chosen(scene, "rank", "all", 0)).toEqual([0, 1, 2, 3]);
    expect(chosen(scene, "size", "all", 0)).toEqual([0, 1, 3, 2]);
    expect(chosen(scene, "size", "bright", 50)).toEqual([0, 1]);
    expect(chosen(scene, "cavities", "dark", 0)).toEqual([3]);
  });
  it("have names and sentences", () => {
    expect(nameOf(scene, 3)).toBe("Dark object 4");
    expect(said(scene, 0)).toBe("Object 1 at isovalue 50: 10 cm³, 2 tunnels, no cavities");
    expect(rangeOf(scene.objects[2]!)).toBe("30 to 95");
    expect(contentsOf(scene, 0)).toEqual([1, 2]);
  });
});

describe("data", () => {
  it("of another version are refused", () => {
    expect(readPage("null")).toBeNull();
    expect(() => readPage('{"schema":"isoatlas/page/2"}')).toThrow("isoatlas/page/2");
  });
});
