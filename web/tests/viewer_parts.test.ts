import { describe, expect, it } from "vitest";
import { add, change, fromHash, History, isolate, nextEvent, NOTHING, remove, toHash, type State } from "../src/viewer/state";
import { roundLength } from "../src/viewer/scale_bar";
import { unfolded } from "../src/viewer/wire";

const two: State = add(isolate(NOTHING, 3, 10), 1, 20.5);

describe("a scene", () => {
  it("holds every object at its own isovalue", () => {
    expect(two.shown.map(({ entry, tau }) => [entry, tau])).toEqual([
      [3, 10],
      [1, 20.5],
    ]);
    expect(two.selected).toBe(1);
    expect(add(two, 3, 99).selected).toBe(0);
    expect(change(two, 0, { tau: 11 }).shown[0]?.tau).toBe(11);
    expect(remove(remove(two, 1), 0)).toEqual(NOTHING);
  });
  it("keeps an object's isovalue when it is isolated", () => {
    expect(isolate(change(two, 1, { tau: 7 }), 1, 20.5).shown).toEqual([{ entry: 1, tau: 7, opacity: 1, visible: true }]);
  });
  it("is the same after a link", () => {
    const seen = { ...change(two, 0, { opacity: 0.4 }), view: [1, 2, 3, -4, 5.5, 6] };
    expect(fromHash(toHash(seen), 4)).toEqual(seen);
    expect(fromHash(toHash(NOTHING), 0)).toEqual(NOTHING);
  });
  it("is not made of what is none", () => {
    for (const hash of ["", "#", "#scene=1", "#scene=9,1,1,1", "#scene=-2,1,1,1", "#scene=1,x,1,1", "#scene=1,1,2,1", "#scene=1.5,1,1,1", "#scene=1,1,1,1,1"])
      expect(fromHash(hash, 4), hash).toBeNull();
    expect(fromHash("#scene=1,1,1,1&selected=7&view=1,2,x,4,5,6", 4)).toEqual({ shown: [{ entry: 1, tau: 1, opacity: 1, visible: true }], selected: 0, view: null });
  });
});

describe("history", () => {
  it("goes back and forth, and a drag is one step", () => {
    const history = new History(NOTHING);
    const seen: number[] = [];
    history.listen((state) => seen.push(state.shown[0]?.tau ?? -1));
    history.go(isolate(NOTHING, 0, 1));
    for (const tau of [2, 3, 4]) history.go(change(history.now, 0, { tau }), true);
    history.go(change(history.now, 0, { tau: 5 }));
    expect(history.undo()).toBe(true);
    expect(history.now.shown[0]?.tau).toBe(4);
    expect(history.undo()).toBe(true);
    expect(history.now.shown[0]?.tau).toBe(1);
    expect(history.redo()).toBe(true);
    expect(history.undo() && history.undo() && history.undo()).toBe(false);
    expect(history.now).toEqual(NOTHING);
    expect(seen).toEqual([1, 2, 3, 4, 5, 4, 1, 4, 1, -1]);
  });
});

describe("events", () => {
  it("lie above or below", () => {
    expect(nextEvent([5, null, 1, 9], 5, true)).toBe(9);
    expect(nextEvent([5, null, 1, 9], 5, false)).toBe(1);
    expect(nextEvent([5, null, 1, 9], 9, true)).toBeNull();
    expect(nextEvent([], 0, false)).toBeNull();
  });
});

describe("normals", () => {
  it("unfold to the sphere", () => {
    expect(unfolded(0, 0)).toEqual([0, 0, 127]);
    expect(unfolded(127, 0)).toEqual([127, 0, 0]);
    expect(unfolded(0, -127)).toEqual([0, -127, 0]);
    expect(unfolded(127, 127).map(Math.abs)).toEqual([0, 0, 127]);
    for (let a = -127; a <= 127; a += 5) for (let b = -127; b <= 127; b += 5) expect(Math.abs(Math.hypot(...unfolded(a, b)) - 127)).toBeLessThan(1.1);
  });
});

describe("the scale bar", () => {
  it("has a round length", () => {
    expect([0, 0.99, 1, 1.99, 2, 4.9, 7, 99, 0.03].map(roundLength)).toEqual([0, 0.5, 1, 1, 2, 2, 5, 50, 0.02]);
  });
});
