// Edits the scene; each edit is one step of the history.
import type { Page } from "../../shared/page";
import type { History } from "../state/history";
import { bestOf, branchOfShown, within } from "../api/entries";
import { GHOSTS } from "../state/ghosts";
import { POINTS } from "../state/points";
import { closedAgain, seenThrough } from "../state/see_through";
import { add, change, changeAll, isolate, remove, select, type Shown, type State } from "../state/state";

export class Editor {
  constructor(
    private readonly page: Page,
    private readonly history: History,
  ) {}

  get selected(): Shown | undefined {
    return this.now.shown[this.now.selected];
  }

  /** Shows only this object, fitted to the view. tau: if omitted, its previous isovalue, or the best recommended one. */
  isolate(entry: number, tau?: number): void {
    const isolated = isolate(this.now, entry, bestOf(this.page, entry));
    this.history.go({ ...(tau === undefined ? isolated : change(isolated, 0, { tau })), view: null });
  }

  /** Initial selection, not undoable. */
  init(entry: number): void {
    this.history.amend(isolate(this.now, entry, bestOf(this.page, entry)));
  }

  add(entry: number, tau = bestOf(this.page, entry)): void {
    this.history.go(seenThrough(this.page, add(this.now, entry, tau), entry));
  }

  toggle(entry: number): void {
    const at = this.now.shown.findIndex((shown) => shown.entry === entry);
    if (at >= 0) this.remove(at);
    else this.add(entry);
  }

  remove(at = this.now.selected): void {
    const shown = this.now.shown[at];
    if (shown) this.history.go(closedAgain(this.page, remove(this.now, at), shown.entry));
  }

  select(at: number): void {
    if (this.now.shown[at]) this.history.go(select(this.now, at));
  }

  /** Selects the next or previous object, cyclically. */
  step(by: number): void {
    const n = this.now.shown.length;
    if (n > 0) this.select((this.now.selected + by + n) % n);
  }

  change(what: Partial<Shown>, transient = false, at = this.now.selected): void {
    if (this.now.shown[at]) this.history.go(change(this.now, at, what), transient);
  }

  /** Sets the isovalue of the selected object. */
  setIsovalue(tau: number, transient = false): void {
    this.change({ tau: within(this.page, tau) }, transient);
  }

  /** Sets the isovalues of all objects to that of the selected one. */
  setAllIsovalues(): void {
    if (this.selected) this.history.go(changeAll(this.now, { tau: this.selected.tau }));
  }

  toggleVisible(at = this.now.selected): void {
    const shown = this.now.shown[at];
    if (shown) this.change({ visible: !shown.visible }, false, at);
  }

  /** Only objects have cavities, not cavities themselves nor the whole isosurface. */
  get hasCavities(): boolean {
    return this.selected !== undefined && branchOfShown(this.page, this.selected.entry)?.side === "object";
  }
  toggleCavitiesOnly(): void {
    if (this.selected && this.hasCavities) this.change({ walls: this.selected.walls === "all" ? "cavities" : "all" });
  }

  get ghosts(): boolean {
    return GHOSTS.of(this.now);
  }
  toggleGhosts(): void {
    this.history.go(GHOSTS.with(this.now, !this.ghosts));
  }

  get points(): boolean {
    return POINTS.of(this.now);
  }
  togglePoints(): void {
    this.history.go(POINTS.with(this.now, !this.points));
  }

  private get now(): State {
    return this.history.now;
  }
}
