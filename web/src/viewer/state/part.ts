// What a part of the viewer keeps in a state: one word of the address, under a name of its own. It is undone, linked and saved as the
// rest.
export interface HasParts {
  readonly parts: Readonly<Record<string, string>>;
}

const known = new Map<string, Part<unknown>>();

export class Part<T> {
  /**
   * key: in the address; title: what a change of it is called, after "undo: ". read gives null for what is none of its words; first is
   * never written.
   */
  constructor(
    readonly key: string,
    readonly title: string,
    readonly first: T,
    private readonly write: (value: T) => string,
    private readonly read: (text: string) => T | null,
  ) {
    known.set(key, this as Part<unknown>);
  }

  of(state: HasParts): T {
    const text = state.parts[this.key];
    return text === undefined ? this.first : (this.read(text) ?? this.first);
  }

  in<S extends HasParts>(state: S, value: T): S {
    const { [this.key]: _, ...others } = state.parts;
    const text = this.write(value);
    return { ...state, parts: text === this.write(this.first) ? others : { ...others, [this.key]: text } };
  }

  takes(text: string): boolean {
    return this.read(text) !== null;
  }
}

/** What is on or off, off at first. */
export function flag(key: string, title: string): Part<boolean> {
  return new Part(
    key,
    title,
    false,
    (on) => (on ? "1" : "0"),
    (text) => (text === "1" ? true : text === "0" ? false : null),
  );
}

/** A number, null at first. */
export function number(key: string, title: string, isGood: (n: number) => boolean = () => true): Part<number | null> {
  const read = (text: string): number | null =>
    text.trim() !== "" && Number.isFinite(Number(text)) && isGood(Number(text)) ? Number(text) : null;
  return new Part<number | null>(key, title, null, (n) => (n === null ? "" : String(Number(n.toPrecision(7)))), read);
}

/** Numbers between commas, of up to seven digits. */
export function textOf(list: readonly number[]): string {
  return list.map((n) => Number(n.toPrecision(7))).join(",");
}

/** null: it is none of them. */
export function numbersIn(text: string): number[] | null {
  const list = text.split(",").map((word) => (word.trim() === "" ? NaN : Number(word)));
  return list.every(Number.isFinite) ? list : null;
}

/** So many numbers, null at first. */
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

export function partNamed(key: string): Part<unknown> | undefined {
  return known.get(key);
}
