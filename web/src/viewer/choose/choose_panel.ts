// The objects to choose from, left of the picture: as cards, in a list, in their tree, or by contrast and size; what is hidden, and why.
import { orders } from "../../choice";
import { hiddenWords } from "../../curve";
import { html } from "../../dom";
import { count, plural } from "../../format";
import { commandList } from "../../commands";
import { ANY, CHOICE, commandOf, isSelection, selectionWords, TAB, type Choice, type TabName } from "../state/choosing";
import { selectedOf, type Desk } from "../desk/desk";
import { find, type Found } from "./found";
import { card, row } from "./items";
import { ItemsTab } from "./items_tab";
import { Pictures } from "../ask/pictures";
import { ScatterTab } from "./scatter_tab";
import type { State } from "../state/state";
import { Tabs } from "./tabs";
import { TreeTab } from "./tree_tab";
import "./choose.css";

const FIND = "find objects by name, number or reason";

function orderOption(name: string): HTMLElement {
  return html("option", { value: name }, name === "rank" ? "by importance" : `by ${name}`);
}

export class ChoosePanel {
  readonly element: HTMLElement;
  private readonly tabs: Tabs<TabName>;
  private readonly cards: ItemsTab;
  private readonly list: ItemsTab;
  private readonly tree: TreeTab;
  private readonly scatter: ScatterTab;
  private readonly text = html("input", { type: "search", placeholder: "find: 3, cavity, sharp", "aria-label": FIND });
  private readonly order = html("select", { "aria-label": "order" }, ...orders.map(([name]) => orderOption(name)));
  private readonly words = html("p", { role: "status" });
  private readonly command = html("div", { class: "same-list" });
  private readonly finder = html("div", { class: "finder" }, this.text, this.order);
  private chosen: number[] = [];
  private kept = 0;
  private found: Found = { bright: [], dark: [], also: [] };
  /** what was found: of which scene, words and choice */
  private sought = "";
  /** what has not been filled with what is found now */
  private readonly stale = new Set<TabName>(["cards", "list", "tree"]);

  constructor(private readonly desk: Desk) {
    const { page, editor: chooser, catalogue } = desk;
    const pictures = new Pictures(desk.api, page);
    this.cards = new ItemsTab("cards", (i) => card(page, i, chooser, pictures));
    this.list = new ItemsTab("rows", (i) => row(page, i, chooser));
    this.tree = new TreeTab(page, catalogue, chooser);
    this.scatter = new ScatterTab(page, catalogue, chooser, (choice, transient) => this.choose(choice, transient));
    this.tabs = new Tabs<TabName>(
      [
        { name: "cards", title: "Cards", panel: this.cards.panel },
        { name: "list", title: "List", panel: this.list.panel },
        { name: "tree", title: "Tree", panel: this.tree.panel },
        { name: "scatter", title: "Essential?", panel: html("div", {}, this.scatter.panel, this.command) },
      ],
      "how objects are listed",
      (name) => this.open(name),
    );
    const head = [html("h1", {}, page.volume.name), this.words, this.hidden(), this.finder];
    this.element = html("nav", { class: "objects", "aria-label": "objects" }, ...head, this.tabs.element);
    for (const input of [this.text, this.order]) input.addEventListener("input", () => this.refresh(desk.history.now));
    this.addActions();
  }

  /** All objects are known now, not only those of the page. */
  learned(): void {
    this.scatter.learned();
    this.recount(this.desk.history.now);
    this.sought = "";
    this.refresh(this.desk.history.now);
  }

  private recount(state: State): void {
    this.chosen = this.desk.catalogue.chosen(CHOICE.of(state));
    void this.countKept(CHOICE.of(state));
  }

  show(state: State, before: State): void {
    if (state.parts.choice !== before.parts.choice || this.chosen.length === 0) this.recount(state);
    const tab = TAB.of(state);
    this.tabs.show(tab);
    this.finder.hidden = tab === "scatter";
    this.order.hidden = tab === "tree";
    this.refresh(state);
  }

  private refresh(state: State): void {
    this.search(state);
    const open = TAB.of(state);
    if (open === "scatter") return this.scatter.mark(state, this.chosen);
    const tab = { cards: this.cards, list: this.list, tree: this.tree }[open];
    if (this.stale.delete(open)) tab.fill(this.found);
    tab.mark(state);
  }

  /** Thousands may be chosen, and states come as fast as something is dragged: only what matters to the list makes it anew. */
  private search(state: State): void {
    const wanted = { text: this.text.value, order: this.order.value };
    const sought = JSON.stringify([state.shown.map(({ entry }) => entry), wanted, state.parts.choice]);
    if (sought === this.sought) return;
    this.sought = sought;
    const found = find(this.desk.page, this.chosen, state.shown, wanted);
    const same = JSON.stringify(found) === JSON.stringify(this.found); // then what has the focus stays where it is
    this.found = found;
    if (!same) for (const name of ["cards", "list", "tree"] as const) this.stale.add(name);
    this.say(CHOICE.of(state));
  }

  private say(choice: Choice | null): void {
    const { page } = this.desk;
    const words = [this.countWords(choice)];
    if (this.found.dark.length > 0) words.push(`and ${plural(this.desk.catalogue.objectsOf(this.found.dark), "dark object")}`);
    const { bright, dark, also } = this.found;
    if (this.text.value.trim() !== "") words.push(`found: ${count(bright.length + dark.length + also.length)}`);
    if (this.words.textContent !== words.join(", ")) this.words.textContent = words.join(", "); // what is said again is read out again
    if (!this.desk.catalogue.isKnown) return;
    const { line, same } = commandOf(choice, this.desk.catalogue.source, page.objects.bright.standingOut, page.volume.unit !== null);
    const name = same ? "the same list on the command line" : "on the command line, which knows only lower limits: a list that holds these";
    if (this.command.dataset.line !== line + name) this.command.replaceChildren(commandList([{ name, line }]));
    this.command.dataset.line = line + name;
  }

  /** Such as "37 of 18,204 objects shown"; more may be chosen than are listed. */
  private countWords(choice: Choice | null): string {
    const { all } = this.desk.catalogue;
    const shown = this.desk.catalogue.objectsOf(this.chosen);
    const hidden = choice !== null && this.kept > shown ? ` ${count(this.kept)} chosen ones, of` : "";
    const isovalues = this.chosen.length > shown ? ", some at several isovalues" : "";
    return `${count(shown)} of${hidden} ${plural(all, "object")} shown${isovalues}`;
  }

  /** How many are chosen, where not all objects are known here. */
  private async countKept(choice: Choice | null): Promise<void> {
    this.kept = 0;
    const { sizes, all, isKnown } = this.desk.catalogue;
    if (choice === null || !isSelection(choice) || !isKnown || sizes.length === all) return;
    try {
      this.kept = await this.desk.api.kept(selectionWords(choice, this.desk.page.volume.unit !== null));
      this.say(CHOICE.of(this.desk.history.now));
    } catch (error) {
      this.desk.fail(error);
    }
  }

  /** What is not listed at first, why, and how to see it. */
  private hidden(): HTMLElement {
    const { page } = this.desk;
    const { standingOut } = page.objects.bright;
    const pictured = this.desk.catalogue.objectsOf(this.desk.catalogue.chosen(null));
    const more = (name: string, choice: Choice | null): HTMLElement =>
      html("button", { type: "button", click: () => this.choose(choice, false) }, name);
    return html(
      "details",
      { class: "hidden-words" },
      html("summary", {}, "What is hidden, and why"),
      ...hiddenWords(page).map((words) => html("p", {}, words)),
      html(
        "div",
        { class: "line" },
        more("As at first", null),
        standingOut > pictured && more(`All ${count(standingOut)} that stand out`, { ...ANY, standsOut: true }),
        more("The 100 most important", { ...ANY, keep: 100 }),
        html("button", { type: "button", click: () => this.open("scatter") }, "Choose by contrast and size"),
      ),
    );
  }

  private choose(choice: Choice | null, transient: boolean): void {
    const { history } = this.desk;
    history.go(CHOICE.in(history.now, choice), transient);
  }

  private open(tab: TabName): void {
    this.desk.history.everywhere((state) => TAB.in(state, tab));
  }

  private focusTab(tab: TabName): void {
    this.open(tab);
    document.getElementById(`tab-${tab}`)?.focus();
  }

  /** The next object of the list, or the one before. */
  private step(by: number): void {
    const numbers = [...this.found.bright, ...this.found.also, ...this.found.dark];
    const at = numbers.indexOf(selectedOf(this.desk.history.now)?.entry ?? NaN);
    const next = numbers[at < 0 ? 0 : (at + by + numbers.length) % numbers.length];
    if (next !== undefined) this.desk.editor.isolate(next);
  }

  private addActions(): void {
    this.desk.actions.add(
      { group: "Objects", name: "as cards", keys: ["1"], run: () => this.focusTab("cards") },
      { group: "Objects", name: "in a list", keys: ["2"], run: () => this.focusTab("list") },
      { group: "Objects", name: "in their tree, over the isovalue", keys: ["3", "t"], run: () => this.focusTab("tree") },
      { group: "Objects", name: "by contrast and size: what is essential?", keys: ["4"], run: () => this.focusTab("scatter") },
      { group: "Objects", name: "find by name, number or reason", keys: ["/"], run: () => this.find() },
      { group: "Objects", name: "the next one alone", keys: ["n"], run: () => this.step(1) },
      { group: "Objects", name: "the one before alone", keys: ["N"], run: () => this.step(-1) },
    );
  }

  private find(): void {
    if (TAB.of(this.desk.history.now) === "scatter") this.open("cards");
    this.text.focus();
    this.text.select();
  }
}
