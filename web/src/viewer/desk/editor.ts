// What a reader does to the scene, each as one step of history.
import type { Page } from "../../page";
import type { History } from "../state/history";
import { bestOf, branchOfShown, within } from "../ask/shown";
import { GHOSTS } from "./scene";
import { add, change, changeAll, isolate, remove, select, type Shown, type State } from "../state/state";

export class Editor {
  constructor(
    private readonly page: Page,
    private readonly history: History,
  ) {}

  get selected(): Shown | undefined {
    return this.now.shown[this.now.selected];
  }

  /** This alone, in the middle. tau: left out, what it had, or the one that shows it best. */
  isolate(entry: number, tau?: number): void {
    const alone = isolate(this.now, entry, bestOf(this.page, entry));
    this.history.go({ ...(tau === undefined ? alone : change(alone, 0, { tau })), view: null });
  }

  /** This alone, and nothing was before. */
  begin(entry: number): void {
    this.history.amend(isolate(this.now, entry, bestOf(this.page, entry)));
  }

  add(entry: number, tau = bestOf(this.page, entry)): void {
    this.history.go(add(this.now, entry, tau));
  }

  toggle(entry: number): void {
    const at = this.now.shown.findIndex((shown) => shown.entry === entry);
    if (at >= 0) this.remove(at);
    else this.add(entry);
  }

  remove(at = this.now.selected): void {
    if (this.now.shown[at]) this.history.go(remove(this.now, at));
  }

  select(at: number): void {
    if (this.now.shown[at]) this.history.go(select(this.now, at));
  }

  /** The next or the one before, round and round. */
  step(by: number): void {
    const n = this.now.shown.length;
    if (n > 0) this.select((this.now.selected + by + n) % n);
  }

  change(what: Partial<Shown>, transient = false, at = this.now.selected): void {
    if (this.now.shown[at]) this.history.go(change(this.now, at, what), transient);
  }

  /** The isovalue of what is selected. */
  move(tau: number, transient = false): void {
    this.change({ tau: within(this.page, tau) }, transient);
  }

  /** All to the isovalue of what is selected. */
  level(): void {
    if (this.selected) this.history.go(changeAll(this.now, { tau: this.selected.tau }));
  }

  show(at = this.now.selected): void {
    const shown = this.now.shown[at];
    if (shown) this.change({ visible: !shown.visible }, false, at);
  }

  /** Only an object has cavities of its own: neither a dark one nor all there is. */
  get hasCavities(): boolean {
    return this.selected !== undefined && branchOfShown(this.page, this.selected.entry)?.side === "bright";
  }
  wall(): void {
    if (this.selected && this.hasCavities) this.change({ walls: this.selected.walls === "all" ? "cavities" : "all" });
  }

  get ghosts(): boolean {
    return GHOSTS.of(this.now);
  }
  ghost(): void {
    this.history.go(GHOSTS.in(this.now, !this.ghosts));
  }

  private get now(): State {
    return this.history.now;
  }
}
