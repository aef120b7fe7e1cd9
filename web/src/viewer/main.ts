// The viewer: state (state/), drawing (scene/), and the parts that act on them.
import { html } from "../shared/dom";
import { referenceOf } from "../shared/names";
import type { Page } from "../shared/page";
import { Actions } from "./context/actions";
import { fromHash, toHash } from "./state/address";
import { Api, ConnectionError, isSuperseded } from "./api/api";
import { IsovaluePanel } from "./panels/isovalue_panel";
import { addSelectionBrackets } from "./tools/selection_brackets";
import { Catalogue, MAX_LISTED, needsAll, numbersOf } from "./api/catalogue";
import { ObjectListPanel } from "./panels/object_list_panel";
import { onClick, placeOn } from "./context/clicks";
import type { ViewerContext } from "./context/viewer_context";
import { Editor } from "./context/editor";
import { ObjectNames } from "./api/object_names";
import { Pictures } from "./api/pictures";
import { TransferProposal } from "./api/transfer_proposal";
import { History } from "./state/history";
import { addUnitTool } from "./tools/unit_tool";
import { addTools } from "./tools/tools";
import { help, menus } from "./menus";
import { EmptyHint } from "./panels/empty_hint";
import { ObjectPanel } from "./panels/object_panel";
import { ExportDialog } from "./export/export_dialog";
import { readScene } from "./export/scene_file";
import { SceneChannel } from "./export/scene_channel";
import { PanelSwitch } from "./panels/panel_switch";
import { Scene } from "./scene/scene";
import { addSceneActions } from "./panels/scene_actions";
import { ScenePanel } from "./panels/scene_panel";
import { Viewport } from "./scene/viewport";
import { NOTHING, type State } from "./state/state";
import { addIsovalueSteps } from "./panels/isovalue_steps";
import { firstToShow } from "../shared/cards";
import { cameraOf, commonHash, VolumeMenu } from "./panels/volume_menu";
import { addThemeAction } from "./context/theme";
import { Tour } from "./tour";
import { ownKey, takeFrameKey, waitForPage } from "./waiting";
import "./viewer.css";
import "./panels/scene.css";
import "./panels/panel_switch.css";

class Viewer implements ViewerContext {
  readonly history: History;
  readonly viewport = new Viewport(() => this.history.go({ ...this.history.now, view: this.viewport.rig.view }));
  readonly actions = new Actions(
    () => this.api.connection.problem,
    (text) => this.notify(text),
  );
  readonly overlay = html("div", { class: "viewport" });
  readonly editor: Editor;
  readonly scene: Scene;
  readonly names: ObjectNames;
  readonly pictures: Pictures;
  readonly proposal: TransferProposal;
  readonly panels: PanelSwitch;
  private readonly message = html("p", { class: "message", role: "status" });
  private readonly axis: IsovaluePanel;
  private readonly objectList: ObjectListPanel;
  private readonly shown: ScenePanel;
  private readonly objectPanel: ObjectPanel;
  private readonly emptyHint: EmptyHint;

  constructor(
    readonly api: Api,
    readonly page: Page,
    readonly catalogue: Catalogue,
    linked: State | null,
    volumes: VolumeMenu | null,
    main: HTMLElement,
  ) {
    this.history = new History(linked ?? NOTHING);
    this.editor = new Editor(page, this.history);
    this.scene = new Scene(this);
    this.names = new ObjectNames(api, page);
    this.pictures = new Pictures(api, page);
    this.proposal = new TransferProposal(api, page);
    this.panels = new PanelSwitch(main);
    addUnitTool(this, () => this.renewTitles()); // first: all others make text with lengths
    this.objectList = new ObjectListPanel(this, volumes?.element ?? null);
    if (volumes) volumes.hash = () => commonHash({ ...this.history.now, view: this.viewport.rig.view });
    addIsovalueSteps(this);
    this.axis = new IsovaluePanel(this);
    addSceneActions(this);
    this.shown = new ScenePanel(this);
    this.objectPanel = new ObjectPanel(this);
    this.emptyHint = new EmptyHint(this);
    addTools(this);
    addSelectionBrackets(this);
    addThemeAction(this);
    const tour = new Tour(this);
    const side = html("div", { class: "side" }, this.objectList.element);
    const inspector = html("div", { class: "inspector" }, this.shown.element, this.objectPanel.element);
    this.overlay.prepend(this.viewport.canvas, menus(this.actions));
    this.overlay.append(this.emptyHint.element, this.message, tour.element);
    const dialogs = [new ExportDialog(this).element, help(this.actions)];
    main.append(this.panels.element, side, this.overlay, inspector, this.axis.element, ...dialogs);
    this.names.onChange(() => this.renewTitles());
    this.history.listen((state, before, dragging) => this.show(state, before, dragging));
    this.actions.listen(document);
    this.listenToClicks();
    if (linked) this.show(linked, NOTHING, false);
    else if (page.entries.length > 0) {
      this.editor.init(firstOf(page, location.hash));
      const view = cameraOf(location.hash) ?? this.history.now.view;
      this.history.amend({ ...this.history.now, view });
    } else {
      this.show(NOTHING, NOTHING, false);
      this.notify("No objects to show: all of them are below noise level.");
    }
    api.connection.onChange(() => this.followConnection());
    if (!api.isInFrame) tour.begin();
  }

  /** Requests what failed while there was no connection. */
  private followConnection(): void {
    if (this.api.connection.state !== "up") return;
    this.history.amend(this.history.now);
    void this.loadCatalogue();
    this.notify("connected again");
  }

  /** Loads what the first image does not need. */
  async loadCatalogue(): Promise<void> {
    void this.names.load().catch((error: unknown) => this.reportError(error));
    try {
      await this.api.idle();
      if (!this.catalogue.isLoaded) this.catalogue.load(await this.api.branches(MAX_LISTED));
      this.objectList.onCatalogueLoaded();
    } catch (error) {
      this.reportError(error);
    }
  }

  private renewTitles(): void {
    this.viewport.draw();
    for (const panel of [this.objectList, this.shown, this.objectPanel]) panel.renew(this.history.now);
  }

  notify(text: string): void {
    this.message.textContent = text;
  }

  reportError(error: unknown): void {
    if (!isSuperseded(error) && !(error instanceof ConnectionError)) this.notify(error instanceof Error ? error.message : String(error));
  }

  private listenToClicks(): void {
    const { canvas } = this.viewport;
    onClick(canvas, (event) => {
      const entry = this.viewport.pick(...placeOn(canvas, event));
      this.editor.select(this.history.now.shown.findIndex((shown) => shown.entry === entry));
    });
  }

  private show(state: State, before: State, dragging: boolean): void {
    if (state.shown !== before.shown || state.selected !== before.selected) this.notify(""); // the message referred to the previous state
    this.axis.show(state); // number and estimate first: immediate feedback
    if (!dragging) history.replaceState(null, "", toHash(state));
    this.objectList.show(state, before);
    this.shown.show(state);
    this.objectPanel.show(state, dragging);
    this.emptyHint.show(state);
    if (state.view && state.view !== before.view) this.viewport.rig.view = state.view; // all digits: same pixels by link
    this.scene.show(state, before, dragging); // from there
  }
}

/** The entry that an address names by its reference, "#low2"; else the first one. */
function firstOf(page: Page, hash: string): number {
  const named = page.entries.findIndex((_, i) => `#${referenceOf(page, i)}` === hash);
  return named >= 0 ? named : firstToShow(page);
}

/** That of the address; else that of the scene with which the server was started. */
async function firstState(api: Api, page: Page, catalogue: Catalogue): Promise<{ state: State | null; problem: string; version: number }> {
  const { text, file, version } = location.hash === "" ? await api.scene() : { text: "", file: "", version: 0 };
  if (text === "") return { state: fromHash(location.hash, numbersOf(page)), problem: "", version };
  try {
    catalogue.load(await api.branches(MAX_LISTED)); // it may show any of the objects
    return { state: readScene(page, text), problem: "", version };
  } catch (error) {
    const name = file === "" ? "The scene" : file;
    return { state: null, problem: `${name} is not shown. ${error instanceof Error ? error.message : String(error)}`, version };
  }
}

async function start(main: HTMLElement): Promise<void> {
  const api = new Api(ownKey(), ".", takeFrameKey());
  try {
    const volumes = await VolumeMenu.of(api);
    const page = await waitForPage(api, main, volumes?.element ?? null);
    document.title = `${page.volume.name} – isoatlas`;
    if (page.volume.size.length !== 3)
      throw new Error("The viewer needs a 3D volume. For a 2D image, run isoatlas with the name of its file to write a page.");
    const catalogue = new Catalogue(page);
    const { state, problem, version } = await firstState(api, page, catalogue);
    if (state && needsAll(page, state) && !catalogue.isLoaded) catalogue.load(await api.branches(MAX_LISTED));
    const viewer = new Viewer(api, page, catalogue, state, volumes, main);
    if (problem !== "") viewer.notify(problem);
    const allKnown = viewer.loadCatalogue();
    if (api.isInFrame) new SceneChannel(viewer, version, allKnown).begin();
    await allKnown;
  } catch (error) {
    main.append(html("p", { role: "alert" }, error instanceof Error ? error.message : String(error)));
  }
}

const main = document.getElementById("viewer");
if (main) void start(main);
