// Volume rendering, as `isoatlas render --volume`: the transfer function is proposed from the tree.
import { html } from "../../shared/dom";
import { count, value } from "../../shared/format";
import type { Page } from "../../shared/page";
import type { ViewerContext } from "../context/viewer_context";
import { observePart } from "../context/observe";
import { Grid } from "../state/grid";
import { VolumeRenderer } from "../scene/volume_renderer";
import { hasUniformSpacing, VOLUME_DENSITY } from "../state/volume_state";
import { transferTable, type OpacityTent } from "../api/transfer_function";
import { decodeVolume, type CoarseVolume } from "../api/wire_samples";

/** requested resolution: volumes up to 256 x 256 x 256 are not reduced */
const MAX_VALUES = 1 << 24;

export class VolumeTool {
  private readonly slider = html("input", { type: "range", min: -4, max: 4, step: 0.1, "aria-label": "density of the volume" });
  private readonly legend = html("span", { class: "legend" });
  private readonly about = html("span", { class: "soft", role: "status" });
  private readonly element = html("div", { class: "volume-bar", role: "group", "aria-label": "volume rendering", hidden: true });
  private renderer: Promise<VolumeRenderer | null> | null = null;
  private table: Float32Array<ArrayBuffer> | null = null;

  constructor(
    private readonly context: ViewerContext,
    tools: HTMLElement,
  ) {
    const { history, actions } = context;
    const put = (transient: boolean) => (): void => history.go(VOLUME_DENSITY.with(history.now, 2 ** Number(this.slider.value)), transient);
    this.slider.addEventListener("input", put(true));
    this.slider.addEventListener("change", put(false));
    const close = html("button", { type: "button", "aria-label": "turn volume rendering off", click: () => this.toggle() }, "✕");
    this.element.append(html("span", {}, "Volume"), this.slider, this.legend, this.about, close);
    tools.append(this.element);
    observePart(history, VOLUME_DENSITY, (factor) => void this.show(factor));
    const isOn = (): boolean => VOLUME_DENSITY.of(history.now) !== null;
    actions.add({ group: "View", name: "Volume rendering", keys: ["v"], run: () => this.toggle(), isOn });
    context.api.connection.onChange(() => void this.show(VOLUME_DENSITY.of(history.now))); // the volume may be missing
  }

  private toggle(): void {
    const { history, page } = this.context;
    if (!hasUniformSpacing(page))
      return this.context.notify("Volume rendering needs even steps between samples; this volume has uneven ones. Press k for slices.");
    history.go(VOLUME_DENSITY.with(history.now, VOLUME_DENSITY.of(history.now) === null ? 1 : null));
  }

  private async show(factor: number | null): Promise<void> {
    if (!hasUniformSpacing(this.context.page)) return;
    this.element.hidden = factor === null;
    if (factor !== null) this.slider.value = String(Math.log2(factor));
    if (factor === null && !this.renderer) return;
    this.renderer ??= this.load();
    const renderer = await this.renderer;
    const now = VOLUME_DENSITY.of(this.context.history.now);
    renderer?.show(now === null ? null : this.table, now ?? 1);
  }

  private async load(): Promise<VolumeRenderer | null> {
    const { api, page, viewport } = this.context;
    this.about.textContent = "loading the volume";
    try {
      const responses = [api.request(`/api/volume?max=${MAX_VALUES}`, "volume"), api.request("/api/transfer", "transfer")] as const;
      const [samples, transfer] = await Promise.all(responses);
      const volume = decodeVolume(await samples.arrayBuffer());
      const tents = colouredAs(page, ((await transfer.json()) as { tents: OpacityTent[] }).tents);
      this.table = transferTable(tents, volume.low, volume.high);
      this.describe(volume, tents);
      return new VolumeRenderer(viewport, new Grid(page), volume);
    } catch (error) {
      this.about.textContent = "";
      this.renderer = null;
      this.context.reportError(error);
      return null;
    }
  }

  private describe({ size, step }: CoarseVolume, tents: OpacityTent[]): void {
    const uniqueTents = tents.filter((tent, i) => tents.findIndex(({ tau }) => tau === tent.tau) === i);
    const side = this.context.page.polarity === "low" ? "below" : "above";
    const item = ({ tau, colour }: OpacityTent): HTMLElement =>
      html("span", {}, html("span", { class: "swatch", style: `background:${colour}` }), ` ${side} ${value(tau)}`);
    this.legend.replaceChildren(...uniqueTents.map(item));
    const means = step === 1 ? "every sample" : `means of ${step} × ${step} × ${step} samples`;
    this.about.textContent = `${size.map(count).join(" × ")}: ${means}, 8 bits each`;
  }
}

/** Uses the colours of the entries at the same isovalues. */
export function colouredAs(page: Page, tents: readonly OpacityTent[]): OpacityTent[] {
  const near = 1e-6 * (page.axis.high - page.axis.low);
  return tents.map((tent) => ({
    ...tent,
    colour: page.entries.find(({ tau }) => Math.abs(tau - tent.tau) <= near)?.colour ?? tent.colour,
  }));
}
