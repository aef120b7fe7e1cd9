// Where slices look, windows of grey values, and what is up.
import { describe, expect, it } from "vitest";
import type { Page } from "../src/shared/page";
import { fromHash, toHash } from "../src/viewer/state/address";
import { anatomicalAxes, facesOf, nearestDirections, unitTowards, type Direction } from "../src/viewer/state/directions";
import { AXES, cross, dot, Grid, type AxisNumber, type Triple } from "../src/viewer/state/grid";
import { sidesInWords, sliceLayout, type ScreenAxis, type SliceLayout } from "../src/viewer/state/slice_layout";
import { GREY, greyRange } from "../src/viewer/state/slice_state";
import { NOTHING } from "../src/viewer/state/state";
import { rolled, turnedBack, turnedUp, UP, UP_WORDS, upOf, upText } from "../src/viewer/state/up_direction";
import { usualFront, usualUp, vectorOf, withUp } from "../src/viewer/state/up_direction";
import { boundedGrey, draggedWindow, greyOfWindow, presetGroups, presetOf, windowOf } from "../src/viewer/state/window_presets";
import { scene } from "./sample";

/** All 48 anatomical spaces. */
const SPACES = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]].flatMap((order) => {
  const [a, b, c] = order.map((i) => ["LR", "PA", "SI"][i]!) as [string, string, string];
  return [...a].flatMap((p) => [...b].flatMap((q) => [...c].map((r) => p + q + r)));
});

/** Numbers that look random, the same in every run: of a linear congruential generator, below 1. */
function randoms(seed: number): () => number {
  let state = seed;
  return () => (state = (1664525 * state + 1013904223) % 2 ** 32) / 2 ** 32;
}

function unit(v: Triple): Triple {
  return v.map((n) => n / Math.hypot(...v)) as Triple;
}

/** Axes of a volume: a rotation by any angles, or a mirrored one. */
function frame(next: () => number): [Triple, Triple, Triple] {
  const a = unit([next() - 0.5, next() - 0.5, next() - 0.5]);
  const b = unit(cross(a, [next() - 0.5, next() - 0.5, next() - 0.5]));
  const c = cross(a, b);
  return [a, b, next() < 0.5 ? c : (c.map((n) => 0 - n) as Triple)];
}

function gridOf(directions: readonly Triple[], space = "LPS"): { grid: Grid; page: Page } {
  const direction = AXES.map((row) => directions.map((unit) => unit[row])) as [Triple, Triple, Triple];
  const page = { ...scene, volume: { ...scene.volume, space, size: [10, 20, 30], spacing: [1, 2, 3], direction } };
  return { grid: new Grid(page), page };
}

/** Physical displacement of a step along an axis of the screen. */
function displacement(grid: Grid, { axis, sign }: ScreenAxis): Triple {
  const sample: Triple = [4, 4, 4];
  const [here, there] = [grid.place(sample), grid.place(sample.map((n, i) => (i === axis ? n + sign : n)))];
  return there.map((n, i) => n - here[i]!) as Triple;
}

/** The letter of the largest component; null: another component is nearly as large. */
function letterOf(space: string, v: Triple): string | null {
  const [first, second] = [...AXES].sort((p, q) => Math.abs(v[q]) - Math.abs(v[p])) as [AxisNumber, AxisNumber];
  if (Math.abs(v[second]) > 0.99 * Math.abs(v[first])) return null;
  return facesOf(space).find(({ normal }) => normal[first] === Math.sign(v[first]))!.letter;
}

describe("the letters of a slice", () => {
  it("are those of the displacement on the screen, for axes at any angle in any space", () => {
    const next = randoms(7);
    let compared = 0;
    for (let trial = 0; trial < 3000; ++trial) {
      const space = trial % 4 === 0 ? "unknown" : SPACES[trial % SPACES.length]!;
      const directions = frame(next);
      const { grid } = gridOf(directions, space);
      const nearest = directions.map((unit) => letterOf(space, unit));
      const plain = nearest.map((letter) => letterOf("unknown", unitOf(space, letter)));
      const areDistinct = !nearest.includes(null) && new Set(plain.map((letter) => letter?.slice(1))).size === 3;
      for (const axis of AXES) {
        const { right, down, sides } = sliceLayout(axis, grid, space, [0, 0, 1]);
        expect(new Set([axis, right.axis, down.axis]).size).toBe(3);
        for (const [side, other, step] of [["right", "left", right], ["bottom", "top", down]] as const) {
          const move = displacement(grid, step);
          expect(Math.sign(move[sides[side].axis]!)).toBe(sides[side].sign);
          expect([sides[other].axis, sides[other].sign]).toEqual([sides[side].axis, -sides[side].sign]);
          if (!areDistinct) continue;
          ++compared;
          expect(sides[side].letter).toBe(letterOf(space, move));
        }
        expect(sides.right.axis).not.toBe(sides.bottom.axis);
      }
    }
    expect(compared).toBeGreaterThan(6000);
  });

  it("show anatomical volumes as radiologists see them, however they are stored", () => {
    for (const space of SPACES) {
      for (const order of [[0, 1, 2], [1, 2, 0], [2, 1, 0]] as const) {
        const signs = [1, -1, 1];
        const directions = order.map((axis, i) => [0, 1, 2].map((row) => (row === axis ? signs[i] : 0)) as Triple);
        const { grid } = gridOf(directions, space);
        const seen = AXES.map((axis) => sliceLayout(axis, grid, space, [0, 0, -1]));
        const letters = ({ left, right, top, bottom }: SliceLayout["sides"]): string =>
          [left, right, top, bottom].map(({ letter }) => letter).join("");
        const sides = Object.fromEntries(seen.map(({ plane, sides: of }) => [plane, letters(of)]));
        expect(sides, space).toEqual({ axial: "RLAP", coronal: "RLSI", sagittal: "APSI" });
      }
    }
  });

  it("say when a slice is oblique, and what is where in words", () => {
    const tilt = (degrees: number): [Triple, Triple, Triple] => {
      const [c, s] = [Math.cos((degrees * Math.PI) / 180), Math.sin((degrees * Math.PI) / 180)];
      return [[1, 0, 0], [0, c, s], [0, -s, c]];
    };
    const planes = (degrees: number): string[] => {
      const { grid } = gridOf(tilt(degrees));
      return AXES.map((axis) => sliceLayout(axis, grid, "LPS", [0, 0, 1]).plane);
    };
    expect(planes(1)).toEqual(["sagittal", "coronal", "axial"]);
    expect(planes(20)).toEqual(["sagittal", "oblique coronal", "oblique axial"]);
    const { grid } = gridOf(tilt(0));
    expect(sidesInWords(sliceLayout(2, grid, "LPS", [0, 0, 1]))).toBe("left side is the patient's right, top is anterior");
    expect(sidesInWords(sliceLayout(1, grid, "unknown", [0, 0, 1]))).toBe("left side is −x, top is +z");
  });

  it("of volumes without a space are those of the axes; slices turn by half where -z is up", () => {
    const { grid } = gridOf([[1, 0, 0], [0, 1, 0], [0, 0, 1]], "unknown");
    const letters = (up: Triple): string[] =>
      AXES.map((axis) => {
        const { sides } = sliceLayout(axis, grid, "unknown", up);
        return [sides.left, sides.right, sides.top, sides.bottom].map((side) => side.letter).join(" ");
      });
    expect(letters([0, 0, 1])).toEqual(["−y +y +z −z", "−x +x +z −z", "−x +x −y +y"]);
    expect(letters([0, 0, -1])).toEqual(["+y −y −z +z", "+x −x −z +z", "−x +x −y +y"]);
  });
});

function unitOf(space: string, letter: string | null): Triple {
  return letter === null ? [1, 1, 1] : (unitTowards(space, letter) ?? [1, 1, 1]);
}

describe("directions in space", () => {
  it("are anatomical for three letters that say each axis once", () => {
    expect(SPACES.length).toBe(48);
    for (const space of SPACES) expect(anatomicalAxes(space)).toEqual([...space]);
    for (const space of ["unknown", "", "LLL", "LPSX", "LP", "lps", "LRS"]) expect(anatomicalAxes(space), space).toBeNull();
  });
  it("of the axes of a volume are three different ones", () => {
    const next = randoms(3);
    for (let trial = 0; trial < 500; ++trial)
      expect(new Set(nearestDirections("LPS", frame(next)).map(({ axis }: Direction) => axis)).size).toBe(3);
  });
});

describe("windows", () => {
  const ct = (changes: object): Page => ({
    ...scene,
    volume: { ...scene.volume, type: "int16", low: -1024, high: 3071, valueUnit: "HU", ...changes },
    axis: { low: -1024, high: 3071, bend: null },
    histogram: { edges: [-1024, 0, 3071], counts: [500, 500] },
  });
  const names = (page: Page, tau: number | null = null): string[] =>
    presetGroups(page, tau).flatMap(({ title, presets }) => presets.map(({ name }) => (title ? `${title}: ${name}` : name)));

  it("are level and width, and back", () => {
    expect(windowOf([-1350, 150])).toEqual({ level: -600, width: 1500 });
    expect(greyOfWindow({ level: -600, width: 1500 })).toEqual([-1350, 150]);
  });

  it("of CT are offered where the values are in Hounsfield units, or look like it", () => {
    const all = ["Lung", "Mediastinum", "Soft tissue", "Abdomen", "Brain", "Bone"];
    const general = ["Automatic (0.5 % to 99.5 %)", "Full range"];
    expect(names(ct({}))).toEqual([...general, ...all.map((name) => `CT: ${name}`)]);
    expect(names(ct({ valueUnit: null }))).toEqual([...general, ...all.map((name) => `CT (HU): ${name}`)]);
    expect(names(ct({ low: 230 }))).toEqual([...general, "CT: Soft tissue", "CT: Abdomen", "CT: Bone"]);
    const others = [{ valueUnit: "K" }, { valueUnit: null, low: 0 }, { valueUnit: null, type: "uint8" }, { valueUnit: null, high: 1e9 }];
    for (const other of others) expect(names(ct(other)), JSON.stringify(other)).toEqual(general);
  });

  it("that lie outside of the values are not offered", () => {
    const next = randoms(11);
    for (let trial = 0; trial < 300; ++trial) {
      const [low, high] = [-1500 + 3000 * next(), -1500 + 3000 * next()].sort((p, q) => p - q) as [number, number];
      const [, ofCt] = presetGroups(ct({ low, high }), null);
      for (const { grey } of ofCt?.presets ?? []) expect(grey![0] < high && grey![1] > low).toBe(true);
    }
    expect(names(ct({ low: 2000, high: 3000 }))).toEqual(["Automatic (0.5 % to 99.5 %)", "Full range"]);
  });

  it("are found again by the digits of a link", () => {
    const page = ct({ low: -1024.0003, high: 3071.12345678 });
    const groups = presetGroups(page, 123.456789);
    for (const preset of groups.flatMap(({ presets }) => presets)) {
      const kept = fromHash(toHash(GREY.with(NOTHING, preset.grey)), 0)!;
      expect(presetOf(groups, GREY.of(kept))?.name).toBe(preset.name);
    }
    expect(presetOf(groups, [0, 1])).toBeNull();
    const around = groups[0]!.presets.at(-1)!;
    expect(around.name).toBe("Around the isovalue of the selected object");
    const { width } = windowOf(greyRange(page));
    expect(windowOf(around.grey!)).toEqual({ level: expect.closeTo(123.456789), width: expect.closeTo(width / 2) });
  });

  it("follow a drag: to the right wider, down a higher level, and back", () => {
    const window = { level: 40, width: 400 };
    expect(draggedWindow(window, 50, 0).width).toBeGreaterThan(400);
    expect(draggedWindow(window, -5000, 0).width).toBeGreaterThan(0);
    expect(draggedWindow(window, 0, 100)).toEqual({ level: 240, width: 400 });
    expect(draggedWindow(window, 0, 0)).toEqual(window);
  });

  it("stay in sight of the values, with black below white in a link", () => {
    const page = ct({});
    for (const level of [-1e9, -1000, 0, 17.5, 1e9])
      for (const width of [1e-12, 1, 1e12]) {
        const grey = boundedGrey({ level, width }, page);
        expect(grey[0]).toBeLessThan(4 * 4095 * 10);
        expect(GREY.of(fromHash(toHash(GREY.with(NOTHING, grey)), 0)!), `${level} ${width}`).not.toBeNull();
        if (Math.abs(level) < 1e4 && width === 1)
          expect(windowOf(grey)).toEqual({ level: expect.closeTo(level), width: expect.closeTo(1) });
      }
  });
});

describe("the up direction", () => {
  const page = (space: string): Page => ({ ...scene, volume: { ...scene.volume, space } });

  it("is superior where the space is anatomical, else +z", () => {
    for (const space of SPACES) {
      const axis = [...space].findIndex((letter) => "SI".includes(letter));
      expect(usualUp(page(space))).toEqual([0, 1, 2].map((i) => (i === axis ? (space[axis] === "S" ? 1 : -1) : 0)));
      expect(dot(usualFront(page(space)), unitTowards(space, "A")!)).toBe(1);
    }
    expect(usualUp(page("unknown"))).toEqual([0, 0, 1]);
  });

  it("is kept in a link, an axis by its name; the usual one is not written", () => {
    for (const word of UP_WORDS) {
      const hash = toHash(withUp(page("LPS"), NOTHING, vectorOf(word)));
      expect(hash.includes("up="), word).toBe(word !== "z");
      expect(upOf(page("LPS"), fromHash(hash, 0)!)).toEqual(vectorOf(word));
    }
    const tilted = rolled([0, 0, 1], [0, 1, 0], 0.3);
    const kept = upOf(page("LPS"), fromHash(toHash(withUp(page("LPS"), NOTHING, tilted)), 0)!);
    kept.forEach((n, i) => expect(n).toBeCloseTo(tilted[i]!, 6));
    for (const bad of ["w", "1,1,1", "0,0,0", "1,0", "+z", "--z", "1,0,0,0"]) expect(UP.accepts(bad), bad).toBe(false);
  });

  it("turns space like `isoatlas render`: a rotation that takes z to up, by half around y for -z", () => {
    const next = randoms(5);
    for (let trial = 0; trial < 300; ++trial) {
      const up = trial < 6 ? vectorOf(UP_WORDS[trial]!) : frame(next)[0];
      const [v, w] = [frame(next)[0], frame(next)[0]];
      const [a, b] = [turnedUp(up, v), turnedUp(up, w)];
      expect(dot(a, b)).toBeCloseTo(dot(v, w), 9);
      turnedUp(up, [0, 0, 1]).forEach((n, i) => expect(n).toBeCloseTo(up[i]!, 9));
      turnedBack(up, a).forEach((n, i) => expect(n).toBeCloseTo(v[i]!, 9));
      turnedUp(up, cross(v, w)).forEach((n, i) => expect(n).toBeCloseTo(cross(a, b)[i]!, 9));
    }
    expect(turnedUp([0, 0, -1], [0, -1, 0])).toEqual([0, -1, 0]);
  });

  it("comes back after a full roll, and rolls left after right", () => {
    const next = randoms(13);
    for (let trial = 0; trial < 100; ++trial) {
      const [up, around] = [frame(next)[0], frame(next)[0]];
      let turned = up;
      for (let i = 0; i < 72; ++i) turned = rolled(turned, around, Math.PI / 36);
      turned.forEach((n, i) => expect(n).toBeCloseTo(up[i]!, 6));
      rolled(rolled(up, around, 0.4), around, -0.4).forEach((n, i) => expect(n).toBeCloseTo(up[i]!, 9));
    }
    expect(upText(rolled([0, 0, 1], [0, 1, 0], Math.PI / 2))).toBe("x");
  });
});
