import { describe, expect, it } from "vitest";
import { fromHash, toHash } from "../src/viewer/state/address";
import { History } from "../src/viewer/state/history";
import { flag, number } from "../src/viewer/state/part";
import { add, change, changeAll, isolate, nextEvent, NOTHING, remove, shownAt, type State } from "../src/viewer/state/state";
import { roundLength } from "../src/viewer/scene/scale_bar";
import { decodeOctahedral } from "../src/shared/wire";

const two: State = add(isolate(NOTHING, 3, 10), 1, 20.5);

describe("a scene", () => {
  it("has every object at its own isovalue", () => {
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
    expect(isolate(change(two, 1, { tau: 7 }), 1, 20.5).shown).toEqual([shownAt(1, 7)]);
  });
  it("survives a link", () => {
    const seen = {
      ...change(two, 0, { opacity: 0.4, colour: "#12ab00", walls: "cavities" as const, visible: false }),
      view: [1, 2, 3, -4, 5.5, 6],
    };
    expect(fromHash(toHash(seen), 4)).toEqual(seen);
    expect(fromHash(toHash(NOTHING), 0)).toEqual(NOTHING);
  });
  it("is not read from invalid text", () => {
    for (const hash of [
      "",
      "#",
      "#scene=1",
      "#scene=9,1,1,1",
      "#scene=-2,1,1,1",
      "#scene=1,x,1,1",
      "#scene=1,1,2,1",
      "#scene=1.5,1,1,1",
      "#scene=1,1,1,1,1",
      "#scene=1,1,1,1;1,2,1,1",
      "#scene=1,1,1,1,,half",
    ])
      expect(fromHash(hash, 4), hash).toBeNull();
    expect(fromHash("#scene=1,1,1,1&selected=7&view=1,2,x,4,5,6", 4)).toEqual({ ...NOTHING, shown: [shownAt(1, 1)], selected: 0 });
  });
});

describe("parts of a state", () => {
  const [lit, step] = [flag("lit", "light"), number("step", "step", (n) => n > 0)];
  it("are part of links, except initial values", () => {
    const state = step.with(lit.with(two, true), 0.25);
    expect([lit.of(state), step.of(state), lit.of(two), step.of(two)]).toEqual([true, 0.25, false, null]);
    expect(toHash(state)).toBe(`${toHash(two)}&lit=1&step=0.25`);
    expect(fromHash(toHash(state), 4)).toEqual(state);
    expect(lit.with(step.with(state, null), false)).toEqual(two);
  });
  it("reject invalid text", () => {
    expect(fromHash(`${toHash(two)}&lit=2&step=-1&other=1`, 4)).toEqual(two);
  });
});

describe("history", () => {
  it("undoes and redoes; a drag is one step, and every step has a name", () => {
    const history = new History(NOTHING);
    const seen: [number, boolean][] = [];
    history.listen((state, _, dragging) => seen.push([state.shown[0]?.tau ?? -1, dragging]));
    history.go(isolate(NOTHING, 0, 1));
    for (const tau of [2, 3, 4]) history.go(change(history.now, 0, { tau }), true);
    history.go(change(history.now, 0, { tau: 4 }));
    expect(history.undoes).toBe("isovalue");
    expect(history.undo()).toBe(true);
    expect(history.now.shown[0]?.tau).toBe(1);
    expect([history.undoes, history.redoes]).toEqual(["add to scene", "isovalue"]);
    expect(history.redo()).toBe(true);
    expect(history.undo() && history.undo() && history.undo()).toBe(false);
    expect(history.now).toEqual(NOTHING);
    expect(seen).toEqual([[1, false], [2, true], [3, true], [4, true], [4, false], [1, false], [4, false], [1, false], [-1, false]]);
  });
  it("separates consecutive drags, and ignores states without a change", () => {
    const history = new History(two);
    history.go(change(history.now, 0, { tau: 5 }), true);
    history.go(change(history.now, 0, { opacity: 0.5 }), true);
    history.go({ ...history.now, view: [0, 0, 0, 1, 1, 1] }, true);
    history.go({ ...history.now });
    history.go({ ...history.now });
    expect(history.undoes).toBe("view");
    expect(history.undo() && history.undoes).toBe("opacity");
    expect(history.undo() && history.undo() && history.undo()).toBe(false);
    expect(history.now).toEqual(two);
  });
  it("names changes of all objects, of one, and of the list", () => {
    const history = new History(two);
    history.go(changeAll(history.now, { tau: 8 }));
    expect(history.undoes).toBe("isovalue of all");
    history.go(remove(history.now, 0));
    expect(history.undoes).toBe("remove from scene");
  });
});

describe("events", () => {
  it("are found above or below", () => {
    expect(nextEvent([5, null, 1, 9], 5, true)).toBe(9);
    expect(nextEvent([5, null, 1, 9], 5, false)).toBe(1);
    expect(nextEvent([5, null, 1, 9], 9, true)).toBeNull();
    expect(nextEvent([], 0, false)).toBeNull();
  });
});

describe("octahedral normals", () => {
  it("are decoded to unit vectors", () => {
    expect(decodeOctahedral(0, 0)).toEqual([0, 0, 127]);
    expect(decodeOctahedral(127, 0)).toEqual([127, 0, 0]);
    expect(decodeOctahedral(0, -127)).toEqual([0, -127, 0]);
    expect(decodeOctahedral(127, 127).map(Math.abs)).toEqual([0, 0, 127]);
    for (let a = -127; a <= 127; a += 5)
      for (let b = -127; b <= 127; b += 5) expect(Math.abs(Math.hypot(...decodeOctahedral(a, b)) - 127)).toBeLessThan(1.1);
  });
});

describe("the scale bar", () => {
  it("has a round length", () => {
    expect([0, 0.99, 1, 1.99, 2, 4.9, 7, 99, 0.03].map(roundLength)).toEqual([0, 0.5, 1, 1, 2, 2, 5, 50, 0.02]);
  });
});
