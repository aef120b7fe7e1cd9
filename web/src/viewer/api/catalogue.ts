// All objects of a volume, including those without an entry on the page; of a page of both polarities those of high
// values. Each has a number like that of an entry: the object of rank r without an entry has the number entries.length + r.
import { voxelWord } from "../../shared/names";
import { entryOf, isLowOfBoth, type Branch, type Entry, type Page } from "../../shared/page";
import { CHOICE, isChosen, type Choice, type Sizes } from "../state/selection";
import type { State } from "../state/state";

/** docs/schema/server-branches.schema.json: the objects of highest rank, one array for each member. */
export interface BranchList {
  /** the store, as an argument of a command line */
  source: string;
  /** objects of the volume */
  all: number;
  /** in the table of objects, 0: not there */
  number?: number[];
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
  significant: boolean[];
}

/** Limit of the server. */
export const MAX_LISTED = 20_000;

/** Number of valid entry numbers in an address. */
export function numbersOf(page: Page): number {
  return page.entries.length + Math.min(page.found.objects.all, MAX_LISTED);
}

const [EMPTY, FLAGS]: [number[], boolean[]] = [[], []];
const NONE: BranchList = {
  ...{ source: "", all: 0, id: EMPTY, voxel: EMPTY, tau: EMPTY, low: EMPTY, high: EMPTY, tunnels: EMPTY, cavities: EMPTY },
  ...{ appears: EMPTY, merges: EMPTY, parent: EMPTY, persistence: EMPTY, hypervolume: EMPTY },
  ...{ voxels: EMPTY, measure: EMPTY, significant: FLAGS },
};

/** Does a state refer to objects that are not on the page? */
export function needsAll(page: Page, state: State): boolean {
  return CHOICE.of(state) !== null || state.shown.some(({ entry }) => entry >= page.entries.length);
}

export class Catalogue {
  /** per rank; empty: not loaded */
  sizes: Sizes[] = [];
  private listed = NONE;
  /** per rank: the position in page.branches */
  private positionOfRank: number[] = [];
  private readonly entriesOfPosition = new Map<number, number[]>();
  private readonly further = new Map<number, Entry>();

  constructor(private readonly page: Page) {
    page.entries.forEach((entry, i) => this.entriesOfPosition.set(entry.branch, [...(this.entriesOfPosition.get(entry.branch) ?? []), i]));
    page.further = (i) => this.furtherEntry(i);
  }

  /** Adds the listed branches to the page, and entries for them. */
  load(listed: BranchList): void {
    const { unit } = this.page.volume;
    this.listed = listed;
    this.sizes = listed.id.map((_, rank) => ({
      rank,
      contrast: listed.persistence[rank] ?? 0,
      size: (unit === null ? listed.voxels : listed.measure)[rank] ?? 0,
      significant: listed.significant[rank] ?? false,
    }));
    this.completeBranches();
  }

  get isLoaded(): boolean {
    return this.listed !== NONE;
  }
  /** objects of the volume */
  get all(): number {
    return this.page.found.objects.all;
  }
  /** of both polarities, where the page has both */
  get total(): number {
    return this.all + (this.page.low?.found.all ?? 0);
  }
  get source(): string {
    return this.listed.source;
  }

  /** Numbers of the objects that a choice keeps, by rank; an object may have several entries. */
  chosen(choice: Choice | null): number[] {
    if (choice === null) return this.page.entries.flatMap((entry, i) => (this.page.branches[entry.branch]?.side === "object" ? [i] : []));
    return this.sizes.filter((sizes) => isChosen(choice, sizes)).flatMap(({ rank }) => this.numbersOfRank(rank));
  }

  /** Number of different objects. */
  objectsOf(numbers: number[]): number {
    return new Set(numbers.map((i) => entryOf(this.page, i).branch)).size;
  }

  numbersOfRank(rank: number): number[] {
    return this.entriesOfPosition.get(this.positionOfRank[rank] ?? -1) ?? [this.page.entries.length + rank];
  }

  /** Entry number of a position in page.branches; undefined: not loaded. */
  numberOfBranch(branch: number): number | undefined {
    const [own] = this.entriesOfPosition.get(branch) ?? [];
    const { side, rank } = this.page.branches[branch] ?? {};
    const isListed = side === "object" && this.isListed(this.page.branches[branch] as Branch);
    return own !== undefined || !isListed || rank === undefined || !this.isLoaded ? own : this.numbersOfRank(rank)[0];
  }

  /** Does the server list it? Of a page of both those of high values; of low values there are those of the page. */
  private isListed(branch: Branch): boolean {
    return branch.side === "object" && !isLowOfBoth(this.page, branch);
  }

  private completeBranches(): void {
    const { branches } = this.page;
    branches.forEach((branch, b) => this.isListed(branch) && (this.positionOfRank[branch.rank] = b));
    this.listed.id.forEach((_, rank) => (this.positionOfRank[rank] ??= branches.push(this.branchOfRank(rank)) - 1));
    this.listed.parent.forEach((parent, rank) => {
      const [own, other] = [branches[this.positionOfRank[rank] ?? -1], this.positionOfRank[parent]];
      if (own) own.parent = other ?? -1; // a branch merges into one of higher rank, which is listed too
    });
  }

  private branchOfRank(rank: number): Branch {
    const { listed } = this;
    return {
      side: "object",
      ...(this.page.polarity === "both" ? { polarity: "high" as const } : {}),
      id: listed.id[rank] ?? -1,
      number: listed.number?.[rank] ?? null,
      rank,
      appears: listed.appears[rank] ?? 0,
      merges: listed.merges[rank] ?? null,
      parent: -1,
      hypervolume: listed.hypervolume[rank] ?? 0,
      voxels: listed.voxels[rank] ?? 0,
      measure: listed.measure[rank] ?? 0,
      joined: 0,
      significant: listed.significant[rank] ?? false,
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
    const what = `${listed.source} --object ${listed.number?.[rank] || voxelWord(id)}@${tau}`;
    const name = listed.number?.[rank] || rank + 1;
    return {
      branch: this.positionOfRank[rank] ?? 0,
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
      why: "just before merging, where it is largest",
      colour: COLOURS[rank % COLOURS.length] ?? "#999999",
      picture: null,
      commands: [
        { name: "surface", line: `isoatlas extract ${what} -o object-${name}.ply` },
        { name: "picture", line: `isoatlas render ${what} -o object-${name}.png` },
      ],
    };
  }
}

/** palette() of src/render/colours.cpp */
const COLOURS = ["#e6d8ba", "#56b4e9", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#0072b2"];
