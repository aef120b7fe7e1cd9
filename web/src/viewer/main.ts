// The viewer: what is to be seen (state.ts), a picture of it (scene.ts, stage.ts), and what a reader can do (actions.ts).
import { html } from "../dom";
import { overview } from "../overview";
import type { Page } from "../page";
import { Actions } from "./actions";
import { fromHash, toHash } from "./address";
import { Api, isOvertaken } from "./api";
import { AxisPanel } from "./axis_panel";
import { keep, selectedOf, type Desk } from "./desk";
import { History } from "./history";
import { ListPanel } from "./list_panel";
import { look } from "./look";
import { help, menus } from "./menus";
import { ObjectPanel } from "./object_panel";
import { Scene } from "./scene";
import { bestOf, eventsOf, ownRange, titleOf, whichOf } from "./shown";
import { Stage } from "./stage";
import { add, change, isolate, nextEvent, NOTHING, remove, type Shown, type State } from "./state";
import "./viewer.css";

/** of the range, for one step of a key */
const STEP = 0.005;
/** a press that moves less is a click */
const CLICK_PIXELS = 4;

class Viewer implements Desk {
  readonly history: History;
  readonly stage = new Stage(() => this.go({ ...this.now, view: this.stage.eye.view }, true));
  readonly actions = new Actions();
  readonly overlay = html("div", { class: "stage" });
  private readonly said = html("p", { class: "said", role: "status" });
  private readonly scene = new Scene(this);
  private readonly axis: AxisPanel;
  private readonly list: ListPanel;
  private readonly panel: ObjectPanel;
  private readonly tree = html("dialog", { class: "tree", "aria-label": "all objects over the isovalue" });

  constructor(
    readonly api: Api,
    readonly page: Page,
    main: HTMLElement,
  ) {
    const asked = fromHash(location.hash, page.entries.length);
    this.history = new History(asked ?? NOTHING);
    this.axis = new AxisPanel(page, (tau, transient) => this.move(tau, transient));
    this.list = new ListPanel(
      page,
      (entry) => this.isolate(entry),
      (entry) => this.toggle(entry),
    );
    this.panel = new ObjectPanel(page, {
      fade: (opacity, transient) => this.go(change(this.now, this.now.selected, { opacity }), transient),
      hide: () => this.hide(),
      save: (format) => void this.save(format),
      picture: () => void this.stage.picture().then((blob) => blob && keep(blob, "picture.png")),
      link: () => void navigator.clipboard.writeText(location.href).then(() => this.say("the link is in the clipboard")),
    });
    this.addActions();
    look(this);
    const side = html("div", { class: "side" }, this.list.element, this.panel.element);
    this.overlay.append(this.stage.canvas, menus(this.actions), this.said);
    main.append(side, this.overlay, this.axis.element, help(this.actions), this.tree);
    this.growTree();
    this.history.listen((state, before) => this.show(state, before));
    this.actions.listen(document);
    this.listenToClicks();
    if (asked) this.show(asked, NOTHING);
    else if (page.entries.length > 0) this.isolate(0);
    else this.say("There is nothing to show: noise explains all there is.");
  }

  say(text: string): void {
    this.said.textContent = text;
  }

  fail(error: unknown): void {
    if (!isOvertaken(error)) this.say(error instanceof Error ? error.message : String(error));
  }

  private get now(): State {
    return this.history.now;
  }

  private get selected(): Shown | undefined {
    return selectedOf(this.now);
  }

  private go(state: State, transient = false): void {
    this.history.go(state, transient);
  }

  private isolate(entry: number): void {
    this.go(isolate(this.now, entry, bestOf(this.page, entry)));
  }

  private toggle(entry: number): void {
    const at = this.now.shown.findIndex((shown) => shown.entry === entry);
    this.go(at >= 0 ? remove(this.now, at) : add(this.now, entry, bestOf(this.page, entry)));
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
      this.isolate(entry);
    };
    const drawing = overview(this.page, new Set(this.page.entries.map((entry) => entry.branch)), choose);
    this.tree.append(html("h2", {}, "Objects over the isovalue"), drawing, html("button", { type: "button", click: () => this.tree.close() }, "Close"));
  }

  private addActions(): void {
    const events = eventsOf(this.page);
    const range = this.page.axis.high - this.page.axis.low;
    const step = (by: number) => (): void => this.selected && this.move(this.selected.tau + by * range);
    const toEvent = (up: boolean) => (): void => {
      const tau = this.selected && nextEvent(events, this.selected.tau, up);
      if (typeof tau === "number") this.move(tau);
    };
    this.actions.add(
      { group: "Isovalue", name: "down", keys: ["["], run: step(-STEP) },
      { group: "Isovalue", name: "up", keys: ["]"], run: step(STEP) },
      { group: "Isovalue", name: "to where the next object that matters ends", keys: ["{"], run: toEvent(false) },
      { group: "Isovalue", name: "to where the next object that matters begins", keys: ["}"], run: toEvent(true) },
      { group: "Scene", name: "undo", keys: ["Ctrl+z"], run: () => this.history.undo() },
      { group: "Scene", name: "redo", keys: ["Ctrl+Shift+z", "Ctrl+y"], run: () => this.history.redo() },
      { group: "Scene", name: "hide what is selected", keys: ["Delete"], run: () => this.hide() },
      { group: "Scene", name: "all objects over the isovalue: choose one", keys: ["t"], run: () => this.tree.showModal() },
    );
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
    this.scene.show(state, before);
    if (state.view && state.view !== before.view && String(state.view) !== String(this.stage.eye.view)) this.stage.eye.view = state.view;
  }

  private async foresee(tau: number): Promise<void> {
    try {
      this.axis.tell(await this.api.preview(tau));
    } catch (error) {
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
