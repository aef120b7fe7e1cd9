// The title of the selected object: a double click, or a key, turns it into a text box for its name.
import { html } from "../../shared/dom";
import { entryOf } from "../../shared/page";
import type { ViewerContext } from "../context/viewer_context";
import { selectedOf } from "../context/viewer_context";
import { titleOf } from "../api/entries";

export class TitleEditor {
  readonly title = html("h2", { title: "double-click to name it", dblclick: () => this.edit() });
  private readonly box = html("input", { type: "text", maxlength: 100, "aria-label": "name of the object", hidden: true });
  readonly element = html("div", { class: "title-editor" }, this.title, this.box);
  private entry = NaN;

  constructor(private readonly context: ViewerContext) {
    this.box.addEventListener("keydown", (event) => {
      if (event.key === "Enter") void this.finish();
      if (event.key === "Escape") this.close();
    });
    this.box.addEventListener("blur", () => this.close());
    context.actions.add({ group: "Objects", name: "Rename selected object...", keys: ["F2"], needsServer: true, run: () => this.edit() });
  }

  show(entry: number): void {
    if (entry !== this.entry) this.close();
    this.entry = entry;
    this.title.textContent = titleOf(this.context.page, entry);
  }

  private edit(): void {
    const shown = selectedOf(this.context.history.now);
    const { problem } = this.context.api.connection;
    if (problem !== "") return this.context.notify(`a name ${problem}`);
    if (!shown) return this.context.notify("select an object first");
    if (!this.context.names.canName(shown.entry)) return this.context.notify("only objects with a card have names");
    this.context.panels.open("scene");
    this.entry = shown.entry;
    this.box.value = entryOf(this.context.page, shown.entry).name ?? "";
    this.box.placeholder = titleOf(this.context.page, shown.entry);
    this.title.hidden = true;
    this.box.hidden = false;
    this.box.focus();
    this.box.select();
  }

  private close(): void {
    this.box.hidden = true;
    this.title.hidden = false;
  }

  private async finish(): Promise<void> {
    const name = this.box.value.trim();
    try {
      await this.context.names.rename(this.entry, name);
      this.context.notify(name === "" ? "its name is taken away" : `named ${name}`);
    } catch (error) {
      this.context.reportError(error);
    }
    this.close();
  }
}
