// Four steps for the first time. It takes nothing away: the page works behind it, Escape closes it, and it comes again from the menu.
import { html } from "../dom";
import type { Desk } from "./desk/desk";
import { recall, remember } from "./state/remembered";

interface Step {
  /** what it is about */
  selector: string;
  title: string;
  text: string;
}

const STEPS: Step[] = [
  {
    selector: ".side",
    title: "Objects, not thresholds",
    text:
      "These objects stand out of the volume, the most important first, each at the isovalue that shows it best." +
      " Click one to see it alone; with shift it is added.",
  },
  {
    selector: ".axis",
    title: "Each object has its own isovalue",
    text:
      "Drag along the histogram and the selected object grows or shrinks, the others stay." +
      " Ticks are where objects begin or join: { and } go there, [ and ] go in steps.",
  },
  {
    selector: ".inspector",
    title: "What is shown, and what it is",
    text:
      "Hide an object, give it another colour, make it transparent, or make the others ghosts." +
      " Below: what it contains and what it joins, as links.",
  },
  {
    selector: ".menus",
    title: "Take it away",
    text:
      "Save has surfaces, labels, pictures, animations, tables, and the command line that draws this." +
      " The address holds the whole view: copy it. Press ? for all keys.",
  },
];

export class Tour {
  readonly element = html("section", { class: "tour", role: "dialog", "aria-labelledby": "tour-title", hidden: true });
  private readonly title = html("h2", { id: "tour-title", tabindex: -1 });
  private readonly text = html("p", {});
  private readonly back = html("button", { type: "button", click: () => this.go(this.at - 1) }, "Back");
  private readonly next = html("button", { type: "button", class: "next", click: () => this.go(this.at + 1) });
  private at = 0;

  constructor({ actions }: Desk) {
    const close = html("button", { type: "button", class: "plain", "aria-label": "Close the tour", click: () => this.close() }, "×");
    this.element.append(html("header", {}, this.title, close), this.text, html("div", { class: "line" }, this.back, this.next));
    document.addEventListener("keydown", (event) => event.key === "Escape" && this.close());
    const again = (): void => {
      this.go(0);
      this.title.focus();
    };
    actions.add({ group: "Help", name: "tour of four steps", run: again });
  }

  /** Once in a browser. */
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
