// Over the 3D view while nothing is to be seen: why, and what to do.
import { firstToShow } from "../../shared/cards";
import { html } from "../../shared/dom";
import type { ViewerContext } from "../context/viewer_context";
import { EVERYTHING } from "../api/entries";
import { PLANES } from "../state/slice_state";
import { changeAll, type State } from "../state/state";
import { VOLUME_DENSITY } from "../state/volume_state";

export class EmptyHint {
  private readonly title = html("h2", {});
  private readonly text = html("p", {});
  private readonly buttons = html("div", { class: "line" });
  readonly element: HTMLElement;
  private kind = "";

  constructor(private readonly context: ViewerContext) {
    const parts = [this.title, this.text, this.buttons];
    this.element = html("section", { class: "empty", "aria-label": "nothing is shown", hidden: true }, ...parts);
  }

  show(state: State): void {
    const { shown } = state;
    const isSeen = VOLUME_DENSITY.of(state) !== null || PLANES.of(state); // the volume itself
    const kind = isSeen ? "" : reasonOf(shown);
    this.element.hidden = kind === "";
    const undoes = this.context.history.undoes;
    if (kind === "" || kind + undoes === this.kind) return;
    this.kind = kind + undoes;
    if (kind === "hidden")
      this.say("Everything is hidden", "The eye beside the name of an object shows it again.", ["Show all objects", () => this.showAll()]);
    else if (this.context.page.entries.length === 0)
      this.say("No object stands out of the noise", "What remains is the surface of all values at one isovalue.", this.whole());
    else this.say("Nothing is shown", "Click an object in the list to show it here. Shift-click adds another one.", this.first());
    if (undoes) this.buttons.append(this.button("Undo", () => this.context.history.undo(), undoes));
  }

  private say(title: string, text: string, [name, run]: [string, () => void]): void {
    this.title.textContent = title;
    this.text.textContent = text;
    this.buttons.replaceChildren(this.button(name, run));
  }

  private first(): [string, () => void] {
    return ["Show the first object", () => this.context.editor.isolate(firstToShow(this.context.page))];
  }

  private whole(): [string, () => void] {
    return ["Show the whole isosurface", () => this.context.editor.isolate(EVERYTHING)];
  }

  private showAll(): void {
    const { history } = this.context;
    history.go(changeAll(history.now, { visible: true }));
  }

  private button(name: string, click: () => void, title?: string): HTMLElement {
    return html("button", { type: "button", title, click }, name);
  }
}

function reasonOf(shown: State["shown"]): "" | "empty" | "hidden" {
  if (shown.length === 0) return "empty";
  return shown.every(({ visible }) => !visible) ? "hidden" : "";
}
