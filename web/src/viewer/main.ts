// The viewer: a list of objects, a picture of those shown, and the isovalue of the one selected.
import { html } from "../dom";
import { Api, isOvertaken, type Atlas } from "./api";
import { AxisPanel, eventsOf } from "./axis_panel";
import { colourOf } from "./colours";
import { help } from "./help";
import { keys } from "./keys";
import { ListPanel } from "./list_panel";
import { ObjectPanel } from "./object_panel";
import { ScaleBar } from "./scale_bar";
import { Stage } from "./stage";
import { add, change, fromHash, History, isolate, nextEvent, NOTHING, remove, toHash, type Shown, type State } from "./state";
import "./viewer.css";

const WHOLE = 100_000_000;
const COARSE = 20_000;
/** a press that moves less is a click */
const CLICK_PIXELS = 4;

class Viewer {
  private readonly history: History;
  private readonly stage = new Stage(() => this.go({ ...this.now, view: this.stage.eye.view }, true));
  private readonly axis: AxisPanel;
  private readonly list: ListPanel;
  private readonly panel: ObjectPanel;
  private readonly said = html("p", { class: "said", role: "status" });
  /** per entry: the isovalue of what the picture shows of it, or soon will */
  private readonly drawn = new Map<number, number>();
  private readonly help = help();
  private framed = false;
  private readonly cut = html("input", { class: "cut", type: "range", min: 0, max: 1, step: 0.01, hidden: true, "aria-label": "where it is cut open" });

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
    this.panel = new ObjectPanel(atlas, atlas.name, {
      fade: (opacity, transient) => this.go(change(this.now, this.now.selected, { opacity }), transient),
      hide: () => this.hide(),
      save: (format) => void this.save(format),
      picture: () => void this.stage.picture().then((blob) => blob && keep(blob, "picture.png")),
      link: () => void navigator.clipboard.writeText(location.href).then(() => this.say("the link is in the clipboard")),
    });
    const side = html("div", { class: "side" }, this.list.element, this.panel.element);
    const bar = new ScaleBar(atlas.unit);
    this.stage.onDraw(() => bar.show(this.stage.eye.height, this.stage.canvas.clientHeight));
    this.cut.addEventListener("input", () => this.stage.slide(Number(this.cut.value)));
    main.append(side, html("div", { class: "stage" }, this.stage.canvas, this.said, bar.element, this.cut), this.axis.element, this.help);
    this.history.listen((state, before) => this.show(state, before));
    this.listenToKeys();
    this.listenToClicks();
    if (asked) this.show(asked, NOTHING);
    else if (atlas.objects.length > 0) this.go(isolate(NOTHING, 0, this.best(0)));
    else this.say("There is nothing to show: noise explains all there is.");
  }

  private get now(): State {
    return this.history.now;
  }

  private get selected(): Shown | undefined {
    return this.now.shown[this.now.selected];
  }

  private best(entry: number): number {
    return this.atlas.objects[entry]?.best ?? (this.atlas.low + this.atlas.high) / 2;
  }

  private go(state: State, transient = false): void {
    this.history.go(state, transient);
  }

  private say(text: string): void {
    this.said.textContent = text;
  }

  private toggle(entry: number): void {
    const at = this.now.shown.findIndex((shown) => shown.entry === entry);
    this.go(at >= 0 ? remove(this.now, at) : add(this.now, entry, this.best(entry)));
  }

  private hide(): void {
    if (this.selected) this.go(remove(this.now, this.now.selected));
  }

  private move(tau: number, transient = false): void {
    const inside = Math.min(Math.max(tau, this.atlas.low), this.atlas.high);
    if (this.selected) this.go(change(this.now, this.now.selected, { tau: inside }), transient);
  }

  private listenToKeys(): void {
    const events = eventsOf(this.atlas);
    keys(this.stage, {
      step: (by) => this.selected && this.move(this.selected.tau + by * (this.atlas.high - this.atlas.low)),
      event: (up) => {
        const tau = this.selected && nextEvent(events, this.selected.tau, up);
        if (typeof tau === "number") this.move(tau);
      },
      undo: () => this.history.undo(),
      redo: () => this.history.redo(),
      fit: () => this.stage.fit(),
      hide: () => this.hide(),
      help: () => this.help.showModal(),
      cut: () => {
        this.stage.open(!this.stage.isOpen);
        this.cut.hidden = !this.stage.isOpen;
        this.cut.value = "0.5";
      },
      box: () => {
        this.framed = !this.framed;
        this.stage.frame(this.framed ? cornersOf(this.atlas) : null);
      },
    });
  }

  private listenToClicks(): void {
    let pressed = { x: 0, y: 0 };
    const { canvas } = this.stage;
    canvas.addEventListener("pointerdown", (event) => (pressed = { x: event.clientX, y: event.clientY }));
    canvas.addEventListener("click", (event) => {
      if (Math.hypot(event.clientX - pressed.x, event.clientY - pressed.y) > CLICK_PIXELS) return;
      const frame = canvas.getBoundingClientRect();
      const entry = this.stage.pick(event.clientX - frame.left, event.clientY - frame.top);
      const at = this.now.shown.findIndex((shown) => shown.entry === entry);
      if (at >= 0) this.go({ ...this.now, selected: at });
    });
  }

  private show(state: State, before: State): void {
    history.replaceState(null, "", toHash(state));
    this.list.show(state);
    this.panel.show(this.selected);
    if (this.selected) {
      const entry = this.atlas.objects[this.selected.entry];
      this.axis.show(this.selected.tau, entry?.merges ?? this.atlas.low, entry?.appears ?? this.atlas.high);
      void this.foresee(this.selected.tau);
    }
    for (const old of before.shown) if (!state.shown.some((shown) => shown.entry === old.entry)) this.forget(old.entry);
    for (const shown of state.shown) void this.draw(shown);
    if (state.view && state.view !== before.view && String(state.view) !== String(this.stage.eye.view)) this.stage.eye.view = state.view;
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
    if (this.drawn.get(entry) === tau) return this.stage.fade(entry, opacity);
    const first = this.drawn.size === 0 && this.now.view === null;
    this.drawn.set(entry, tau);
    try {
      for (const most of [COARSE, WHOLE]) {
        const mesh = await this.api.surface(`surface ${entry}`, tau, this.atlas.objects[entry]?.id ?? null, most);
        if (this.drawn.get(entry) !== tau) return;
        this.stage.put(entry, mesh, colourOf(entry), opacity, tau);
        if (first && most === COARSE) this.stage.fit();
        this.say(mesh.coarse ? "coarse preview" : "");
        if (!mesh.coarse) break;
      }
    } catch (error) {
      if (isOvertaken(error)) return;
      this.drawn.delete(entry);
      this.stage.remove(entry);
      this.fail(error);
    }
  }

  private async save(format: string): Promise<void> {
    const shown = this.selected;
    if (!shown) return;
    try {
      this.say("the surface is being written");
      keep(await this.api.file(shown.tau, this.atlas.objects[shown.entry]?.id ?? null, format), `object-${shown.entry + 1}.${format}`);
      this.say("");
    } catch (error) {
      this.fail(error);
    }
  }

  private fail(error: unknown): void {
    if (!isOvertaken(error)) this.say(error instanceof Error ? error.message : String(error));
  }
}

/** Of the box of samples, physical; bit a of a corner's number: the far end of axis a. */
function cornersOf(atlas: Atlas): [number, number, number][] {
  return [0, 1, 2, 3, 4, 5, 6, 7].map((corner) => {
    const steps = [0, 1, 2].map((axis) => (corner & (1 << axis) ? (atlas.size[axis] ?? 1) - 1 : 0) * (atlas.spacing[axis] ?? 1));
    const at = (row: number): number => (atlas.origin[row] ?? 0) + steps.reduce((sum, step, axis) => sum + (atlas.direction[row]?.[axis] ?? 0) * step, 0);
    return [at(0), at(1), at(2)];
  });
}

/** Gives the reader a file. */
function keep(blob: Blob, name: string): void {
  const address = URL.createObjectURL(blob);
  html("a", { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}

async function start(main: HTMLElement): Promise<void> {
  const api = new Api(new URLSearchParams(location.search).get("token") ?? "");
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
