// The layers of the opacity curve as a legend: a swatch that shows or hides, a name that selects.
import { html } from "../../shared/dom";
import { value } from "../../shared/format";
import { nameOf } from "../../shared/names";
import type { Page } from "../../shared/page";
import { entryAt } from "../api/transfer_function";
import { colourOfLayer, type Layer } from "../state/opacity_curve";
import type { OpacityModel } from "./opacity_model";

/** "Object 2 ≥ 300", or its values: "120 to 300". */
export function layerName(page: Page, { tau, points }: Layer): string {
  if (tau === null) return `${value(points[0]?.value ?? 0)} to ${value(points.at(-1)?.value ?? 0)}`;
  const entry = entryAt(page, tau);
  const sign = page.polarity === "low" ? "≤" : "≥";
  return `${entry ? `${nameOf(page, page.entries.indexOf(entry))} ` : ""}${sign} ${value(tau)}`;
}

export class OpacityLayers {
  readonly element = html("span", { class: "legend", role: "group", "aria-label": "layers of the opacity curve" });
  private chips: HTMLElement[] = [];

  /** open: opens the editor. */
  constructor(
    private readonly page: Page,
    private readonly model: OpacityModel,
    private readonly open: () => void,
  ) {
    model.onSelect(() => this.show());
  }

  /** isOpen: is the editor open? Then the selected layer is marked. */
  show(isOpen = this.isOpen): void {
    this.isOpen = isOpen;
    const { layers, at } = this.model;
    while (this.chips.length < layers.length) this.chips.push(this.chip(this.chips.length));
    this.chips.forEach((chip, i) => {
      const layer = layers[i];
      if (!layer) return chip.remove();
      if (chip.parentNode !== this.element) this.element.append(chip);
      const [swatch, name] = chip.querySelectorAll("button");
      const title = layerName(this.page, layer);
      swatch?.setAttribute("aria-pressed", String(layer.visible));
      swatch?.setAttribute("aria-label", `show ${title}`);
      swatch?.setAttribute("title", layer.visible ? `hide ${title}` : `show ${title}`);
      chip.style.setProperty("--colour", colourOfLayer(layer));
      chip.classList.toggle("off", !layer.visible);
      if (isOpen && i === at) name?.setAttribute("aria-current", "true");
      else name?.removeAttribute("aria-current");
      if (name) name.textContent = title;
    });
  }
  private isOpen = false;

  private chip(i: number): HTMLElement {
    const toggle = (): void => this.model.changeLayer({ visible: !this.model.layers[i]?.visible }, "step", i);
    const pick = (): void => {
      this.model.select(i);
      this.open();
    };
    const swatch = html("button", { type: "button", class: "show", click: toggle }, html("span", { class: "swatch" }));
    return html(
      "span",
      { class: "chip" },
      swatch,
      html("button", { type: "button", class: "pick", title: "edit its opacity", click: pick }),
    );
  }
}
