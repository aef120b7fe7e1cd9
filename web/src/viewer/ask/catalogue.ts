// All objects of a volume, those without an entry on the page too. Each has a number like an entry has, so that it is shown and selected
// like one: the bright object of rank r without an entry has the number entries.length + r.
import { entryOf, type Branch, type Entry, type Page } from "../../page";
import { CHOICE, isChosen, type Choice, type Sizes } from "../state/choosing";
import type { State } from "../state/state";

/** docs/schema/server-branches.schema.json: of the most important objects, one array for each number. */
export interface Branches {
  /** the store, as a word of a command line */
  source: string;
  /** objects of the volume */
  all: number;
  id: number[];
  voxel: number[];
  tau: number[];
  low: number[];
  high: number[];
  tunnels: number[];
  cavities: number[];
  appears: number[];
  merges: (number | null)[];
  parent: number[];
  persistence: number[];
  hypervolume: number[];
  voxels: number[];
  measure: number[];
  standsOut: boolean[];
}

/** The server lists at most so many. */
export const MOST_LISTED = 20_000;

/** How many numbers there are: what an address may name. */
export function numbersOf(page: Page): number {
  return page.entries.length + Math.min(page.objects.bright.all, MOST_LISTED);
}

const [SOME, FLAGS]: [number[], boolean[]] = [[], []];
const NONE: Branches = {
  ...{ source: "", all: 0, id: SOME, voxel: SOME, tau: SOME, low: SOME, high: SOME, tunnels: SOME, cavities: SOME },
  ...{ appears: SOME, merges: SOME, parent: SOME, persistence: SOME, hypervolume: SOME, voxels: SOME, measure: SOME, standsOut: FLAGS },
};

/** Does a state speak of more than the page has? */
export function needsAll(page: Page, state: State): boolean {
  return CHOICE.of(state) !== null || state.shown.some(({ entry }) => entry >= page.entries.length);
}

export class Catalogue {
  /** per rank; empty: they are not yet known */
  sizes: Sizes[] = [];
  private listed = NONE;
  /** per rank: the position in page.branches */
  private place: number[] = [];
  private readonly entriesOfPlace = new Map<number, number[]>();
  private readonly further = new Map<number, Entry>();

  constructor(private readonly page: Page) {
    page.entries.forEach((entry, i) => this.entriesOfPlace.set(entry.branch, [...(this.entriesOfPlace.get(entry.branch) ?? []), i]));
    page.further = (i) => this.furtherEntry(i);
  }

  /** Completes the page: its branches are all that are listed, and it has further entries. */
  learn(listed: Branches): void {
    const { unit } = this.page.volume;
    this.listed = listed;
    this.sizes = listed.id.map((_, rank) => ({
      rank,
      contrast: listed.persistence[rank] ?? 0,
      size: (unit === null ? listed.voxels : listed.measure)[rank] ?? 0,
      standsOut: listed.standsOut[rank] ?? false,
    }));
    this.completeBranches();
  }

  get isKnown(): boolean {
    return this.listed !== NONE;
  }
  /** objects of the volume */
  get all(): number {
    return this.page.objects.bright.all;
  }
  get source(): string {
    return this.listed.source;
  }

  /** Numbers of the bright objects that are chosen, the most important one first; an object may have several. */
  chosen(choice: Choice | null): number[] {
    if (choice === null) return this.page.entries.flatMap((entry, i) => (this.page.branches[entry.branch]?.side === "bright" ? [i] : []));
    return this.sizes.filter((sizes) => isChosen(choice, sizes)).flatMap(({ rank }) => this.numbersOfRank(rank));
  }

  /** How many objects these are. */
  objectsOf(numbers: number[]): number {
    return new Set(numbers.map((i) => entryOf(this.page, i).branch)).size;
  }

  numbersOfRank(rank: number): number[] {
    return this.entriesOfPlace.get(this.place[rank] ?? -1) ?? [this.page.entries.length + rank];
  }

  /** What a position in page.branches is shown as; undefined: as nothing that is known yet. */
  numberOfBranch(branch: number): number | undefined {
    const [own] = this.entriesOfPlace.get(branch) ?? [];
    const { side, rank } = this.page.branches[branch] ?? {};
    return own !== undefined || side !== "bright" || rank === undefined || !this.isKnown ? own : this.numbersOfRank(rank)[0];
  }

  private completeBranches(): void {
    const { branches } = this.page;
    branches.forEach((branch, b) => branch.side === "bright" && (this.place[branch.rank] = b));
    this.listed.id.forEach((_, rank) => (this.place[rank] ??= branches.push(this.branchOfRank(rank)) - 1));
    this.listed.parent.forEach((parent, rank) => {
      const [own, other] = [branches[this.place[rank] ?? -1], this.place[parent]];
      if (own) own.parent = other ?? -1; // a branch merges into a more important one: it is listed too
    });
  }

  private branchOfRank(rank: number): Branch {
    const { listed } = this;
    return {
      side: "bright",
      id: listed.id[rank] ?? -1,
      rank,
      appears: listed.appears[rank] ?? 0,
      merges: listed.merges[rank] ?? null,
      parent: -1,
      hypervolume: listed.hypervolume[rank] ?? 0,
      voxels: listed.voxels[rank] ?? 0,
      measure: listed.measure[rank] ?? 0,
      joined: 0,
      standsOut: listed.standsOut[rank] ?? false,
    };
  }

  private furtherEntry(i: number): Entry | undefined {
    const rank = i - this.page.entries.length;
    if (!Number.isInteger(rank) || rank < 0 || rank >= this.listed.id.length) return undefined;
    const entry = this.further.get(i) ?? this.entryOfRank(rank);
    this.further.set(i, entry);
    return entry;
  }

  private entryOfRank(rank: number): Entry {
    const { listed } = this;
    const [id, tau] = [listed.voxel[rank] ?? 0, listed.tau[rank] ?? 0];
    const what = `${listed.source} --object ${id} --tau ${tau}`;
    return {
      branch: this.place[rank] ?? 0,
      id,
      tau,
      low: listed.low[rank] ?? tau,
      high: listed.high[rank] ?? tau,
      voxels: listed.voxels[rank] ?? 0,
      measure: listed.measure[rank] ?? 0,
      tunnels: listed.tunnels[rank] ?? 0,
      cavities: listed.cavities[rank] ?? 0,
      inside: -1,
      around: -1,
      reason: "merge",
      why: "as large as it gets before it merges",
      colour: COLOURS[rank % COLOURS.length] ?? "#999999",
      picture: null,
      commands: [
        { name: "surface", line: `isoatlas extract ${what} -o object-${rank + 1}.ply` },
        { name: "picture", line: `isoatlas render ${listed.source} --object ${id}@${tau} -o object-${rank + 1}.png` },
      ],
    };
  }
}

/** those of the pictures: palette() of src/render/colours.cpp */
const COLOURS = ["#e6d8ba", "#56b4e9", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#0072b2"];
