// Pages of objects of high and of low values: names, order, what belongs to which side.
import { describe, expect, it } from "vitest";
import { chosenEntries, firstChoice, ranked } from "../src/page/choice";
import { hiddenSentences } from "../src/shared/hidden_counts";
import { anchorOf, inOrderOfMerges, nameOf, placeOf, rangeOf, referenceOf, valuesOf } from "../src/shared/names";
import { branchOf, endOfBranch, type Page } from "../src/shared/page";
import { Catalogue, type BranchList } from "../src/viewer/api/catalogue";
import { applyNames } from "../src/viewer/api/object_names";
import { polarityOfEntry, targetOf } from "../src/viewer/api/entries";
import { find } from "../src/viewer/panels/object_search";
import { branch, entry, page } from "./sample";

/** A body with a hole, air around it, and a spot that merges into the air. */
function both(): Page {
  const made = page(
    [
      branch({ polarity: "high", id: 10, appears: 90, merges: null, hypervolume: 5000 }),
      branch({ polarity: "low", id: 20, rank: 0, appears: 0, merges: null, hypervolume: 7000 }),
      branch({ polarity: "low", id: 21, rank: 1, appears: 5, merges: 60, parent: 1, hypervolume: 300 }),
      branch({ polarity: "low", id: 22, rank: 2, appears: 8, merges: 30, parent: 1, hypervolume: 200 }),
    ],
    [
      entry({ branch: 1, number: 1, reference: "low1", id: 20, tau: 40, border: "reaches the border on all sides (90 % of it)" }),
      entry({ branch: 0, number: 1, reference: "1", id: 10, tau: 50 }),
      entry({ branch: 2, number: 2, reference: "low2", id: 21, tau: 45, inside: 0, around: 1, enclosed: true }),
      entry({ branch: 3, number: 3, reference: "low3", id: 22, tau: 20, inside: 0, enclosed: false }),
    ],
  );
  const found = { all: 7, significant: 3 };
  return { ...made, polarity: "both", low: { found, noise: 1, spectrum: null, curve: made.curve } };
}

describe("a page of both polarities", () => {
  it("names objects as commands do", () => {
    const scene = both();
    expect([0, 1, 2].map((i) => referenceOf(scene, i))).toEqual(["low1", "1", "low2"]);
    expect([0, 1].map((i) => nameOf(scene, i))).toEqual(["Object low1", "Object 1"]);
    expect(anchorOf(scene, 2)).toBe("object-low2");
    expect([0, 1].map((i) => valuesOf(scene, i))).toEqual(["at most 40", "at least 50"]);
  });

  it("says where objects of low values lie, and where they exist", () => {
    const scene = both();
    expect(placeOf(scene, 2)).toBe("a cavity of object 1");
    expect(placeOf(scene, 3)).toBe("inside object low1");
    expect(rangeOf(branchOf(scene, 1), scene)).toBe("from 0 upwards, never merges");
    expect(rangeOf(branchOf(scene, 0), scene)).toBe("from 90 downwards, never merges");
    expect(endOfBranch(scene, branchOf(scene, 1))).toBe(scene.axis.high);
    expect(endOfBranch(scene, branchOf(scene, 0))).toBe(scene.axis.low);
  });

  it("keeps the order of its list, and can show one side", () => {
    const scene = both();
    expect(ranked(scene)).toEqual([1, 0, 2, 3]);
    expect(chosenEntries(scene, firstChoice(scene))).toEqual([0, 1, 2, 3]);
    expect(chosenEntries(scene, { ...firstChoice(scene), side: "high" })).toEqual([1]);
    expect(inOrderOfMerges(scene, [2, 3])).toEqual([3, 2]);
  });

  it("counts both sides", () => {
    const scene = both();
    expect(hiddenSentences(scene).at(-1)).toBe("7 objects of low values in all, 3 shown. 4 not shown: below noise level or very small.");
  });

  it("asks the server for the side of an object", () => {
    const scene = both();
    expect(targetOf(scene, 0)).toEqual({ object: 20, polarity: "low" });
    expect(targetOf(scene, 1)).toEqual({ object: 10 });
    expect([-1, 0, 1].map((i) => polarityOfEntry(scene, i))).toEqual([undefined, "low", undefined]);
  });

  it("finds objects by their reference, and gives names to those of their side", () => {
    const scene = both();
    const options = { order: "rank" };
    expect(find(scene, [0, 1, 2, 3], [], { ...options, text: "low2" }).objects).toEqual([2]);
    expect(find(scene, [0, 1, 2, 3], [], { ...options, text: "1" }).objects).toEqual([0, 1]);
    applyNames(scene, [
      { name: "air", side: "object", polarity: "low", id: 20, tau: 40 },
      { name: "other", side: "object", polarity: "high", id: 21, tau: 45 },
    ]);
    expect(scene.entries.map(({ name }) => name ?? null)).toEqual(["air", null, null, null]);
  });

  it("takes further objects for those of high values", () => {
    const scene = both();
    const catalogue = new Catalogue(scene);
    const one: BranchList = {
      ...{ source: "scan.atlas", all: 2, id: [10, 11], voxel: [10, 11], tau: [50, 60], low: [40, 55], high: [60, 65] },
      ...{ tunnels: [0, 0], cavities: [0, 0], appears: [90, 70], merges: [null, 55], parent: [-1, 0], persistence: [90, 15] },
      ...{ hypervolume: [5000, 30], voxels: [1000, 4], measure: [1000, 4], significant: [true, false] },
    };
    catalogue.load(one);
    expect(catalogue.numbersOfRank(0)).toEqual([1]);
    expect(catalogue.numbersOfRank(1)).toEqual([scene.entries.length + 1]);
    expect(branchOf(scene, 1).polarity).toBe("low"); // its rank is that of its own side
    expect(referenceOf(scene, scene.entries.length + 1)).toBe("v11");
  });
});
