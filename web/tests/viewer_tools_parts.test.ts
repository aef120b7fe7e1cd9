import { describe, expect, it } from "vitest";
import { facesOf } from "../src/viewer/state/directions";
import { fromHash } from "../src/viewer/state/address";
import { renderOptions } from "../src/viewer/state/render_options";
import { march } from "../src/viewer/scene/compositing";
import { CUT, moved, outlineOf, planeOf, turned } from "../src/viewer/state/cut_plane";
import { acrossAndDown, AXES, distance, dot, Grid, type AxisNumber, type Triple } from "../src/viewer/state/grid";
import { innermostFirst } from "../src/viewer/api/locate";
import { linearOf } from "../src/viewer/state/light";
import { VOLUME_DENSITY, VOLUME_OPTICS } from "../src/viewer/state/volume_state";
import { angleOf, arcOf, lengthOf, MEASURES } from "../src/viewer/state/measures";
import { SlicedMesh } from "../src/viewer/scene/plane_cut";
import { clipped, firstHit } from "../src/viewer/scene/ray";
import { CROSSHAIR, greyRange, PLANES } from "../src/viewer/state/slice_state";
import { EVERYTHING } from "../src/viewer/api/entries";
import { Ruler } from "../src/viewer/state/ruler";
import { NOTHING } from "../src/viewer/state/state";
import { colouredAs, layersOf, meanBetween, PLACES, transferTable, type OpacityTent } from "../src/viewer/api/transfer_function";
import type { Mesh } from "../src/shared/wire";
import { decodeSlice, decodeVolume, greyOf, valueAt } from "../src/viewer/api/wire_samples";
import { scene } from "./sample";

/** Rotated around z by 30 degrees, with steps of 1, 1 and 2. */
const [cosine, sine] = [Math.cos(Math.PI / 6), Math.sin(Math.PI / 6)];
const tilted = new Grid({
  ...scene,
  volume: {
    ...scene.volume,
    size: [40, 40, 20],
    origin: [5, -3, 7],
    direction: [
      [cosine, -sine, 0],
      [sine, cosine, 0],
      [0, 0, 1],
    ],
  },
});
const straight = new Grid({ ...scene, volume: { ...scene.volume, size: [40, 40, 40], spacing: [1, 1, 1] } });
/** Steps that grow along x and z. */
const growing = Array.from({ length: 40 }, (_, i) => i * (0.5 + i / 40));
const uneven = new Grid({
  ...scene,
  volume: {
    ...scene.volume,
    size: [40, 40, 40],
    spacing: null,
    origin: [3, 0, -5],
    coordinates: [growing, growing.map((_, i) => i), growing],
  },
});

/** A closed ball of rings of points. */
function ball(middle: Triple, radius: number, pieces = 96): Mesh {
  const step = radius / 20_000;
  const places: Triple[] = [[0, 0, 1]];
  for (let i = 1; i < pieces / 2; ++i) {
    const up = (2 * Math.PI * i) / pieces;
    for (let j = 0; j < pieces; ++j)
      places.push([Math.sin(up) * Math.cos((2 * Math.PI * j) / pieces), Math.sin(up) * Math.sin((2 * Math.PI * j) / pieces), Math.cos(up)]);
  }
  places.push([0, 0, -1]);
  const corners: number[] = [];
  const last = places.length - 1;
  for (let i = 0; i + 2 < pieces / 2; ++i)
    for (let j = 0; j < pieces; ++j) {
      const [a, b] = [1 + i * pieces + j, 1 + i * pieces + ((j + 1) % pieces)];
      corners.push(a, a + pieces, b, b, a + pieces, b + pieces);
    }
  for (let j = 0; j < pieces; ++j) corners.push(0, 1 + j, 1 + ((j + 1) % pieces), last, last - 1 - j, last - 1 - ((j + 1) % pieces));
  const positions = Uint16Array.from(places.flatMap((place) => place.map((n) => Math.round((n * radius + 1.2 * radius) / step))));
  const origin = middle.map((n) => n - 1.2 * radius) as Triple;
  return {
    origin,
    step,
    positions,
    normals: new Int8Array(positions.length),
    corners: Uint32Array.from(corners),
    triangles: corners.length / 3,
    coarse: false, isOpen: false,
    bytes: 0,
  };
}

describe("the grid", () => {
  it("maps samples to space and back", () => {
    expect(tilted.place([0, 0, 0])).toEqual([5, -3, 7]);
    expect(distance(tilted.place([3, 4, 0]), tilted.place([0, 0, 0]))).toBeCloseTo(5);
    expect(tilted.rulers.map(({ finest }) => finest)).toEqual([1, 1, 2]);
    for (const sample of [
      [1, 2, 3],
      [-4, 0.5, 19],
    ])
      expect(tilted.sample(tilted.place(sample))).toEqual(sample.map((n) => expect.closeTo(n)));
    expect(tilted.nearest(tilted.place([3.4, 99, -1]))).toEqual([3, 39, 0]);
    expect(tilted.corners()[5]).toEqual(tilted.place([39, 0, 19]));
  });
  it("has the uneven steps of the file, extrapolated beyond its ends", () => {
    expect(uneven.place([0, 2, 20])).toEqual([3, 2, 15]);
    expect(uneven.place([39.5, 0, 0])[0]).toBeCloseTo(3 + growing[39]! + (growing[39]! - growing[38]!) / 2);
    for (const sample of [[1, 2, 3], [0.5, 38.25, 20.75], [-1, 41, 39]])
      expect(uneven.sample(uneven.place(sample))).toEqual(sample.map((n) => expect.closeTo(n)));
    expect(uneven.nearest([3 + 0.49 * growing[1]!, 99, -6])).toEqual([0, 39, 0]);
  });
  it("has even texels, each of the nearest sample", () => {
    const ruler = new Ruler(4, 9, [0, 1, 3, 4]);
    expect(ruler.texels(1)).toEqual({ samples: Uint32Array.of(0, 1, 2, 2, 3), low: -0.5, high: 4.5 });
    expect(ruler.texels(2)).toEqual({ samples: Uint32Array.of(0, 0, 1, 1, 1), low: -1, high: 4 });
    expect(new Ruler(5, 2, null).texels(2)).toEqual({ samples: Uint32Array.of(0, 1, 2), low: -2, high: 10 });
    expect(new Ruler(1, 2, [0]).texels(1)).toEqual({ samples: Uint32Array.of(0), low: -1, high: 1 });
    expect(new Ruler(3, 1, [0, 1, 1e6]).texels(1).samples.length).toBe(2048);
  });
});

describe("a contour on a slice", () => {
  it("is closed, lies on the slice, and encloses the area of a ball there", () => {
    for (const grid of [straight, tilted, uneven]) {
      const middle = grid.place([20, 20, 10]);
      const mesh = ball(middle, 8);
      for (const axis of AXES) {
        const index = [20, 20, 10][axis]! + 2;
        const pieces = new SlicedMesh(mesh, grid).cut(axis, index);
        const [u, v] = acrossAndDown(axis);
        const { rulers } = grid;
        const middleOf = (axis: AxisNumber): number => rulers[axis].length([20, 20, 10][axis]!);
        const apart = rulers[axis].length(index) - middleOf(axis);
        const seen = new Map<string, number>();
        let area = 0;
        for (let i = 0; i < pieces.length; i += 4) {
          const ends = [pieces.subarray(i, i + 2), pieces.subarray(i + 2, i + 4)].map(([a, b]) => {
            const sample: Triple = [index, index, index];
            [sample[u], sample[v]] = [rulers[u].sample(a!), rulers[v].sample(b!)];
            expect(Math.abs(distance(grid.place(sample), middle) - 8)).toBeLessThan(0.02);
            const key = `${a!.toFixed(3)} ${b!.toFixed(3)}`;
            seen.set(key, (seen.get(key) ?? 0) + 1);
            return [a! - middleOf(u), b! - middleOf(v)] as const;
          });
          area += Math.abs(ends[0]![0] * ends[1]![1] - ends[0]![1] * ends[1]![0]) / 2;
        }
        expect([...seen.values()].every((count) => count % 2 === 0)).toBe(true);
        expect(area).toBeCloseTo(Math.PI * (64 - apart * apart), -0.5);
      }
      expect(new SlicedMesh(mesh, grid).cut(0, 0).length).toBe(0);
    }
  });
});

describe("a ray", () => {
  const mesh = ball([10, 0, 0], 2);
  const along = { origin: [0, 0, 0] as Triple, direction: [1, 0, 0] as Triple, begin: 0, end: Infinity };
  it("hits the near side first", () => {
    expect(firstHit(mesh, along)).toBeCloseTo(8, 1);
    expect(firstHit(mesh, { ...along, begin: 9 })).toBeCloseTo(12, 1);
    expect(firstHit(mesh, { ...along, end: 7 })).toBeNull();
    expect(firstHit(mesh, { ...along, direction: [0, 1, 0] })).toBeNull();
    expect(firstHit(mesh, { ...along, begin: 13 })).toBeNull();
  });
  it("is clipped by a plane", () => {
    expect(firstHit(mesh, clipped(along, [1, 0, 0], -10))).toBeCloseTo(12, 1);
    expect(firstHit(mesh, clipped(along, [-1, 0, 0], 10))).toBeCloseTo(8, 1);
    expect(firstHit(mesh, clipped(along, [0, 1, 0], -1))).toBeNull();
  });
});

describe("the clipping plane", () => {
  const corners = straight.corners();
  it("keeps a fraction of the volume", () => {
    expect(planeOf([1, 0, 0, 1], corners)).toEqual({ normal: [1, 0, 0], constant: 0 });
    expect(planeOf([1, 0, 0, 0.25], corners).constant).toBeCloseTo(-29.25);
    expect(moved([1, 0, 0, 0.25], 3.9, corners)[3]).toBeCloseTo(0.15);
    expect(moved([1, 0, 0, 0.25], 39, corners)[3]).toBe(0);
    const [there, back] = [planeOf([0, 1, 0, 0.3], corners), planeOf(turned([0, 1, 0, 0.3]), corners)];
    expect(dot(there.normal, [0, 5, 0]) + there.constant).toBeCloseTo(-(dot(back.normal, [0, 5, 0]) + back.constant));
  });
  it("has an outline in the box of the volume", () => {
    expect(outlineOf(planeOf([0, 0, 1, 0.5], corners), corners).length).toBe(4);
    const sixth = outlineOf(planeOf([1, 1, 1, 0.5].map((n, i) => (i < 3 ? n / Math.sqrt(3) : n)), corners), corners);
    expect(sixth.length).toBe(6);
    for (let i = 0; i < 6; ++i) expect(distance(sixth[i]!, sixth[(i + 1) % 6]!)).toBeCloseTo(19.5 * Math.SQRT2);
    expect(outlineOf({ normal: [1, 0, 0], constant: -99 }, corners)).toEqual([]);
  });
  it("needs a direction", () => {
    for (const bad of ["1,0,0", "1,1,0,0.5", "0,0,0,0.5", "1,0,0,1.5", "1,0,0,x", ""]) expect(CUT.accepts(bad), bad).toBe(false);
    expect(CUT.of(CUT.with(NOTHING, [0, 0.6, 0.8, 0.25]))).toEqual([0, 0.6, 0.8, 0.25]);
  });
});

describe("measures", () => {
  it("are lengths and angles", () => {
    expect(lengthOf([[1, 2, 3], [4, 6, 3]])).toBe(5);
    expect(angleOf([[1, 0, 0], [0, 0, 0], [0, 2, 0]])).toBeCloseTo(90);
    expect(angleOf([[1, 0, 0], [0, 0, 0], [-3, 0, 0]])).toBeCloseTo(180);
    expect(angleOf([[0, 0, 0], [0, 0, 0], [1, 0, 0]])).toBe(0);
    const arc = arcOf([[2, 0, 0], [0, 0, 0], [0, 4, 0]], 0.5, 2);
    expect(arc.map((place) => place.map((n) => Number(n.toFixed(6))))).toEqual([[1, 0, 0], [0.707107, 0.707107, 0], [0, 1, 0]]);
    expect(arcOf([[2, 0, 0], [0, 0, 0], [5, 0, 0]])).toEqual([]);
  });
  it("are part of an address", () => {
    const measures = [[[1, 2, 3], [4, 5, 6]], [[0.5, 0, 0], [0, -7, 0], [0, 0, 9]]] as Triple[][];
    expect(MEASURES.of(MEASURES.with(NOTHING, measures))).toEqual(measures);
    for (const bad of ["1,2,3", "1,2,3,4,5", "1,2,3,4,5,x", "1,2,3,4,5,6;", Array(101).fill("1,2,3,4,5,6").join(";")])
      expect(MEASURES.accepts(bad), bad).toBe(false);
  });
});

describe("samples", () => {
  function bytesOf(magic: string, header: (view: DataView) => void, samples: number[]): ArrayBuffer {
    const bytes = new ArrayBuffer(40 + samples.length);
    new Uint8Array(bytes).set([...magic].map((c) => c.charCodeAt(0)));
    header(new DataView(bytes));
    new Uint8Array(bytes).set(samples, 40);
    return bytes;
  }
  const header = (view: DataView): void => {
    [2, 3, 2, 0].forEach((n, i) => view.setUint32(4 + 4 * i, n, true));
    view.setFloat64(24, 0.5, true);
    view.setFloat64(32, -1, true);
  };
  it("of a slice have values in units of the file", () => {
    const slice = decodeSlice(bytesOf("ias1", header, [0, 10, 20, 30, 40, 50]), 1, 7);
    expect(valueAt(slice, [2, 7, 4])).toBe(24);
    expect(valueAt(slice, [1, 7, 4])).toBeNull();
    expect(valueAt(slice, [2, 6, 4])).toBeNull();
    expect(valueAt(slice, [4, 7, 0])).toBeNull();
    expect([...greyOf(slice, Uint32Array.of(0, 1), Uint32Array.of(0, 1, 2), -1, 24)].filter((_, i) => i % 4 === 0)).toEqual([
      0, 51, 102, 153, 204, 255,
    ]);
    const twice = greyOf(slice, Uint32Array.of(1, 1), Uint32Array.of(2), -1, 24);
    expect([...twice]).toEqual([255, 255, 255, 255, 255, 255, 255, 255]);
    expect(() => decodeSlice(bytesOf("ias1", header, [0]), 1, 7)).toThrow("incomplete");
    expect(() => decodeSlice(bytesOf("iav1", header, [0, 1, 2, 3, 4, 5]), 1, 7)).toThrow("not a slice");
  });
  it("of a volume have a byte each", () => {
    const volume = decodeVolume(
      bytesOf("iav1", (view) => [1, 2, 3, 4].forEach((n, i) => view.setUint32(4 + 4 * i, n, true)), [1, 2, 3, 4, 5, 6]),
    );
    expect([volume.size, volume.step, volume.bytes[5]]).toEqual([[1, 2, 3], 4, 6]);
    expect(() => decodeVolume(new ArrayBuffer(10))).toThrow("not a volume");
  });
  it("are grey between the 0.5 % and 99.5 % quantiles", () => {
    const of = (edges: number[], counts: number[], low: number, high: number): number[] =>
      greyRange({ histogram: { edges, counts }, axis: { low, high, bend: null } });
    expect(of([0, 1, 2, 3], [1, 998, 1], 0, 3)).toEqual([expect.closeTo(1.004, 3), expect.closeTo(1.996, 3)]);
    expect(of([-0.5, 0.5, 100.5], [1000, 1000], 0, 100)).toEqual([0, 99.5]);
    expect(of([4, 4], [7], 4, 4)).toEqual([4, 4]);
  });
});

describe("objects that contain a sample", () => {
  it("are listed from the inside", () => {
    expect(innermostFirst(scene, [0, EVERYTHING, 1, 2])).toEqual([2, 1, 0, EVERYTHING]);
  });
});

describe("slices and the volume", () => {
  it("are options of the render command", () => {
    expect(renderOptions(scene, NOTHING)).toEqual([]);
    const slices = CROSSHAIR.with(PLANES.with(NOTHING, true), [3, 4, 99]);
    expect(renderOptions(scene, VOLUME_DENSITY.with(slices, 0.5))).toEqual(["--slice x=3", "--slice y=4", "--slice z=29", "--volume"]);
    const scattering = VOLUME_OPTICS.with(NOTHING, "single-scattering");
    expect(renderOptions(scene, VOLUME_DENSITY.with(scattering, 1))).toEqual(["--volume", "--optics single-scattering"]);
    expect(renderOptions(scene, scattering)).toEqual([]); // there is no volume in the picture
    expect(fromHash("#scene=&volume=1&optics=emission", 0)?.parts).toEqual({ volume: "1", optics: "emission" });
    for (const bad of ["scattering", "Emission", ""]) expect(VOLUME_OPTICS.accepts(bad), bad).toBe(false);
    for (const bad of ["0", "-1", "17", "x", ""]) expect(VOLUME_DENSITY.accepts(bad), bad).toBe(false);
    expect(fromHash("#scene=&matter=0.5", 0)?.parts).toEqual({ volume: "0.5" }); // its key before version 0.2
    for (const bad of ["1,2", "1,2,-3", "1,2,3.5", "1,2,3,4"]) expect(CROSSHAIR.accepts(bad), bad).toBe(false);
  });
});

describe("the orientation cube", () => {
  it("has anatomical names where the file has them", () => {
    expect(facesOf("LPS").map(({ letter }) => letter).join("")).toBe("LRPASI");
    expect(facesOf("RAS").map(({ letter }) => letter).join("")).toBe("RLAPSI");
    expect(facesOf("LPS")[1]).toEqual({ normal: [-1, 0, 0], letter: "R", name: "the right" });
    for (const space of ["unknown", "LLL", "", "LPSX"]) expect(facesOf(space)[0]?.letter, space).toBe("+x");
  });
});

describe("the transfer function", () => {
  const tent: OpacityTent = { tau: 50, low: 40, high: 80, ramp: 0.25, density: 0.2, colour: "#ff8000" };
  const tableOf = (low: number, high: number): Float32Array => transferTable(layersOf([tent], low, high, 1), low, high, 1);
  const table = tableOf(0, 102.4);
  it("is as opaque as its tents", () => {
    const [red, green, blue, extinction] = meanBetween(table, 600, 601);
    expect([red, green, blue, extinction]).toEqual([
      expect.closeTo(0.2, 3),
      expect.closeTo(0.2 * linearOf("#ff8000")[1], 3),
      0,
      expect.closeTo(0.2, 3),
    ]);
    expect(meanBetween(table, 450, 450)[3]).toBeCloseTo(0.1, 3);
    expect(meanBetween(table, 400, 500)[3]).toBeCloseTo(0.1, 4);
    expect(meanBetween(table, 0, PLACES)[3]).toBeCloseTo((0.2 * 30) / 102.4, 4);
    expect(meanBetween(table, 100, 390)[3]).toBe(0);
    expect(meanBetween(tableOf(5, 5), 1, 2)[3]).toBe(0);
  });
  it("absorbs as much as the integral through a ball of constant density", () => {
    const [radius, inside] = [7, 640];
    for (const beside of [0, 3, 6.5, 8]) {
      const chord = 2 * Math.sqrt(Math.max(0, radius ** 2 - beside ** 2));
      const [red, , blue, opacity] = march(table, (t) => (t * t + beside * beside < radius * radius ? inside : 0), -20, 20, 0.01);
      expect(opacity).toBeCloseTo(1 - Math.exp(-0.2 * chord), 2);
      expect(red).toBeCloseTo(opacity, 6);
      expect(blue).toBe(0);
    }
  });
  it("hardly depends on the step where values change slowly", () => {
    const at = (t: number): number => 300 + 25 * t;
    const [fine, coarse] = [march(table, at, 0, 20, 0.05), march(table, at, 0, 20, 2)];
    expect(Math.abs(fine[3] - coarse[3])).toBeLessThan(0.01);
  });
  it("has the colours of the objects at the same isovalues", () => {
    expect(colouredAs(scene, [{ ...tent, tau: 70 }])[0]?.colour).toBe(scene.entries[2]?.colour);
    expect(colouredAs(scene, [{ ...tent, tau: 71 }])[0]?.colour).toBe("#ff8000");
  });
});
