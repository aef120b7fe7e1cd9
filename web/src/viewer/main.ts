// The viewer: a list of objects, a picture of those shown, and the isovalue of the one selected.
import { html } from "../dom";
import { Api, isOvertaken, type Atlas } from "./api";
import { AxisPanel } from "./axis_panel";
import { COLOURS } from "./colours";
import { keys } from "./keys";
import { ListPanel } from "./list_panel";
import { Stage } from "./stage";
import { add, change, fromHash, History, isolate, NOTHING, remove, toHash, type Shown, type State } from "./state";
import "./viewer.css";

const WHOLE = 100_000_000;
const COARSE = 20_000;

class Viewer {
  private readonly history: History;
  private readonly stage = new Stage();
  private readonly axis: AxisPanel;
  private readonly list: ListPanel;
  private readonly said = html("p", { class: "said", role: "status" });
  /** per entry: what the picture shows of it */
  private readonly drawn = new Map<number, { tau: number; coarse: boolean }>();
  private fitted = false;

  constructor(
    private readonly api: Api,
    private readonly atlas: Atlas,
    main: HTMLElement,
  ) {
    const asked = fromHash(location.hash, atlas.objects.length);
    this.history = new History(asked ?? NOTHING);
    this.axis = new AxisPanel(atlas, (tau, transient) => this.move(tau, transient));
    this.list = new ListPanel(
      atlas,
      (entry) => this.go(isolate(this.now, entry, this.best(entry))),
      (entry) => this.toggle(entry),
    );
    main.append(this.list.element, html("div", { class: "stage" }, this.stage.canvas, this.said), this.axis.element);
    this.history.listen((state, before) => this.show(state, before));
    keys(this.stage, {
      step: (by) => this.stepBy(by),
      undo: () => this.history.undo(),
      redo: () => this.history.redo(),
      fit: () => this.stage.fit(),
    });
    if (asked) this.show(asked, NOTHING);
    else if (atlas.objects.length > 0) this.go(isolate(NOTHING, 0, this.best(0)));
    else this.said.textContent = "There is nothing to show: noise explains all there is.";
  }

  private get now(): State {
    return this.history.now;
  }

  private best(entry: number): number {
    return this.atlas.objects[entry]?.best ?? this.atlas.low;
  }

  private go(state: State, transient = false): void {
    this.history.go(state, transient);
  }

  private toggle(entry: number): void {
    const at = this.now.shown.findIndex((shown) => shown.entry === entry);
    this.go(at >= 0 ? remove(this.now, at) : add(this.now, entry, this.best(entry)));
  }

  private move(tau: number, transient: boolean): void {
    if (this.now.selected >= 0) this.go(change(this.now, this.now.selected, { tau }), transient);
  }

  private stepBy(share: number): void {
    const selected = this.now.shown[this.now.selected];
    if (!selected) return;
    const tau = selected.tau + share * (this.atlas.high - this.atlas.low);
    this.move(Math.min(Math.max(tau, this.atlas.low), this.atlas.high), false);
  }

  private show(state: State, before: State): void {
    history.replaceState(null, "", toHash(state));
    this.list.show(state);
    const selected = state.shown[state.selected];
    const entry = selected && this.atlas.objects[selected.entry];
    if (selected) this.axis.show(selected.tau, entry?.merges ?? this.atlas.low, entry?.appears ?? this.atlas.high);
    if (selected) void this.foresee(selected.tau);
    for (const old of before.shown) if (!state.shown.some((shown) => shown.entry === old.entry)) this.forget(old.entry);
    for (const shown of state.shown) void this.draw(shown);
  }

  private forget(entry: number): void {
    this.api.leave(`surface ${entry}`);
    this.drawn.delete(entry);
    this.stage.remove(entry);
  }

  private async foresee(tau: number): Promise<void> {
    try {
      this.axis.tell(await this.api.preview(tau));
    } catch (error) {
      this.fail(error);
    }
  }

  /** A coarse surface first where the whole one takes longer. */
  private async draw(shown: Shown): Promise<void> {
    const { entry, tau, opacity } = shown;
    const before = this.drawn.get(entry);
    if (before?.tau === tau) return this.stage.fade(entry, opacity);
    this.drawn.set(entry, { tau, coarse: true });
    const object = this.atlas.objects[entry]?.id ?? null;
    try {
      for (const most of [COARSE, WHOLE]) {
        const mesh = await this.api.surface(`surface ${entry}`, tau, object, most);
        if (this.drawn.get(entry)?.tau !== tau) return;
        this.stage.put(entry, mesh, COLOURS[entry % COLOURS.length] ?? "#999999", opacity);
        if (!this.fitted) this.stage.fit();
        this.fitted = true;
        this.said.textContent = mesh.coarse ? "coarse preview" : "";
        if (!mesh.coarse) break;
      }
    } catch (error) {
      this.drawn.delete(entry);
      if (!isOvertaken(error)) this.stage.remove(entry);
      this.fail(error);
    }
  }

  private fail(error: unknown): void {
    if (!isOvertaken(error)) this.said.textContent = error instanceof Error ? error.message : String(error);
  }
}

async function start(main: HTMLElement): Promise<void> {
  const token = new URLSearchParams(location.search).get("token") ?? "";
  const api = new Api(token);
  try {
    const atlas = await api.atlas();
    document.title = `${atlas.name} – isoatlas`;
    if (atlas.size.length !== 3) throw new Error("The viewer shows volumes; isoatlas atlas makes a page of an image.");
    new Viewer(api, atlas, main);
  } catch (error) {
    main.append(html("p", { role: "alert" }, error instanceof Error ? error.message : String(error)));
  }
}

const main = document.getElementById("viewer");
if (main) void start(main);
