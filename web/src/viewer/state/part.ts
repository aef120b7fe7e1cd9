// A named part of the state: one parameter of the address. It takes part in undo, links and scene files.
export interface HasParts {
  readonly parts: Readonly<Record<string, string>>;
}

const registry = new Map<string, Part<unknown>>();

export class Part<T> {
  /**
   * key: in the address; title: name of a change, after "undo: "; read: null for invalid text; initial: never
   * written; oldKey: accepted in addresses and files of earlier versions.
   */
  constructor(
    readonly key: string,
    readonly title: string,
    readonly initial: T,
    private readonly write: (value: T) => string,
    private readonly read: (text: string) => T | null,
    oldKey = key,
  ) {
    for (const name of [key, oldKey]) registry.set(name, this as Part<unknown>);
  }

  of(state: HasParts): T {
    const text = state.parts[this.key];
    return text === undefined ? this.initial : (this.read(text) ?? this.initial);
  }

  with<S extends HasParts>(state: S, value: T): S {
    const { [this.key]: _, ...others } = state.parts;
    const text = this.write(value);
    return { ...state, parts: text === this.write(this.initial) ? others : { ...others, [this.key]: text } };
  }

  accepts(text: string): boolean {
    return this.read(text) !== null;
  }
}

/** A switch, initially off. */
export function flag(key: string, title: string): Part<boolean> {
  return new Part(
    key,
    title,
    false,
    (on) => (on ? "1" : "0"),
    (text) => (text === "1" ? true : text === "0" ? false : null),
  );
}

/** A number, initially null. */
export function number(
  key: string,
  title: string,
  isGood: (n: number) => boolean = () => true,
  oldKey = key,
): Part<number | null> {
  const read = (text: string): number | null =>
    text.trim() !== "" && Number.isFinite(Number(text)) && isGood(Number(text)) ? Number(text) : null;
  return new Part<number | null>(key, title, null, (n) => (n === null ? "" : String(Number(n.toPrecision(7)))), read, oldKey);
}

/** Numbers separated by commas, with up to seven digits. */
export function textOf(list: readonly number[]): string {
  return list.map((n) => Number(n.toPrecision(7))).join(",");
}

/** null: invalid. */
export function numbersIn(text: string): number[] | null {
  const list = text.split(",").map((word) => (word.trim() === "" ? NaN : Number(word)));
  return list.every(Number.isFinite) ? list : null;
}

/** A fixed number of numbers, initially null. */
export function numbers(
  key: string,
  title: string,
  count: number,
  isGood: (list: number[]) => boolean = () => true,
): Part<number[] | null> {
  const read = (text: string): number[] | null => {
    const list = numbersIn(text);
    return list && list.length === count && isGood(list) ? list : null;
  };
  return new Part<number[] | null>(key, title, null, (list) => (list === null ? "" : textOf(list)), read);
}

/** By its key, or its key of earlier versions. */
export function partNamed(key: string): Part<unknown> | undefined {
  return registry.get(key);
}
