// The viewer: a list of objects, a picture of those shown, and the isovalue of the one selected.
import { html } from "../dom";
import { overview } from "../overview";
import type { Page } from "../page";
import { Api, isOvertaken } from "./api";
import { AxisPanel } from "./axis_panel";
import { help } from "./help";
import { keys } from "./keys";
import { ListPanel } from "./list_panel";
import { ObjectPanel } from "./object_panel";
import { ScaleBar } from "./scale_bar";
import { bestOf, colourOf, eventsOf, ownRange, titleOf, whichOf } from "./shown";
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
  private readonly tree = html("dialog", { class: "tree", "aria-label": "all objects over the isovalue" });
  private framed = false;
  private readonly cut = html("input", { class: "cut", type: "range", min: 0, max: 1, step: 0.01, hidden: true, "aria-label": "where it is cut open" });

  constructor(
    private readonly api: Api,
    private readonly page: Page,
    main: HTMLElement,
  ) {
    const asked = fromHash(location.hash, page.entries.length);
    this.history = new History(asked ?? NOTHING);
    this.axis = new AxisPanel(page, (tau, transient) => this.move(tau, transient));
    this.list = new ListPanel(
      page,
      (entry) => this.go(isolate(this.now, entry, this.best(entry))),
      (entry) => this.toggle(entry),
    );
    this.panel = new ObjectPanel(page, {
      fade: (opacity, transient) => this.go(change(this.now, this.now.selected, { opacity }), transient),
      hide: () => this.hide(),
      save: (format) => void this.save(format),
      picture: () => void this.stage.picture().then((blob) => blob && keep(blob, "picture.png")),
      link: () => void navigator.clipboard.writeText(location.href).then(() => this.say("the link is in the clipboard")),
    });
    const side = html("div", { class: "side" }, this.list.element, this.panel.element);
    const bar = new ScaleBar(page.volume.unit);
    this.stage.onDraw(() => bar.show(this.stage.eye.height, this.stage.canvas.clientHeight));
    this.cut.addEventListener("input", () => this.stage.slide(Number(this.cut.value)));
    main.append(side, html("div", { class: "stage" }, this.stage.canvas, this.said, bar.element, this.cut), this.axis.element, this.help, this.tree);
    this.growTree();
    this.history.listen((state, before) => this.show(state, before));
    this.listenToKeys();
    this.listenToClicks();
    if (asked) this.show(asked, NOTHING);
    else if (page.entries.length > 0) this.go(isolate(NOTHING, 0, this.best(0)));
    else this.say("There is nothing to show: noise explains all there is.");
  }

  private get now(): State {
    return this.history.now;
  }

  private get selected(): Shown | undefined {
    return this.now.shown[this.now.selected];
  }

  private best(entry: number): number {
    return bestOf(this.page, entry);
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
    const inside = Math.min(Math.max(tau, this.page.axis.low), this.page.axis.high);
    if (this.selected) this.go(change(this.now, this.now.selected, { tau: inside }), transient);
  }

  /** The objects over the isovalue, as on the page; what is chosen there is isolated. */
  private growTree(): void {
    const choose = (entry: number): void => {
      this.tree.close();
      this.go(isolate(this.now, entry, this.best(entry)));
    };
    const drawing = overview(this.page, new Set(this.page.entries.map((entry) => entry.branch)), choose);
    this.tree.append(html("h2", {}, "Objects over the isovalue"), drawing, html("button", { type: "button", click: () => this.tree.close() }, "Close"));
  }

  private listenToKeys(): void {
    const events = eventsOf(this.page);
    keys(this.stage, {
      step: (by) => this.selected && this.move(this.selected.tau + by * (this.page.axis.high - this.page.axis.low)),
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
      tree: () => this.tree.showModal(),
      box: () => {
        this.framed = !this.framed;
        this.stage.frame(this.framed ? cornersOf(this.page) : null);
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
      this.axis.show(this.selected.tau, ownRange(this.page, this.selected.entry));
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
        const mesh = await this.api.surface(`surface ${entry}`, tau, whichOf(this.page, entry), most);
        if (this.drawn.get(entry) !== tau) return;
        this.stage.put(entry, mesh, colourOf(this.page, entry), opacity, tau);
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
      keep(await this.api.file(shown.tau, whichOf(this.page, shown.entry), format), `${titleOf(this.page, shown.entry).toLowerCase().replaceAll(" ", "-")}.${format}`);
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
function cornersOf({ volume }: Page): [number, number, number][] {
  return [0, 1, 2, 3, 4, 5, 6, 7].map((corner) => {
    const steps = [0, 1, 2].map((axis) => (corner & (1 << axis) ? (volume.size[axis] ?? 1) - 1 : 0) * (volume.spacing?.[axis] ?? 1));
    const at = (row: number): number => (volume.origin[row] ?? 0) + steps.reduce((sum, step, axis) => sum + (volume.direction[row]?.[axis] ?? 0) * step, 0);
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
    const page = await api.page();
    document.title = `${page.volume.name} – isoatlas`;
    if (page.volume.size.length !== 3) throw new Error("The viewer shows volumes; isoatlas atlas makes a page of an image.");
    new Viewer(api, page, main);
  } catch (error) {
    main.append(html("p", { role: "alert" }, error instanceof Error ? error.message : String(error)));
  }
}

const main = document.getElementById("viewer");
if (main) void start(main);
