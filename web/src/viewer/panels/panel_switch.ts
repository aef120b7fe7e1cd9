// In a small window one panel at a time stands beside the 3D view, or none: buttons that choose it. Wide windows show both.
import { html, svg } from "../../shared/dom";
import { recall, remember } from "../state/local_storage";

export type PanelName = "list" | "scene";

const TITLES: [PanelName, string, string][] = [
  ["list", "Objects", "M3 5h4v4H3zM3 15h4v4H3zM11 7h10M11 17h10"],
  ["scene", "Scene", "M12 3l8 4.5v9L12 21l-8-4.5v-9zM4 7.5l8 4.5 8-4.5M12 12v9"],
];

export class PanelSwitch {
  readonly element: HTMLElement;
  private readonly buttons: [PanelName, HTMLButtonElement][];

  /** main: has the chosen panel as an attribute, for the style sheet. */
  constructor(private readonly main: HTMLElement) {
    this.buttons = TITLES.map(([name, title, drawing]) => [name, this.button(name, title, drawing)]);
    const buttons = this.buttons.map(([, button]) => button);
    this.element = html("div", { class: "panel-switch", role: "group", "aria-label": "panels" }, ...buttons);
    const last = recall("panel");
    this.choose(last === "scene" || last === "none" ? last : "list");
  }

  /** Before something in the panel takes the focus. Without effect where both are visible anyway. */
  open(name: PanelName): void {
    this.choose(name);
  }

  private button(name: PanelName, title: string, drawing: string): HTMLButtonElement {
    const icon = svg("svg", { viewBox: "0 0 24 24", "aria-hidden": "true" }, svg("path", { d: drawing }));
    const toggle = (): void => this.choose(this.main.dataset.panel === name ? "none" : name);
    return html("button", { type: "button", click: toggle }, icon, html("span", {}, title));
  }

  private choose(chosen: PanelName | "none"): void {
    this.main.dataset.panel = chosen;
    remember("panel", chosen);
    for (const [name, button] of this.buttons) {
      const isOpen = name === chosen;
      button.setAttribute("aria-pressed", String(isOpen));
      button.title = isOpen ? "close this panel: more room for the 3D view" : "open this panel";
    }
  }
}
