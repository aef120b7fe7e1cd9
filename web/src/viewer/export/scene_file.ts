// Scene files: docs/scene.md. Invalid files are rejected with the position and what was expected.
import { entryOf, type Page } from "../../shared/page";
import { numbersOf } from "../api/catalogue";
import { partNamed } from "../state/part";
import { titleOf } from "../api/entries";
import type { Shown, State } from "../state/state";

const SCHEMA = "isoatlas/scene/1";

/** Text of the file. Objects are identified by their representative voxel in the store, independent of list order. */
export function writeScene(page: Page, state: State, indent = 2): string {
  const shown = state.shown.map((one) => ({
    id: one.entry < 0 ? null : entryOf(page, one.entry).id,
    name: titleOf(page, one.entry),
    ...one,
  }));
  const { name, size } = page.volume;
  const { selected, view, parts } = state;
  return `${JSON.stringify({ schema: SCHEMA, volume: { name, size }, shown, selected, view, parts }, null, indent)}\n`;
}

/** Throws Error: what is wrong, where, and what was expected. */
export function readScene(page: Page, text: string): State {
  const file = new Reader(parsed(text), "the scene");
  if (file.text("schema") !== SCHEMA) throw new Error(`The scene has the schema "${file.text("schema")}"; this viewer reads "${SCHEMA}".`);
  const size = file.within("volume").list("size", (at, where) => at.whole(where, 1, Infinity));
  if (String(size) !== String(page.volume.size))
    throw new Error(`The scene is of a volume of ${size.join(" x ")} samples, this one has ${page.volume.size.join(" x ")}.`);
  const shown = file.list("shown", (at, where) => shownOf(page, at.within(where)));
  const twice = shown.findIndex(({ entry }, i) => shown.findIndex((other) => other.entry === entry) < i);
  if (twice >= 0) throw new Error(`shown[${twice}] is a duplicate of an object of the scene.`);
  const view = file.value("view") === null ? null : file.list("view", (at, where) => at.number(where, -Infinity, Infinity));
  if (view && view.length !== 6) throw new Error(`view has ${view.length} numbers; it takes six, or null.`);
  return { shown, selected: file.whole("selected", -1, shown.length - 1), view, parts: partsOf(file.within("parts")) };
}

function parsed(text: string): unknown {
  try {
    return JSON.parse(text) as unknown;
  } catch (error) {
    throw new Error(`This is not JSON: ${error instanceof Error ? error.message : "it cannot be read"}.`);
  }
}

function shownOf(page: Page, at: Reader): Shown {
  const entry = at.whole("entry", -1, numbersOf(page) - 1);
  const id = at.value("id");
  const expected = entry < 0 ? null : entryOf(page, entry).id;
  if (id !== expected)
    throw new Error(
      `${at.where}.id is ${JSON.stringify(id)}, but entry ${entry} of this volume is ${expected}: the scene is of another volume.`,
    );
  const colour = at.value("colour");
  if (colour !== null && !(typeof colour === "string" && /^#[0-9a-f]{6}$/.test(colour)))
    throw new Error(`${at.where}.colour is ${JSON.stringify(colour)}; it takes #rrggbb in small letters, or null.`);
  const walls = at.text("walls");
  if (walls !== "all" && walls !== "cavities") throw new Error(`${at.where}.walls is "${walls}"; it takes "all" or "cavities".`);
  return {
    entry,
    tau: at.number("tau", -Infinity, Infinity),
    opacity: at.number("opacity", 0, 1),
    visible: at.truth("visible"),
    colour,
    walls,
  };
}

function partsOf(at: Reader): Record<string, string> {
  return Object.fromEntries(
    at.names().map((key) => {
      const text = at.text(key);
      const part = partNamed(key);
      if (!part?.accepts(text)) throw new Error(`${at.where}.${key} is "${text}", which this viewer does not support.`);
      return [part.key, text];
    }),
  );
}

/** Typed access to the members of a JSON object. */
class Reader {
  constructor(
    private readonly all: unknown,
    readonly where: string,
  ) {
    if (typeof all !== "object" || all === null) throw new Error(`${where} is ${JSON.stringify(all)}; an object was expected.`);
  }

  names(): string[] {
    return Object.keys(this.all as object);
  }
  value(name: string): unknown {
    const value = (this.all as Record<string, unknown>)[name];
    if (value === undefined) throw new Error(`${this.where} has no "${name}".`);
    return value;
  }
  within(name: string): Reader {
    return new Reader(this.value(name), this.at(name));
  }
  text(name: string): string {
    const value = this.value(name);
    return typeof value === "string" ? value : this.bad(name, "a text");
  }
  truth(name: string): boolean {
    const value = this.value(name);
    return typeof value === "boolean" ? value : this.bad(name, "true or false");
  }
  number(name: string, min: number, max: number): number {
    const value = this.value(name);
    return typeof value === "number" && value >= min && value <= max
      ? value
      : this.bad(name, `a number${max < Infinity ? ` from ${min} to ${max}` : ""}`);
  }
  whole(name: string, min: number, max: number): number {
    const value = this.number(name, min, max);
    return Number.isInteger(value) ? value : this.bad(name, "a whole number");
  }
  list<T>(name: string, read: (at: Reader, where: string) => T): T[] {
    const value = this.value(name);
    if (!Array.isArray(value)) return this.bad(name, "a list");
    const items = new Reader(value, this.at(name));
    return value.map((_, i) => read(items, String(i)));
  }

  private at(name: string): string {
    const key = /^\d+$/.test(name) ? `[${name}]` : this.where === "the scene" ? name : `.${name}`;
    return this.where === "the scene" ? key : `${this.where}${key}`;
  }
  private bad(name: string, expected: string): never {
    throw new Error(`${this.at(name)} is ${JSON.stringify(this.value(name))}; ${expected} was expected.`);
  }
}
