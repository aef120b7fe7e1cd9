// The viewer: what is to be seen (state.ts), a picture of it (scene.ts, stage.ts), and what a reader can do (actions.ts).
import { html } from "../dom";
import type { Page } from "../page";
import { Actions } from "./desk/actions";
import { fromHash, toHash } from "./state/address";
import { Api, isOvertaken } from "./ask/api";
import { AxisPanel } from "./evolve/axis_panel";
import { brackets } from "./look/brackets";
import { Catalogue, MOST_LISTED, needsAll, numbersOf } from "./ask/catalogue";
import { ChoosePanel } from "./choose/choose_panel";
import { onClick, placeOn } from "./desk/clicks";
import type { Desk } from "./desk/desk";
import { Editor } from "./desk/editor";
import { History } from "./state/history";
import { looking } from "./look/looking";
import { help, menus } from "./menus";
import { ObjectPanel } from "./inspect/object_panel";
import { SaveDialog } from "./save/save_dialog";
import { Scene } from "./desk/scene";
import { sceneActions } from "./inspect/scene_actions";
import { ScenePanel } from "./inspect/scene_panel";
import { Stage } from "./draw/stage";
import { NOTHING, type State } from "./state/state";
import { stepping } from "./evolve/stepping";
import { theme } from "./desk/theme";
import { Tour } from "./tour";
import { pageWhenThere } from "./waiting";
import "./viewer.css";
import "./inspect/scene.css";

class Viewer implements Desk {
  readonly history: History;
  readonly stage = new Stage(() => this.history.go({ ...this.history.now, view: this.stage.eye.view }));
  readonly actions = new Actions();
  readonly overlay = html("div", { class: "stage" });
  readonly editor: Editor;
  readonly scene: Scene;
  private readonly said = html("p", { class: "said", role: "status" });
  private readonly axis: AxisPanel;
  private readonly choosing: ChoosePanel;
  private readonly shown: ScenePanel;
  private readonly panel: ObjectPanel;

  constructor(
    readonly api: Api,
    readonly page: Page,
    readonly catalogue: Catalogue,
    asked: State | null,
    main: HTMLElement,
  ) {
    this.history = new History(asked ?? NOTHING);
    this.editor = new Editor(page, this.history);
    this.scene = new Scene(this);
    this.choosing = new ChoosePanel(this);
    stepping(this);
    this.axis = new AxisPanel(this);
    sceneActions(this);
    this.shown = new ScenePanel(this);
    this.panel = new ObjectPanel(this);
    looking(this);
    brackets(this);
    theme(this);
    const tour = new Tour(this);
    const side = html("div", { class: "side" }, this.choosing.element);
    const inspector = html("div", { class: "inspector" }, this.shown.element, this.panel.element);
    this.overlay.prepend(this.stage.canvas, menus(this.actions));
    this.overlay.append(this.said, tour.element);
    main.append(side, this.overlay, inspector, this.axis.element, new SaveDialog(this).element, help(this.actions));
    this.history.listen((state, before, dragging) => this.show(state, before, dragging));
    this.actions.listen(document);
    this.listenToClicks();
    if (asked) this.show(asked, NOTHING, false);
    else if (page.entries.length > 0) this.editor.begin(0);
    else {
      this.show(NOTHING, NOTHING, false);
      this.say("There is nothing to show: noise explains all there is.");
    }
    tour.begin();
  }

  /** What is not needed for the first picture. */
  async learn(): Promise<void> {
    try {
      await this.api.quiet();
      if (!this.catalogue.isKnown) this.catalogue.learn(await this.api.branches(MOST_LISTED));
      this.choosing.learned();
    } catch (error) {
      this.fail(error);
    }
  }

  say(text: string): void {
    this.said.textContent = text;
  }

  fail(error: unknown): void {
    if (!isOvertaken(error)) this.say(error instanceof Error ? error.message : String(error));
  }

  private listenToClicks(): void {
    const { canvas } = this.stage;
    onClick(canvas, (event) => {
      const entry = this.stage.pick(...placeOn(canvas, event));
      this.editor.select(this.history.now.shown.findIndex((shown) => shown.entry === entry));
    });
  }

  private show(state: State, before: State, dragging: boolean): void {
    if (state.shown !== before.shown || state.selected !== before.selected) this.say(""); // what was said was about what was before
    this.axis.show(state); // the number and the cost first: they answer the hand
    if (!dragging) history.replaceState(null, "", toHash(state));
    this.choosing.show(state, before);
    this.shown.show(state);
    this.panel.show(state, dragging);
    this.scene.show(state, before, dragging);
    if (state.view && state.view !== before.view) this.stage.eye.view = state.view; // to the digit, so that a link shows the same pixels
  }
}

/** What the server has given this browser; every question carries it, beside a cookie. */
function ownKey(): string {
  try {
    return localStorage.getItem("isoatlas") ?? "";
  } catch {
    return ""; // the browser keeps nothing; the server says what to do
  }
}

async function start(main: HTMLElement): Promise<void> {
  const api = new Api(ownKey());
  try {
    const page = await pageWhenThere(api, main);
    document.title = `${page.volume.name} – isoatlas`;
    if (page.volume.size.length !== 3)
      throw new Error("An image has no surfaces to explore; isoatlas with the name of its file makes a page of it.");
    const asked = fromHash(location.hash, numbersOf(page));
    const catalogue = new Catalogue(page);
    if (asked && needsAll(page, asked)) catalogue.learn(await api.branches(MOST_LISTED));
    await new Viewer(api, page, catalogue, asked, main).learn();
  } catch (error) {
    main.append(html("p", { role: "alert" }, error instanceof Error ? error.message : String(error)));
  }
}

const main = document.getElementById("viewer");
if (main) void start(main);
