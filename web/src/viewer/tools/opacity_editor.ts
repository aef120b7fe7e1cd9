// The editor of the opacity curve: plot, fields of the selected point, the selected layer, presets.
import { html } from "../../shared/dom";
import { length, value } from "../../shared/format";
import type { ViewerContext } from "../context/viewer_context";
import { highestOpacity, MAX_OPACITY, shortNumber } from "../state/opacity_curve";
import { voxelLength } from "../state/volume_state";
import type { OpacityModel } from "./opacity_model";
import { OpacityPlot } from "./opacity_plot";
import { presetsOf } from "./opacity_presets";

/** lowest opacity of the slider of a layer: 0 could not be scaled back */
const MIN_OPACITY = 0.001;

const HINT =
  "Drag a point; a press on the curve or a double click adds one. Keys: arrows, with shift in larger steps, Insert, Delete.";

export class OpacityEditor {
  private readonly plot: OpacityPlot;
  private readonly value = field("value of the point");
  private readonly opacity = field("opacity of a voxel at the point, 0 to 0.999");
  private readonly colour = html("input", { type: "color", "aria-label": "colour of the point" });
  private readonly layerOpacity = html("input", {
    type: "range",
    min: 0,
    max: 1,
    step: 0.005,
    "aria-label": "opacity of the layer",
  });
  private readonly only = html("button", { type: "button", class: "only" });
  private readonly presets = html("div", { class: "presets", role: "group", "aria-label": "presets of the opacity curve" });
  private readonly voxel = html("span", { class: "soft thick" });
  readonly element: HTMLElement;

  constructor(
    private readonly context: ViewerContext,
    private readonly model: OpacityModel,
  ) {
    this.plot = new OpacityPlot(context.page, model, (text) => context.notify(text));
    const button = (name: string, title: string, click: () => void): HTMLElement =>
      html("button", { type: "button", title, click }, name);
    const point = html(
      "div",
      { class: "fields", role: "group", "aria-label": "selected point" },
      html("label", {}, "Value ", this.value),
      html("label", {}, "Opacity ", this.opacity),
      this.colour,
      button("Add", "between this point and the next one (Insert)", () => this.plot.addBeside()),
      button("Remove", "remove this point (Delete)", () => this.plot.remove()),
      this.voxel,
    );
    const layer = html(
      "div",
      { class: "fields", role: "group", "aria-label": "selected layer" },
      html("label", {}, "Layer ", this.layerOpacity),
      this.only,
    );
    const hint = html("p", { id: "opacity-hint", class: "soft hint" }, HINT);
    this.element = html(
      "div",
      { class: "opacity-editor", id: "opacity-editor" },
      this.plot.element,
      html("div", { class: "lines" }, point, layer, this.presets),
      hint,
    );
    this.listen();
    model.onSelect(() => this.show());
    context.history.listen(() => !this.element.hidden && this.showPresets()); // they depend on window and selection
  }

  show(): void {
    this.plot.show();
    const point = this.model.selectedPoint;
    const layer = this.model.selected;
    if (!point || !layer) return;
    const put = (input: HTMLInputElement, text: string): void => {
      if (input.value !== text) input.value = text;
    };
    put(this.value, shortNumber(point.value));
    put(this.opacity, value(point.opacity));
    put(this.colour, point.colour);
    const highest = highestOpacity(layer.points);
    put(this.layerOpacity, String(Math.sqrt(highest)));
    this.layerOpacity.setAttribute("aria-valuetext", `opacity ${value(highest)} where it is densest`);
    const isAlone = this.model.layers.every(({ visible }, i) => visible === (i === this.model.at));
    this.only.textContent = isAlone ? "Show all layers" : "Only this layer";
    this.only.hidden = this.model.layers.length < 2;
    const { page } = this.context;
    this.voxel.textContent = page.volume.unit === null ? "of a voxel" : `of a voxel, ${length(voxelLength(page), page.volume.unit)} thick`;
    this.showPresets();
  }

  focus(): void {
    this.plot.focusPoint();
  }

  private listen(): void {
    this.value.addEventListener("change", () => this.type(this.value, (typed, point) => this.model.move(typed, point.opacity)));
    this.opacity.addEventListener("change", () => this.type(this.opacity, (typed, point) => this.model.move(point.value, typed)));
    this.colour.addEventListener("input", () => this.model.colour(this.colour.value, "drag"));
    this.colour.addEventListener("change", () => this.model.finish());
    const scale = (): void =>
      this.model.setOpacity(Math.min(Math.max(Number(this.layerOpacity.value) ** 2, MIN_OPACITY), MAX_OPACITY), "drag");
    this.layerOpacity.addEventListener("input", scale);
    this.layerOpacity.addEventListener("change", () => this.model.finish());
    this.only.addEventListener("click", () => this.model.showOnly());
  }

  /** What does not fit is replaced by what is nearest, and said. */
  private type(input: HTMLInputElement, put: (typed: number, point: { value: number; opacity: number }) => void): void {
    const point = this.model.selectedPoint;
    const typed = Number(input.value);
    if (!point) return;
    if (input.value.trim() === "" || !Number.isFinite(typed))
      this.context.notify(`"${input.value}" is not a number; the point stays where it is.`);
    else put(typed, point);
    this.show();
    const now = this.model.selectedPoint;
    const got = input === this.value ? now?.value : now?.opacity;
    if (Number.isFinite(typed) && got !== undefined && Math.abs(got - typed) > 1e-6 * Math.abs(typed))
      this.context.notify(
        input === this.value
          ? `The point stays between its neighbours and within the values of the volume: ${value(got)}.`
          : `An opacity is from 0 to ${MAX_OPACITY}: ${value(got)}.`,
      );
  }

  private showPresets(): void {
    const { page, history } = this.context;
    const presets = presetsOf(page, history.now);
    const names = ["Proposal", ...presets.map(({ name }) => name)];
    const buttons = [...this.presets.querySelectorAll("button")];
    if (buttons.map(({ textContent }) => textContent).join() === names.join()) return this.markProposal(buttons[0]);
    const button = (name: string, title: string, run: () => void): HTMLButtonElement =>
      html("button", { type: "button", title, click: run }, name);
    const put = (name: string) => (): void => {
      const now = presetsOf(page, history.now).find((preset) => preset.name === name);
      if (now) this.model.put(now.layers);
    };
    const proposal = button(names[0]!, "reset to what the tree of objects proposes", () => this.model.put(null));
    this.presets.replaceChildren(proposal, ...presets.map(({ name, title }) => button(name, title, put(name))));
    this.markProposal(proposal);
  }

  private markProposal(button: HTMLButtonElement | undefined): void {
    button?.setAttribute("aria-pressed", String(this.model.isProposal));
  }
}

function field(label: string): HTMLInputElement {
  return html("input", { type: "text", inputmode: "decimal", "aria-label": label, autocomplete: "off" });
}
