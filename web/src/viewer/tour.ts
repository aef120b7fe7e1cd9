// Introduction in four steps, shown once. It does not block the page; Escape closes it, and the menu opens it again.
import { html } from "../shared/dom";
import type { PanelName } from "./panels/panel_switch";
import type { ViewerContext } from "./context/viewer_context";
import { recall, remember } from "./state/local_storage";

interface Step {
  /** element it describes */
  selector: string;
  /** that contains it */
  panel?: PanelName;
  title: string;
  text: string;
}

const STEPS: Step[] = [
  {
    selector: ".side",
    panel: "list",
    title: "Objects, not thresholds",
    text:
      "The significant objects of the volume, the most important first, each at its best isovalue." +
      " Click one to isolate it; shift-click adds it.",
  },
  {
    selector: ".axis",
    title: "Each object has its own isovalue",
    text:
      "Drag along the histogram to change the isovalue of the selected object; the others stay." +
      " Ticks mark where objects appear or merge: { and } go to the next one, [ and ] change it in steps.",
  },
  {
    selector: ".inspector",
    panel: "scene",
    title: "Scene and selected object",
    text:
      "Hide an object, give it another colour, make it transparent, or make the others ghosts." +
      " Below: what it contains and what it merges into, as links.",
  },
  {
    selector: ".menus",
    title: "Export",
    text:
      "Export surfaces, labels, images, animations, tables, and the command line that draws this view." +
      " The address contains the whole view: copy it. Press ? for all keys.",
  },
];

export class Tour {
  readonly element = html("section", { class: "tour", role: "dialog", "aria-labelledby": "tour-title", hidden: true });
  private readonly title = html("h2", { id: "tour-title", tabindex: -1 });
  private readonly text = html("p", {});
  private readonly back = html("button", { type: "button", click: () => this.go(this.at - 1) }, "Back");
  private readonly next = html("button", { type: "button", class: "next", click: () => this.go(this.at + 1) });
  private at = 0;

  constructor(private readonly context: ViewerContext) {
    const { actions } = context;
    const label = "Close the introduction";
    const close = html("button", { type: "button", class: "plain", "aria-label": label, click: () => this.close() }, "×");
    this.element.append(html("header", {}, this.title, close), this.text, html("div", { class: "line" }, this.back, this.next));
    document.addEventListener("keydown", (event) => event.key === "Escape" && this.close());
    const again = (): void => {
      this.go(0);
      this.title.focus();
    };
    actions.add({ group: "Help", name: "Introduction", run: again });
  }

  /** Once per browser. */
  begin(): void {
    if (recall("tour") === null) this.go(0);
  }

  private go(to: number): void {
    const step = STEPS[to];
    if (!step) return this.close();
    this.at = to;
    this.element.hidden = false;
    this.title.textContent = step.title;
    this.text.textContent = step.text;
    this.back.disabled = to === 0;
    this.next.textContent = to + 1 === STEPS.length ? "Done" : `Next (${to + 1} of ${STEPS.length})`;
    if (step.panel) this.context.panels.open(step.panel);
    this.point(step.selector);
  }

  private close(): void {
    if (this.element.hidden) return;
    this.element.hidden = true;
    this.point(null);
    remember("tour", "seen");
  }

  private point(selector: string | null): void {
    document.querySelectorAll(".toured").forEach((element) => element.classList.remove("toured"));
    if (selector) document.querySelector(selector)?.classList.add("toured");
  }
}
