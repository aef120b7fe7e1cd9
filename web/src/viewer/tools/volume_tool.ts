// Volume rendering, as `isoatlas render --volume`: the opacity curve is proposed from the tree, and can be edited.
import { html } from "../../shared/dom";
import { count } from "../../shared/format";
import type { ViewerContext } from "../context/viewer_context";
import { observePart } from "../context/observe";
import { Grid } from "../state/grid";
import { VolumeRenderer } from "../scene/volume_renderer";
import { hasUniformSpacing, voxelLength, VOLUME_CURVE, VOLUME_DENSITY } from "../state/volume_state";
import { transferTable } from "../api/transfer_function";
import { decodeVolume, type CoarseVolume } from "../api/wire_samples";
import { HiddenVolumeNote } from "./hidden_volume_note";
import { OpacityEditor } from "./opacity_editor";
import { OpacityLayers } from "./opacity_layers";
import { OpacityModel } from "./opacity_model";
import "./opacity.css";

/** requested resolution: volumes up to 256 x 256 x 256 are not reduced */
const MAX_VALUES = 1 << 24;

export class VolumeTool {
  private readonly slider = html("input", { type: "range", min: -4, max: 4, step: 0.1, "aria-label": "density of the volume" });
  private readonly about = html("span", { class: "soft about", role: "status" });
  private readonly edit = html(
    "button",
    { type: "button", "aria-expanded": "false", "aria-controls": "opacity-editor" },
    "Opacity curve",
  );
  private readonly bar: HTMLElement;
  /** below the 3D view, while the editor is open */
  private readonly dock = html("section", { class: "volume-dock", "aria-label": "opacity curve of the volume", hidden: true });
  private readonly model: OpacityModel;
  private readonly layers: OpacityLayers;
  private readonly editor: OpacityEditor;
  private isOpen = false;
  private renderer: Promise<VolumeRenderer | null> | null = null;
  private volume: CoarseVolume | null = null;

  constructor(
    private readonly context: ViewerContext,
    private readonly tools: HTMLElement,
  ) {
    const { history, actions, page, overlay } = context;
    this.model = new OpacityModel(context);
    this.editor = new OpacityEditor(context, this.model);
    this.layers = new OpacityLayers(page, this.model, () => this.open(true));
    const put = (transient: boolean) => (): void =>
      history.go(VOLUME_DENSITY.with(history.now, 2 ** Number(this.slider.value)), transient);
    this.slider.addEventListener("input", put(true));
    this.slider.addEventListener("change", put(false));
    this.edit.addEventListener("click", () => this.open(!this.isOpen));
    const close = html("button", { type: "button", "aria-label": "turn volume rendering off", click: () => this.toggle() }, "✕");
    const group = { class: "volume-bar", role: "group", "aria-label": "volume rendering", hidden: true };
    this.bar = html("div", group, html("span", {}, "Volume"), this.slider, this.edit, this.layers.element, this.about, close);
    tools.append(new HiddenVolumeNote(context).element, this.bar);
    overlay.append(this.dock);
    this.dock.append(this.editor.element);
    this.dock.addEventListener("keydown", (event) => this.escape(event));
    new ResizeObserver(() => overlay.style.setProperty("--dock", `${this.dock.offsetHeight}px`)).observe(this.dock);
    observePart(history, VOLUME_DENSITY, () => void this.show());
    observePart(history, VOLUME_CURVE, () => void this.show());
    const isOn = (): boolean => VOLUME_DENSITY.of(history.now) !== null;
    actions.add(
      { group: "View", name: "Volume rendering", keys: ["v"], run: () => this.toggle(), isOn },
      {
        group: "View",
        name: "Opacity curve of the volume",
        keys: ["V"],
        run: () => this.toggleEditor(),
        isOn: () => this.isOpen,
      },
    );
    context.api.connection.onChange(() => void this.show()); // the volume may be missing
  }

  private toggle(): void {
    const { history, page } = this.context;
    if (!hasUniformSpacing(page))
      return this.context.notify(
        "Volume rendering needs even steps between samples; this volume has uneven ones. Press k for slices.",
      );
    history.go(VOLUME_DENSITY.with(history.now, VOLUME_DENSITY.of(history.now) === null ? 1 : null));
  }

  /** Turns volume rendering on where it is off. */
  private toggleEditor(): void {
    const isOn = VOLUME_DENSITY.of(this.context.history.now) !== null;
    if (!isOn) this.toggle();
    if (VOLUME_DENSITY.of(this.context.history.now) !== null) this.open(!isOn || !this.isOpen);
  }

  /** The bar moves into the dock, and back. */
  private open(isOpen: boolean): void {
    const wasOpen = this.isOpen;
    this.isOpen = isOpen;
    const isOn = VOLUME_DENSITY.of(this.context.history.now) !== null;
    const isShown = isOpen && isOn;
    const focused = document.activeElement;
    this.dock.hidden = !isShown;
    const home = isShown ? this.dock : this.tools;
    if (this.bar.parentNode !== home) isShown ? home.prepend(this.bar) : home.append(this.bar);
    if (focused instanceof HTMLElement && this.bar.contains(focused)) focused.focus();
    this.context.overlay.classList.toggle("with-dock", isShown);
    this.edit.setAttribute("aria-expanded", String(isShown));
    this.layers.show(isShown);
    if (isShown) this.editor.show();
    if (isShown && !wasOpen) this.editor.focus();
  }

  private escape(event: KeyboardEvent): void {
    if (event.key !== "Escape") return;
    event.preventDefault();
    event.stopPropagation();
    this.open(false);
    this.edit.focus();
  }

  private async show(): Promise<void> {
    const { history, page } = this.context;
    if (!hasUniformSpacing(page)) return;
    const factor = VOLUME_DENSITY.of(history.now);
    this.bar.hidden = factor === null;
    if (factor !== null) this.slider.value = String(Math.log2(factor));
    this.open(this.isOpen && factor !== null);
    if (factor === null && !this.renderer) return;
    this.renderer ??= this.load();
    const renderer = await this.renderer;
    const now = VOLUME_DENSITY.of(history.now);
    renderer?.show(now === null ? null : this.table(), now ?? 1);
    this.layers.show();
    if (this.isOpen) this.editor.show();
  }

  private shown: { curve: unknown; table: Float32Array<ArrayBuffer> } | null = null;

  /** The same one for the same curve. */
  private table(): Float32Array<ArrayBuffer> | null {
    const curve = this.context.history.now.parts[VOLUME_CURVE.key];
    if (!this.volume) return null;
    if (this.shown?.curve !== curve || !this.shown)
      this.shown = {
        curve,
        table: transferTable(this.model.layers, this.volume.low, this.volume.high, voxelLength(this.context.page)),
      };
    return this.shown.table;
  }

  private async load(): Promise<VolumeRenderer | null> {
    const { api, page, viewport, proposal } = this.context;
    this.about.textContent = "loading the volume";
    try {
      const [samples] = await Promise.all([api.request(`/api/volume?max=${MAX_VALUES}`, "volume"), proposal.load()]);
      this.volume = decodeVolume(await samples.arrayBuffer());
      const { size, step } = this.volume;
      const means = step === 1 ? "every sample" : `means of ${step} × ${step} × ${step} samples`;
      this.about.textContent = `${size.map(count).join(" × ")}: ${means}, 8 bits each`;
      return new VolumeRenderer(viewport, new Grid(page), this.volume);
    } catch (error) {
      this.about.textContent = "";
      this.renderer = null;
      this.context.reportError(error);
      return null;
    }
  }
}
