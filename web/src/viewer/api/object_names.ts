// Names that users give to objects and cavities: read from the server, and changed there.
import { isCavity, referenceOf } from "../../shared/names";
import { entryOf, type Page } from "../../shared/page";
import type { Api, GivenName } from "./api";

/** Entries of the page take their names; others lose theirs. */
export function applyNames(page: Page, names: readonly GivenName[]): void {
  page.entries.forEach((entry, i) => {
    const side = isCavity(page, i) ? "cavity" : "object";
    const polarity = page.branches[entry.branch]?.polarity; // of pages of both
    const isOf = (one: GivenName): boolean => one.side === side && (polarity === undefined || polarity === (one.polarity ?? "high"));
    entry.name = names.find((one) => isOf(one) && one.id === entry.id && one.tau === entry.tau)?.name ?? null;
  });
}

export class ObjectNames {
  private readonly listeners: (() => void)[] = [];

  constructor(
    private readonly api: Api,
    private readonly page: Page,
  ) {}

  /** Calls when a name has changed. */
  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }

  async load(): Promise<void> {
    this.take(await this.api.names());
  }

  /** Only entries of the page have names. */
  canName(i: number): boolean {
    return i >= 0 && i < this.page.entries.length;
  }

  /** Empty: takes the name away. Throws Error with the reason when the server refuses. */
  async rename(i: number, name: string): Promise<void> {
    const reference = `${referenceOf(this.page, i)}@${entryOf(this.page, i).tau}`;
    this.take(await this.api.rename(isCavity(this.page, i) ? "contour" : "object", reference, name.trim()));
  }

  private take(names: GivenName[]): void {
    const before = JSON.stringify(this.page.entries.map((entry) => entry.name ?? null));
    applyNames(this.page, names);
    if (JSON.stringify(this.page.entries.map((entry) => entry.name ?? null)) !== before) this.listeners.forEach((listener) => listener());
  }
}
