import { afterEach, describe, expect, it } from "vitest";
import { Axis, histogramPath } from "../src/shared/axis";
import { alsoAt, cardOf, cardsOf } from "../src/shared/cards";
import { chosenBranches, chosenEntries, firstChoice, ranked } from "../src/page/choice";
import { columnAt, countPath, countWords, Scale } from "../src/page/columns";
import { hiddenSentences } from "../src/shared/hidden_counts";
import { area, length, plural, value, volume } from "../src/shared/format";
import { canChoose, chooseUnit, declaredUnit, shownQuantity } from "../src/shared/units";
import {
  anchorOf, branchName, contentsOf, describe as said, furtherIsovalues, nameOf, placeOf, rangeOf, reasonOf,
} from "../src/shared/names";
import { largestAt } from "../src/page/others";
import { isDeep, lanesOf } from "../src/shared/overview";
import { readPage } from "../src/shared/page";
import { branch, entry, page, scene } from "./sample";

describe("numbers", () => {
  it("have about four digits", () => {
    expect([0, 627.2656, 12345.6, 0.00012, 2.5e7, -3.25].map(value)).toEqual(["0", "627.3", "12346", "1.2e-4", "2.5e7", "-3.25"]);
  });
  it("count things", () => {
    expect(plural(0, "tunnel")).toBe("no tunnels");
    expect(plural(1, "cavity", "cavities")).toBe("1 cavity");
    expect(plural(12345, "voxel")).toBe("12,345 voxels");
  });
  it("use the largest unit in which a volume is at least 1", () => {
    expect(volume(2500, "mm")).toBe("2.5 cm³");
    expect(volume(999, "mm")).toBe("999 mm³");
    expect(volume(12, null)).toBe("12 voxels");
    expect(volume(12, "units")).toBe("12 units³");
  });
});

describe("the unit of lengths", () => {
  afterEach(() => chooseUnit(null));
  it("is that of the file, or the chosen one, into which numbers are converted", () => {
    expect(shownQuantity(2, "mm", 3)).toEqual({ amount: 2, unit: "mm", isChosen: false });
    chooseUnit("µm");
    expect(shownQuantity(2, "mm", 1)).toEqual({ amount: 2000, unit: "µm", isChosen: true });
    expect(shownQuantity(2, "mm", 3).amount).toBe(2e9);
    expect(shownQuantity(5, "µm", 2).amount).toBe(5);
    expect([volume(2500, "mm"), area(0.5, "mm"), length(0.012, "mm")]).toEqual(["2,500,000,000,000 µm³", "500,000 µm²", "12 µm"]);
    chooseUnit("m");
    expect(length(1500, "mm")).toBe("1.5 m");
    expect(declaredUnit("mm")).toBe(null);
  });
  it("of a file without one is declared: numbers stay", () => {
    expect(volume(12, null)).toBe("12 voxels");
    chooseUnit("µm");
    expect([volume(12, null), volume(12, "units"), length(3, null)]).toEqual(["12 µm³", "12 µm³", "3 µm"]);
    expect([declaredUnit(null), declaredUnit("units")]).toEqual(["µm", "µm"]);
  });
  it("of degrees or parsecs cannot be changed", () => {
    chooseUnit("mm");
    expect([canChoose("degrees"), canChoose("mm"), canChoose(null)]).toEqual([false, true, true]);
    expect(volume(12, "kpc")).toBe("12 kpc³");
  });
});

describe("the axis", () => {
  it("maps isovalues to positions and back, linear and bent", () => {
    for (const axis of [new Axis(-100, 300, 1000, 20), new Axis(-100, 300, 1000, 20, 5)]) {
      for (const tau of [-100, 0, 17.5, 300]) expect(axis.tau(axis.x(tau))).toBeCloseTo(tau);
      expect([axis.x(-100), axis.x(1e9)]).toEqual([20, 980]);
    }
  });
  it("has round ticks within its range, also for a single value", () => {
    expect(new Axis(0, 255, 100).ticks(6)).toEqual([0, 50, 100, 150, 200, 250]);
    expect(new Axis(0.1, 0.3, 100).ticks(4)).toEqual([0.1, 0.15, 0.2, 0.25, 0.3]);
    expect(new Axis(5, 5, 100).ticks(4)).toEqual([5]);
  });
  it("has round ticks with a minimal distance when it is bent", () => {
    const axis = new Axis(0, 60000, 1000, 0, 500);
    const ticks = axis.ticks(8);
    expect(ticks.slice(1).every((tau) => [1, 2, 5].includes(Number(String(tau)[0])))).toBe(true);
    expect(ticks.slice(1).every((tau, i) => axis.x(tau) - axis.x(ticks[i]!) >= 125)).toBe(true);
  });
  it("draws a closed histogram", () => {
    expect(histogramPath({ edges: [0, 1, 2], counts: [0, 9] }, new Axis(0, 2, 100), 0, 50)).toBe("M0.0 50V50.0H50.0V0.0H100.0V50Z");
  });
});

describe("counts over the isovalue", () => {
  const line = { name: "tunnels", one: "tunnel", count: scene.spectrum!.all.tunnels };
  it("are read in the column that contains an isovalue", () => {
    expect([-5, 0, 25, 25.1, 60, 100, 999].map((tau) => columnAt(scene.spectrum!.edges, tau))).toEqual([0, 0, 0, 1, 2, 3, 3]);
    expect([0, 1, 2].map((column) => countWords(line, column))).toEqual(["no tunnels", "2 to 5 tunnels", "1 tunnel"]);
  });
  it("are drawn as a staircase or a band", () => {
    const scale = new Scale([{ name: "x", one: "x", count: { max: [Math.expm1(1)] } }], 0, 10);
    expect(countPath([0, 50, 100], { max: [0, Math.expm1(1)], min: [0, 0] }, new Axis(0, 100, 100), scale)).toBe(
      "M0.0 10.0H50.0V0.0V10.0V0.0H100.0",
    );
  });
});

describe("objects", () => {
  const all = new Set([0, 1, 2, 3]);
  it("have lanes: branches below the one they merge into, cavities last; -1 if hidden", () => {
    expect(lanesOf(scene, all)).toEqual([0, 1, 2, 3]);
    expect(lanesOf(scene, new Set([0, 2]))).toEqual([0, -1, 1, -1]);
    expect(lanesOf(page([], []), new Set())).toEqual([]);
  });
  it("are shown by rank, those with a picture first", () => {
    expect(ranked(scene)).toEqual([0, 1, 3, 2]);
    expect([...chosenBranches(scene, firstChoice(scene))]).toEqual([0, 1, 3]);
    expect([...chosenBranches(scene, { ...firstChoice(scene), keep: 4 })]).toEqual([0, 1, 3, 2]);
    expect(chosenEntries(scene, { ...firstChoice(scene), keep: 1 })).toEqual([0, 1]);
  });
  it("are sorted and filtered, ties by rank", () => {
    const choice = firstChoice(scene);
    expect(chosenEntries(scene, choice)).toEqual([0, 1, 2, 3]);
    expect(chosenEntries(scene, { ...choice, order: "size" })).toEqual([0, 1, 3, 2]);
    expect(chosenEntries(scene, { ...choice, side: "object", minVoxels: 50 })).toEqual([0, 1]);
    expect(chosenEntries(scene, { ...choice, order: "cavities", side: "cavity" })).toEqual([3]);
  });
  it("and cavities share one order, the object that never merges first", () => {
    const small = branch({ merges: 20, hypervolume: 10 });
    const cavity = branch({ side: "cavity", merges: 70, hypervolume: 300 });
    const mixed = page([branch({}), small, cavity], [entry({ branch: 0 }), entry({ branch: 1 }), entry({ branch: 2 })]);
    expect(ranked(mixed)).toEqual([0, 2, 1]);
    expect(chosenEntries(mixed, firstChoice(mixed))).toEqual([0, 2, 1]);
  });
  it("show each further isovalue on the closest card of the same object", () => {
    const isovalues = [70, 33, 31, 48].map((tau) => ({ tau, why: "its boundary is sharp" }));
    const entries = [entry({ branch: 0, tau: 30 }), entry({ branch: 0, tau: 50 }), entry({ branch: 1, tau: 33 })];
    const nested = page([branch({ isovalues }), branch({ merges: 20 })], entries);
    expect([0, 1, 2].map((i) => furtherIsovalues(nested, i).map(({ tau }) => tau))).toEqual([[31, 33], [48, 70], []]);
  });
  it("that look the same share a card", () => {
    const isovalues = [12, 78].map((tau) => ({ tau, why: "its boundary is sharp" }));
    const same = page(
      [branch({ isovalues }), branch({ merges: 20 })],
      [
        entry({ number: 1, card: 1, tau: 10, background: true }),
        entry({ number: 2, card: 2, tau: 30 }),
        entry({ number: 3, card: 2, tau: 50, overlap: 0.8 }),
        entry({ number: 4, card: 4, tau: 80 }),
        entry({ branch: 1, number: 5, card: 5, tau: 40 }),
      ],
    );
    expect(same.entries.map((_, i) => cardOf(same, i))).toEqual([0, 1, 1, 3, 4]);
    expect(cardsOf(same, [0, 1, 2, 3, 4])).toEqual({ cards: [1, 3, 4], background: [0] });
    expect(cardsOf(same, [2, 4])).toEqual({ cards: [2, 4], background: [] }); // the card of the former is not listed
    expect(alsoAt(same, 1)).toEqual([{ tau: 50, why: "80 % of the voxels are the same", entry: 2 }]);
    expect([0, 3].map((i) => alsoAt(same, i).map(({ tau }) => tau))).toEqual([[12], [78]]);
    expect(cardsOf(scene, [0, 1, 2, 3])).toEqual({ cards: [0, 1, 2, 3], background: [] }); // pages of earlier versions
  });
  it("have names and descriptions", () => {
    expect([nameOf(scene, 2), nameOf(scene, 3), anchorOf(scene, 3)]).toEqual(["Object 3", "Cavity 1", "cavity-1"]);
    expect(said(scene, 0)).toBe("Object 1 at isovalue 50: 10 cm³, 2 tunnels, no cavities");
    expect([rangeOf(scene.branches[1]!), rangeOf(scene.branches[3]!)]).toEqual(["30 to 95", "10 to 70"]);
    expect(contentsOf(scene, 0)).toEqual([1, 2, 3]);
    expect([placeOf(scene, 0), placeOf(scene, 3)]).toEqual(["", "a cavity of object 1"]);
    expect([reasonOf(scene, 0), reasonOf(scene, 1)]).toEqual(["", "sharp edge"]);
    expect([branchName(scene, 0), branchName(scene, 2)]).toEqual(["Object 1", "object v9"]);
  });
  it("have labels with contrast to their colour", () => {
    expect(["#0072b2", "#56b4e9", "#f0e442", "#d55e00"].map(isDeep)).toEqual([true, false, false, false]);
  });
  it("without a picture get an isovalue just above their merge", () => {
    const tau = largestAt(scene.branches[2]!);
    expect(tau).toBeGreaterThan(60);
    expect(tau).toBeLessThan(61);
  });
});

describe("hidden objects", () => {
  it("are counted, with the reason", () => {
    const why = "below noise level or very small.";
    expect(hiddenSentences(scene)).toEqual([
      `1,234 objects in all, 2 shown. 1 more is significant. 1,231 not shown: ${why}`,
      `77 cavities in all, 1 shown. 76 not shown: ${why}`,
    ]);
  });
  it("are not mentioned where everything is shown", () => {
    const one = page([branch({})], []);
    one.found = { objects: { all: 1, significant: 1 }, cavities: { all: 0, significant: 0 } };
    expect(hiddenSentences(one)).toEqual(["1 object in all, 0 shown. 1 more is significant."]);
  });
});

describe("data", () => {
  it("of another version are rejected", () => {
    expect(readPage("null")).toBeNull();
    expect(() => readPage('{"schema":"isoatlas/page/1"}')).toThrow("isoatlas/page/1");
  });
});
