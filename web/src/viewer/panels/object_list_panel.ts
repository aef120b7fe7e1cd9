// List of objects: as cards, rows, a tree, or a scatter plot of contrast and size; search, order, hidden counts.
import { orders } from "../../shared/orders";
import { hiddenSentences } from "../../shared/hidden_counts";
import { html } from "../../shared/dom";
import { count, plural } from "../../shared/format";
import { commandList } from "../../shared/commands";
import { ANY, CHOICE, commandOf, isSelection, selectionOptions, TAB, type Choice, type TabName } from "../state/selection";
import { selectedOf, type ViewerContext } from "../context/viewer_context";
import { addSearchKeys } from "./search_keys";
import { allOf, find, NOTHING_FOUND, type SearchResult } from "./object_search";
import { card, row } from "./items";
import { ItemsTab } from "./items_tab";
import { ScatterTab } from "./scatter_tab";
import type { State } from "../state/state";
import { Tabs } from "./tabs";
import { TreeTab } from "./tree_tab";
import "./object_list.css";

const FIND = "find objects by name, number, reference or isovalue";

function orderOption(name: string): HTMLElement {
  return html("option", { value: name }, name === "rank" ? "by importance" : `by ${name}`);
}

function noneWords(text: string): string {
  return `none: “${text}” is no name, number, reference (3, c1) or isovalue of a listed object`;
}

export class ObjectListPanel {
  readonly element: HTMLElement;
  private readonly tabs: Tabs<TabName>;
  private readonly cards: ItemsTab;
  private readonly list: ItemsTab;
  private readonly tree: TreeTab;
  private readonly scatter: ScatterTab;
  private readonly text = html("input", { type: "search", placeholder: "find: 3, c1, 127, name", "aria-label": FIND });
  private readonly order = html("select", { "aria-label": "order" }, ...orders.map(([name]) => orderOption(name)));
  private readonly words = html("p", { role: "status" });
  private readonly command = html("div", { class: "same-list" });
  private readonly finder = html("div", { class: "finder" }, this.text, this.order);
  private chosen: number[] = [];
  private kept = 0;
  private found: SearchResult = NOTHING_FOUND;
  /** key of the last search: scene, text, order and choice */
  private sought = "";
  /** tabs that do not show the current result yet */
  private readonly stale = new Set<TabName>(["cards", "list", "tree"]);

  /** volumes: menus of the volumes of the file. */
  constructor(
    private readonly context: ViewerContext,
    volumes: HTMLElement | null,
  ) {
    const { page, editor: selector, catalogue, pictures } = context;
    this.cards = new ItemsTab("cards", (i) => card(page, i, selector, pictures));
    this.list = new ItemsTab("rows", (i) => row(page, i, selector));
    this.tree = new TreeTab(page, catalogue, selector);
    this.scatter = new ScatterTab(page, catalogue, selector, (choice, transient) => this.choose(choice, transient));
    this.tabs = new Tabs<TabName>(
      [
        { name: "cards", title: "Cards", panel: this.cards.panel },
        { name: "list", title: "List", panel: this.list.panel },
        { name: "tree", title: "Tree", panel: this.tree.panel },
        { name: "scatter", title: "Filter", panel: html("div", {}, this.scatter.panel, this.command) },
      ],
      "list of objects",
      (name) => this.open(name),
    );
    const head = [html("h1", {}, page.volume.name), ...(volumes ? [volumes] : []), this.words, this.hidden(), this.finder];
    this.element = html("nav", { class: "objects", "aria-label": "objects" }, ...head, this.tabs.element);
    for (const input of [this.text, this.order]) input.addEventListener("input", () => this.refresh(context.history.now));
    const [first, changed] = [() => this.showFirst(), () => this.refresh(context.history.now)];
    addSearchKeys(this.text, this.tabs.element, () => this.focusable(), first, changed);
    this.addActions();
  }

  /** Elements of the open tab that stand for what is found. */
  private focusable(): HTMLElement[] {
    const selector = ".items .card > button, .items .rows button, .tree [role=treeitem]";
    return [...this.tabs.element.querySelectorAll<HTMLElement>(selector)].filter((element) => element.checkVisibility());
  }

  private showFirst(): void {
    const [first] = this.text.value.trim() === "" ? [] : allOf(this.found);
    if (first !== undefined) this.context.editor.isolate(first);
  }

  /** All objects are loaded, not only those of the page. */
  onCatalogueLoaded(): void {
    this.scatter.onCatalogueLoaded();
    this.recount(this.context.history.now);
    this.sought = "";
    this.refresh(this.context.history.now);
  }

  /** Titles have changed. */
  renew(state: State): void {
    for (const tab of [this.cards, this.list]) tab.forget();
    for (const name of ["cards", "list", "tree"] as const) this.stale.add(name);
    this.sought = "";
    this.refresh(state);
  }

  private recount(state: State): void {
    this.chosen = this.context.catalogue.chosen(CHOICE.of(state));
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

  /** Rebuilds the list only if something relevant changed: states change at the rate of a drag, and lists may be long. */
  private search(state: State): void {
    const wanted = { text: this.text.value, order: this.order.value };
    const sought = JSON.stringify([state.shown.map(({ entry }) => entry), wanted, state.parts.choice]);
    if (sought === this.sought) return;
    this.sought = sought;
    const found = find(this.context.page, this.chosen, state.shown, wanted);
    const same = JSON.stringify(found) === JSON.stringify(this.found); // keeps the focus
    this.found = found;
    if (!same) for (const name of ["cards", "list", "tree"] as const) this.stale.add(name);
    this.showCount(CHOICE.of(state));
  }

  private showCount(choice: Choice | null): void {
    const { page } = this.context;
    const words = [this.countWords(choice)];
    const { cavities } = this.found;
    const found = allOf(this.found).length;
    const text = this.text.value.trim();
    if (cavities.length > 0) words.push(`and ${plural(this.context.catalogue.objectsOf(cavities), "cavity", "cavities")}`);
    if (text !== "") words.splice(0, words.length, found > 0 ? `found: ${count(found)}` : noneWords(text));
    if (this.words.textContent !== words.join(", ")) this.words.textContent = words.join(", "); // live regions repeat unchanged text
    if (!this.context.catalogue.isLoaded) return;
    const { line, same } = commandOf(choice, this.context.catalogue.source, page.found.objects.significant, page.volume.unit !== null);
    const name = same ? "the same list on the command line" : "command line, with lower limits only: a superset of this list";
    if (this.command.dataset.line !== line + name) this.command.replaceChildren(commandList([{ name, line }]));
    this.command.dataset.line = line + name;
  }

  /** "37 of 18,204 objects shown"; more may be chosen than are listed. */
  private countWords(choice: Choice | null): string {
    const { all, total } = this.context.catalogue;
    const shown = this.context.catalogue.objectsOf(this.chosen);
    const hidden = choice !== null && this.kept > shown ? ` ${count(this.kept)} chosen of` : "";
    const isovalues = this.chosen.length > shown ? ", some at several isovalues" : "";
    return `${count(shown)} of${hidden} ${plural(choice === null ? total : all, "object")} shown${isovalues}`;
  }

  /** Counts the chosen objects where not all objects are listed. */
  private async countKept(choice: Choice | null): Promise<void> {
    this.kept = 0;
    const { sizes, all, isLoaded } = this.context.catalogue;
    if (choice === null || !isSelection(choice) || !isLoaded || sizes.length === all) return;
    try {
      this.kept = await this.context.api.kept(selectionOptions(choice, this.context.page.volume.unit !== null));
      this.showCount(CHOICE.of(this.context.history.now));
    } catch (error) {
      this.context.reportError(error);
    }
  }

  /** Hidden objects: how many, why, and buttons to show them. */
  private hidden(): HTMLElement {
    const { page } = this.context;
    const { significant } = page.found.objects;
    const pictured = this.context.catalogue.objectsOf(this.context.catalogue.chosen(null));
    const more = (name: string, choice: Choice | null): HTMLElement =>
      html("button", { type: "button", click: () => this.choose(choice, false) }, name);
    return html(
      "details",
      { class: "hidden-words" },
      html("summary", {}, "Hidden objects"),
      ...hiddenSentences(page).map((words) => html("p", {}, words)),
      html(
        "div",
        { class: "line" },
        more("Automatic choice", null),
        significant > pictured && more(`All ${count(significant)} significant objects`, { ...ANY, significant: true }),
        more("The 100 most important", { ...ANY, keep: 100 }),
        html("button", { type: "button", click: () => this.open("scatter") }, "Filter by contrast and size"),
      ),
    );
  }

  private choose(choice: Choice | null, transient: boolean): void {
    const { history } = this.context;
    history.go(CHOICE.with(history.now, choice), transient);
  }

  private open(tab: TabName): void {
    this.context.history.changeAll((state) => TAB.with(state, tab));
  }

  private focusTab(tab: TabName): void {
    this.context.panels.open("list");
    this.open(tab);
    document.getElementById(`tab-${tab}`)?.focus();
  }

  /** Isolates the next or previous object of the list. */
  private step(by: number): void {
    const numbers = allOf(this.found);
    const at = numbers.indexOf(selectedOf(this.context.history.now)?.entry ?? NaN);
    const next = numbers[at < 0 ? 0 : (at + by + numbers.length) % numbers.length];
    if (next !== undefined) this.context.editor.isolate(next);
  }

  private addActions(): void {
    this.context.actions.add(
      { group: "Objects", name: "Cards", keys: ["1"], run: () => this.focusTab("cards") },
      { group: "Objects", name: "List", keys: ["2"], run: () => this.focusTab("list") },
      { group: "Objects", name: "Tree", keys: ["3", "t"], run: () => this.focusTab("tree") },
      { group: "Objects", name: "Filter by contrast and size", keys: ["4"], run: () => this.focusTab("scatter") },
      { group: "Objects", name: "Find by name, number or isovalue", keys: ["/"], run: () => this.find() },
      { group: "Objects", name: "Isolate next object", keys: ["n"], run: () => this.step(1) },
      { group: "Objects", name: "Isolate previous object", keys: ["N"], run: () => this.step(-1) },
    );
  }

  private find(): void {
    this.context.panels.open("list");
    if (TAB.of(this.context.history.now) === "scatter") this.open("cards");
    this.text.focus();
    this.text.select();
  }
}
