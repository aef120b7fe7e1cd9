// Tabs (ARIA tablist): arrows, Home and End move between them.
import { html } from "../../shared/dom";

export interface Tab<Name extends string> {
  name: Name;
  title: string;
  panel: HTMLElement;
}

export class Tabs<Name extends string> {
  readonly element: HTMLElement;
  private readonly buttons: HTMLButtonElement[];

  constructor(
    private readonly tabs: Tab<Name>[],
    label: string,
    private readonly opened: (name: Name) => void,
  ) {
    this.buttons = tabs.map(({ name, title }) => {
      const roles = { role: "tab", id: `tab-${name}`, "aria-controls": `panel-${name}` };
      return html("button", { type: "button", ...roles, click: () => opened(name) }, title);
    });
    for (const { name, panel } of tabs) {
      panel.id = `panel-${name}`;
      panel.setAttribute("role", "tabpanel");
      panel.setAttribute("aria-labelledby", `tab-${name}`);
    }
    const bar = html("div", { class: "tabs", role: "tablist", "aria-label": label }, ...this.buttons);
    bar.addEventListener("keydown", (event) => this.move(event));
    this.element = html("div", { class: "tabbed" }, bar, ...tabs.map(({ panel }) => panel));
  }

  show(open: Name): void {
    this.tabs.forEach(({ name, panel }, at) => {
      panel.hidden = name !== open;
      this.buttons[at]?.setAttribute("aria-selected", String(name === open));
      this.buttons[at]?.setAttribute("tabindex", name === open ? "0" : "-1");
    });
  }

  private move(event: KeyboardEvent): void {
    const at = this.buttons.findIndex((button) => button === event.target);
    const to: Record<string, number> = { ArrowLeft: at - 1, ArrowRight: at + 1, Home: 0, End: this.tabs.length - 1 };
    const next = to[event.key];
    if (at < 0 || next === undefined) return;
    event.preventDefault();
    const there = (next + this.tabs.length) % this.tabs.length;
    const tab = this.tabs[there];
    if (tab) this.opened(tab.name);
    this.buttons[there]?.focus();
  }
}
