// Choosing among all objects, without a browser.
import { describe, expect, it } from "vitest";
import { titleOf } from "../src/viewer/ask/shown";
import { nameOf } from "../src/names";
import { entryOf } from "../src/page";
import { fromHash, toHash } from "../src/viewer/state/address";
import { armsOf, boxOf } from "../src/viewer/look/brackets";
import { Catalogue, numbersOf, type Branches } from "../src/viewer/ask/catalogue";
import { ANY, CHOICE, commandOf, isChosen, isSelection, selectionWords, TAB, type Choice } from "../src/viewer/state/choosing";
import { find } from "../src/viewer/choose/found";
import { History } from "../src/viewer/state/history";
import { spanOf } from "../src/viewer/choose/scatter_plot";
import { isolate, NOTHING } from "../src/viewer/state/state";
import { foldedAway } from "../src/viewer/choose/tree_keys";
import { branch, entry, page } from "./sample";

/** Of rank 0 to n - 1: contrast and size halve from one to the next; each merges into the one before. */
function listed(n: number, all = n): Branches {
  const ranks = Array.from({ length: n }, (_, rank) => rank);
  const of = <T>(value: (rank: number) => T): T[] => ranks.map(value);
  return {
    source: "scan.atlas",
    all,
    id: of((r) => 100 + r),
    voxel: of((r) => 200 + r),
    tau: of((r) => 50 + r),
    low: of((r) => 40 + r),
    high: of((r) => 60 + r),
    tunnels: of((r) => r % 3),
    cavities: of(() => 0),
    appears: of((r) => 90 - r),
    merges: of((r) => (r === 0 ? null : 30 + r)),
    parent: of((r) => r - 1),
    persistence: of((r) => 64 / 2 ** r),
    hypervolume: of((r) => 1e6 / 2 ** r),
    voxels: of((r) => 1024 / 2 ** r),
    measure: of((r) => 2048 / 2 ** r),
    standsOut: of((r) => r < 3),
  };
}

/** Ranks 0 and 2 have entries, 0 two of them; and there is a dark one. */
function small(): ReturnType<typeof page> {
  const made = page(
    [
      branch({ id: 100, rank: 0, merges: null }),
      branch({ id: 102, rank: 2, parent: 0, merges: 32 }),
      branch({ side: "dark", id: 5, rank: 0 }),
    ],
    [entry({ id: 100 }), entry({ id: 100, tau: 70 }), entry({ branch: 1, id: 102, reason: "steady" }), entry({ branch: 2, id: 5 })],
  );
  made.objects.bright.all = 6;
  return made;
}

function catalogueOf(volume: ReturnType<typeof page>, n: number): Catalogue {
  const catalogue = new Catalogue(volume);
  catalogue.learn(listed(n));
  return catalogue;
}

describe("a catalogue", () => {
  it("has every object under one number, the page's entries under theirs", () => {
    const volume = small();
    const catalogue = catalogueOf(volume, 6);
    expect(numbersOf(volume)).toBe(10);
    expect([0, 1, 2, 3].map((rank) => catalogue.numbersOfRank(rank))).toEqual([[0, 1], [5], [2], [7]]);
    expect(catalogue.chosen(null)).toEqual([0, 1, 2]);
    expect(catalogue.chosen({ ...ANY, keep: 4 })).toEqual([0, 1, 5, 2, 7]);
    expect(catalogue.objectsOf(catalogue.chosen({ ...ANY, keep: 4 }))).toBe(4);
    expect(nameOf(volume, 2)).toBe("Object 3");
    expect(titleOf(volume, 7)).toBe("Object of rank 4");
    expect(entryOf(volume, 7)).toMatchObject({ id: 203, tau: 53, tunnels: 0, cavities: 0 });
    expect(entryOf(volume, 7).commands[0]?.line).toBe("isoatlas extract scan.atlas --object 203 --tau 53 -o object-4.ply");
    expect(() => entryOf(volume, 10)).toThrow("no entry 10");
  });
  it("completes the tree of the page", () => {
    const volume = small();
    const catalogue = catalogueOf(volume, 6);
    const places = [0, 1, 2, 3, 4, 5].map((rank) => entryOf(volume, catalogue.numbersOfRank(rank)[0] ?? 0).branch);
    expect(places).toEqual([0, 3, 1, 4, 5, 6]);
    expect(places.map((place) => volume.branches[place]?.parent)).toEqual([-1, 0, 3, 1, 4, 5]);
    expect(catalogue.numberOfBranch(4)).toBe(7);
    expect(foldedAway(volume, new Set(places), new Set([3]), 6)).toBe(true);
    expect(foldedAway(volume, new Set(places), new Set([6]), 6)).toBe(false);
  });
  it("knows the page's own entries before it has learned of the others", () => {
    const volume = small();
    const catalogue = new Catalogue(volume);
    expect([catalogue.isKnown, catalogue.all, catalogue.chosen(null)]).toEqual([false, 6, [0, 1, 2]]);
    expect(() => entryOf(volume, 7)).toThrow("no entry 7");
  });
  it("measures sizes as the file does", () => {
    const volume = small();
    expect(catalogueOf(volume, 2).sizes[1]).toEqual({ rank: 1, contrast: 32, size: 1024, standsOut: true });
    volume.volume.unit = null;
    expect(catalogueOf(volume, 2).sizes[1]?.size).toBe(512);
  });
});

describe("a choice", () => {
  const sizes = { rank: 3, contrast: 8, size: 128, standsOut: false };
  it("keeps what lies in the box, limits included", () => {
    for (const [choice, expected] of [
      [ANY, true],
      [{ ...ANY, contrast: [8, null] }, true],
      [{ ...ANY, contrast: [8.1, null] }, false],
      [{ ...ANY, size: [1, 128] }, true],
      [{ ...ANY, size: [1, 127] }, false],
      [{ ...ANY, keep: 3 }, false],
      [{ ...ANY, keep: 4 }, true],
      [{ ...ANY, standsOut: true }, false],
    ] as [Choice, boolean][])
      expect(isChosen(choice, sizes), JSON.stringify(choice)).toBe(expected);
  });
  it("keeps the largest object, unless there is an upper limit", () => {
    const first = { ...sizes, rank: 0 };
    expect(isChosen({ ...ANY, contrast: [99, null], standsOut: true }, first)).toBe(true);
    expect(isChosen({ ...ANY, contrast: [99, 100] }, first)).toBe(false);
  });
  it("has a command line, and says whether it lists the same", () => {
    const line = (choice: Choice | null, hasUnit = false): [string, boolean] => {
      const command = commandOf(choice, "'a b.atlas'", 5, hasUnit);
      return [command.line.replace("isoatlas objects 'a b.atlas'", "").trim(), command.same];
    };
    expect(line(null)).toEqual(["", true]);
    expect(line(ANY)).toEqual(["--all", true]);
    expect(line({ ...ANY, standsOut: true })).toEqual(["--top 20", true]);
    const three = "--keep 9 --persistence 2.5 --min-voxels 10";
    expect(line({ ...ANY, keep: 9, contrast: [2.5, null], size: [10, null] })).toEqual([three, true]);
    expect(line({ ...ANY, size: [10, 20] }, true)).toEqual(["--min-volume 10", false]);
    expect(selectionWords({ ...ANY, contrast: [0, 3] }, true)).toEqual([["persistence", 0]]);
    expect(isSelection({ ...ANY, contrast: [0, 3] })).toBe(false);
  });
  it("is the same after a link, and what is none of ours is none", () => {
    const choice: Choice = { standsOut: true, keep: 12, contrast: [0.25, null], size: [null, 1e6] };
    const state = TAB.in(CHOICE.in(NOTHING, choice), "tree");
    const back = fromHash(toHash(state), 4);
    expect(back && CHOICE.of(back)).toEqual(choice);
    expect(back && TAB.of(back)).toBe("tree");
    const wrong = ["", "1,2", "x,,,,,", ",-1,,,,", ",1.5,,,,", ",,nan,,,", ",,-2,,,", ",,,,,,"];
    for (const word of wrong) expect(CHOICE.takes(word), word).toBe(false);
    expect(CHOICE.takes(",,,,,")).toBe(true);
    expect(TAB.takes("pictures")).toBe(false);
  });
  it("is undone; how objects are listed is not", () => {
    const history = new History(isolate(NOTHING, 0, 1));
    history.go(CHOICE.in(history.now, ANY));
    history.everywhere((state) => TAB.in(state, "scatter"));
    expect(history.undo()).toBe(true);
    expect(CHOICE.of(history.now)).toBeNull();
    expect(TAB.of(history.now)).toBe("scatter");
    expect(history.undo()).toBe(false);
  });
});

describe("what is found", () => {
  const volume = small();
  const catalogue = catalogueOf(volume, 6);
  const all = catalogue.chosen({ ...ANY, keep: 6 });
  const found = (text: string, order = "rank"): number[] => find(volume, all, [], { text, order }).bright;
  it("has the words in its name, its number or its reason", () => {
    expect(found("")).toEqual(all);
    expect(found("sharp")).toEqual([2]);
    expect(found("3")).toEqual([2]);
    expect(found("rank 4")).toEqual([7]);
    expect(found("203")).toEqual([7]);
    expect(found("nothing of this")).toEqual([]);
  });
  it("is sorted, with what is in the scene and dark objects apart", () => {
    expect(found("", "isovalue").slice(0, 2)).toEqual([1, 9]);
    const scene = isolate(NOTHING, 8, 1).shown;
    expect(find(volume, [0], scene, { text: "", order: "rank" })).toEqual({ bright: [0], dark: [3], also: [8] });
  });
});

describe("the mark of what is selected", () => {
  it("is at the corners of its box", () => {
    const box = boxOf({ positions: new Uint16Array([0, 4, 8, 10, 2, 6]), origin: [1, 2, 3], step: 0.5 });
    expect(box).toEqual([[1, 3, 6], [6, 4, 7]]);
    const arms = armsOf([[0, 0, 0], [100, 100, 100]]);
    expect(arms.length).toBe(8 * 3 * 2 * 3);
    expect(arms.slice(0, 6)).toEqual([0, 0, 0, 16, 0, 0]);
    expect(arms.slice(-6)).toEqual([100, 100, 100, 100, 100, 84]);
  });
});

describe("the plane of contrast and size", () => {
  it("goes from the least that is positive to the most, with a little room", () => {
    const { min, max } = spanOf([0, 1, 1e6]);
    expect([min, max].map((limit) => Number(limit.toPrecision(3)))).toEqual([0.575, 1740000]);
    for (const one of [spanOf([3]), spanOf([]), spanOf([0])]) expect(one.max / one.min).toBeGreaterThan(1.1);
  });
});
