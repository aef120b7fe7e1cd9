// Choosing among all objects, without a browser.
import { describe, expect, it } from "vitest";
import { titleOf } from "../src/viewer/api/entries";
import { nameOf } from "../src/shared/names";
import { entryOf } from "../src/shared/page";
import { fromHash, toHash } from "../src/viewer/state/address";
import { armsOf, boxOf } from "../src/viewer/tools/selection_brackets";
import { Catalogue, numbersOf, type BranchList } from "../src/viewer/api/catalogue";
import { ANY, CHOICE, commandOf, isChosen, isSelection, selectionOptions, TAB, type Choice } from "../src/viewer/state/selection";
import { find } from "../src/viewer/panels/object_search";
import { History } from "../src/viewer/state/history";
import { spanOf } from "../src/viewer/panels/scatter_plot";
import { isolate, NOTHING, type State } from "../src/viewer/state/state";
import { foldedAway } from "../src/viewer/panels/tree_keys";
import { branch, entry, page } from "./sample";

/** Ranks 0 to n - 1: contrast and size halve from one to the next; each merges into the previous one. */
function listed(n: number, all = n): BranchList {
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
    significant: of((r) => r < 3),
  };
}

/** Ranks 0 and 2 have entries, rank 0 two of them; and there is a cavity. */
function small(): ReturnType<typeof page> {
  const made = page(
    [
      branch({ id: 100, rank: 0, merges: null }),
      branch({ id: 102, rank: 2, parent: 0, merges: 32 }),
      branch({ side: "cavity", id: 5, rank: 0 }),
    ],
    [entry({ id: 100 }), entry({ id: 100, tau: 70 }), entry({ branch: 1, id: 102, reason: "stable" }), entry({ branch: 2, id: 5 })],
  );
  made.found.objects.all = 6;
  return made;
}

function catalogueOf(volume: ReturnType<typeof page>, n: number): Catalogue {
  const catalogue = new Catalogue(volume);
  catalogue.load(listed(n));
  return catalogue;
}

describe("a catalogue", () => {
  it("gives every object a number; entries of the page keep theirs", () => {
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
    expect(entryOf(volume, 7).commands[0]?.line).toBe("isoatlas extract scan.atlas --object v203@53 -o object-4.ply");
    expect(() => entryOf(volume, 10)).toThrow("no entry 10");
  });
  it("adds branches to the tree of the page", () => {
    const volume = small();
    const catalogue = catalogueOf(volume, 6);
    const places = [0, 1, 2, 3, 4, 5].map((rank) => entryOf(volume, catalogue.numbersOfRank(rank)[0] ?? 0).branch);
    expect(places).toEqual([0, 3, 1, 4, 5, 6]);
    expect(places.map((place) => volume.branches[place]?.parent)).toEqual([-1, 0, 3, 1, 4, 5]);
    expect(catalogue.numberOfBranch(4)).toBe(7);
    expect(foldedAway(volume, new Set(places), new Set([3]), 6)).toBe(true);
    expect(foldedAway(volume, new Set(places), new Set([6]), 6)).toBe(false);
  });
  it("has the entries of the page before the list is loaded", () => {
    const volume = small();
    const catalogue = new Catalogue(volume);
    expect([catalogue.isLoaded, catalogue.all, catalogue.chosen(null)]).toEqual([false, 6, [0, 1, 2]]);
    expect(() => entryOf(volume, 7)).toThrow("no entry 7");
  });
  it("has sizes in the unit of the file", () => {
    const volume = small();
    expect(catalogueOf(volume, 2).sizes[1]).toEqual({ rank: 1, contrast: 32, size: 1024, significant: true });
    volume.volume.unit = null;
    expect(catalogueOf(volume, 2).sizes[1]?.size).toBe(512);
  });
});

describe("a choice", () => {
  const sizes = { rank: 3, contrast: 8, size: 128, significant: false };
  it("keeps objects within its limits, inclusive", () => {
    for (const [choice, expected] of [
      [ANY, true],
      [{ ...ANY, contrast: [8, null] }, true],
      [{ ...ANY, contrast: [8.1, null] }, false],
      [{ ...ANY, size: [1, 128] }, true],
      [{ ...ANY, size: [1, 127] }, false],
      [{ ...ANY, keep: 3 }, false],
      [{ ...ANY, keep: 4 }, true],
      [{ ...ANY, significant: true }, false],
    ] as [Choice, boolean][])
      expect(isChosen(choice, sizes), JSON.stringify(choice)).toBe(expected);
  });
  it("keeps the largest object, unless there is an upper limit", () => {
    const first = { ...sizes, rank: 0 };
    expect(isChosen({ ...ANY, contrast: [99, null], significant: true }, first)).toBe(true);
    expect(isChosen({ ...ANY, contrast: [99, 100] }, first)).toBe(false);
  });
  it("has a command line, and whether its list is the same", () => {
    const line = (choice: Choice | null, hasUnit = false): [string, boolean] => {
      const command = commandOf(choice, "'a b.atlas'", 5, hasUnit);
      return [command.line.replace("isoatlas objects 'a b.atlas'", "").trim(), command.same];
    };
    expect(line(null)).toEqual(["", true]);
    expect(line(ANY)).toEqual(["--all", true]);
    expect(line({ ...ANY, significant: true })).toEqual(["--top 20", true]);
    const three = "--keep 9 --persistence 2.5 --min-voxels 10";
    expect(line({ ...ANY, keep: 9, contrast: [2.5, null], size: [10, null] })).toEqual([three, true]);
    expect(line({ ...ANY, size: [10, 20] }, true)).toEqual(["--min-volume 10", false]);
    expect(selectionOptions({ ...ANY, contrast: [0, 3] }, true)).toEqual([["persistence", 0]]);
    expect(isSelection({ ...ANY, contrast: [0, 3] })).toBe(false);
  });
  it("survives a link; invalid text is rejected", () => {
    const choice: Choice = { significant: true, keep: 12, contrast: [0.25, null], size: [null, 1e6] };
    const state = TAB.with(CHOICE.with(NOTHING, choice), "tree");
    const back = fromHash(toHash(state), 4);
    expect(back && CHOICE.of(back)).toEqual(choice);
    expect(back && TAB.of(back)).toBe("tree");
    const wrong = ["", "1,2", "x,,,,,", ",-1,,,,", ",1.5,,,,", ",,nan,,,", ",,-2,,,", ",,,,,,"];
    for (const word of wrong) expect(CHOICE.accepts(word), word).toBe(false);
    expect(CHOICE.accepts(",,,,,")).toBe(true);
    expect(TAB.accepts("pictures")).toBe(false);
  });
  it("is undone; the tab is not", () => {
    const history = new History(isolate(NOTHING, 0, 1));
    history.go(CHOICE.with(history.now, ANY));
    history.changeAll((state) => TAB.with(state, "scatter"));
    expect(history.undo()).toBe(true);
    expect(CHOICE.of(history.now)).toBeNull();
    expect(TAB.of(history.now)).toBe("scatter");
    expect(history.undo()).toBe(false);
  });
});

describe("the search", () => {
  const volume = small();
  const catalogue = catalogueOf(volume, 6);
  const all = catalogue.chosen({ ...ANY, keep: 6 });
  const found = (text: string, order = "rank"): number[] => find(volume, all, [], { text, order }).objects;
  it("matches names, numbers and reasons", () => {
    expect(found("")).toEqual(all);
    expect(found("sharp")).toEqual([2]);
    expect(found("3")).toEqual([2]);
    expect(found("rank 4")).toEqual([7]);
    expect(found("v203")).toEqual([7]);
    expect(found("203")).toEqual([]);
    expect(found("nothing of this")).toEqual([]);
    expect(find(volume, all, [], { text: "nothing of this", order: "rank" }).everything).toBe(false);
    expect(find(volume, all, [], { text: "c1", order: "rank" }).cavities).toEqual([3]);
  });
  it("sorts, with cavities and other objects of the scene apart", () => {
    expect(found("", "isovalue").slice(0, 2)).toEqual([1, 9]);
    const scene = isolate(NOTHING, 8, 1).shown;
    expect(find(volume, [0], scene, { text: "", order: "rank" })).toEqual({
      objects: [0],
      cards: [0],
      background: [],
      cavities: [3],
      others: [8],
      everything: true,
    });
  });
  it("has one card for what looks the same, but for what is in the scene or found, and keeps the scanned field apart", () => {
    const same = page(
      [branch({}), branch({ merges: 20 })],
      [
        entry({ number: 1, card: 1, background: true }),
        entry({ number: 2, card: 2 }),
        entry({ number: 3, card: 2, overlap: 0.8 }),
        entry({ branch: 1, number: 4, card: 4 }),
      ],
    );
    const cardsOf = (shown: State["shown"], text = ""): number[][] => {
      const { cards, background } = find(same, [0, 1, 2, 3], shown, { text, order: "rank" });
      return [cards, background];
    };
    expect(cardsOf([])).toEqual([[1, 3], [0]]);
    expect(cardsOf(isolate(NOTHING, 2, 1).shown)).toEqual([[1, 2, 3], [0]]);
    expect(cardsOf(isolate(NOTHING, 0, 1).shown)).toEqual([[0, 1, 3], []]);
    expect(cardsOf([], "object 3")).toEqual([[2], []]);
  });
});

describe("the brackets of the selected object", () => {
  it("are at the corners of its bounding box", () => {
    const box = boxOf({ positions: new Uint16Array([0, 4, 8, 10, 2, 6]), origin: [1, 2, 3], step: 0.5 });
    expect(box).toEqual([[1, 3, 6], [6, 4, 7]]);
    const arms = armsOf([[0, 0, 0], [100, 100, 100]]);
    expect(arms.length).toBe(8 * 3 * 2 * 3);
    expect(arms.slice(0, 6)).toEqual([0, 0, 0, 16, 0, 0]);
    expect(arms.slice(-6)).toEqual([100, 100, 100, 100, 100, 84]);
  });
});

describe("the scatter plot", () => {
  it("spans the positive numbers, with a margin", () => {
    const { min, max } = spanOf([0, 1, 1e6]);
    expect([min, max].map((limit) => Number(limit.toPrecision(3)))).toEqual([0.575, 1740000]);
    for (const one of [spanOf([3]), spanOf([]), spanOf([0])]) expect(one.max / one.min).toBeGreaterThan(1.1);
  });
});
