// The volume as glowing matter, as `isoatlas render --volume` draws it: which values are seen says the tree.
import { html } from "../../dom";
import { count, value } from "../../format";
import type { Page } from "../../page";
import type { Desk } from "../desk/desk";
import { follow } from "../desk/follow";
import { Grid } from "../state/grid";
import { MatterDrawing } from "../draw/matter_drawing";
import { isEven, MATTER } from "../state/matter_state";
import { transferTable, type Bump } from "../ask/transfer";
import { decodeVolume, type CoarseVolume } from "../ask/wire_samples";

/** values asked for: 256 x 256 x 256 come whole */
const MOST_VALUES = 1 << 24;

export class MatterPanel {
  private readonly slider = html("input", { type: "range", min: -4, max: 4, step: 0.1, "aria-label": "density of the volume" });
  private readonly legend = html("span", { class: "legend" });
  private readonly about = html("span", { class: "soft", role: "status" });
  private readonly element = html("div", { class: "matter-bar", role: "group", "aria-label": "the volume as matter", hidden: true });
  private drawing: Promise<MatterDrawing | null> | null = null;
  private table: Float32Array<ArrayBuffer> | null = null;

  constructor(
    private readonly desk: Desk,
    tools: HTMLElement,
  ) {
    const { history, actions } = desk;
    const put = (transient: boolean) => (): void => history.go(MATTER.in(history.now, 2 ** Number(this.slider.value)), transient);
    this.slider.addEventListener("input", put(true));
    this.slider.addEventListener("change", put(false));
    const close = html("button", { type: "button", "aria-label": "do not draw the volume", click: () => this.toggle() }, "✕");
    this.element.append(html("span", {}, "Volume"), this.slider, this.legend, this.about, close);
    tools.append(this.element);
    follow(history, MATTER, (factor) => void this.show(factor));
    const isOn = (): boolean => MATTER.of(history.now) !== null;
    actions.add({ group: "Look", name: "the volume as glowing matter", keys: ["v"], run: () => this.toggle(), isOn });
  }

  private toggle(): void {
    const { history, page } = this.desk;
    if (!isEven(page))
      return this.desk.say("The steps between its samples are uneven: such a volume is not drawn as matter. Its slices are: k.");
    history.go(MATTER.in(history.now, MATTER.of(history.now) === null ? 1 : null));
  }

  private async show(factor: number | null): Promise<void> {
    if (!isEven(this.desk.page)) return;
    this.element.hidden = factor === null;
    if (factor !== null) this.slider.value = String(Math.log2(factor));
    if (factor === null && !this.drawing) return;
    this.drawing ??= this.load();
    const drawing = await this.drawing;
    const now = MATTER.of(this.desk.history.now);
    drawing?.show(now === null ? null : this.table, now ?? 1);
  }

  private async load(): Promise<MatterDrawing | null> {
    const { api, page, stage } = this.desk;
    this.about.textContent = "the volume is being read";
    try {
      const [volume, bumps] = await Promise.all([
        api.ask(`/api/volume?most=${MOST_VALUES}`, "volume").then(async (answer) => decodeVolume(await answer.arrayBuffer())),
        api.ask("/api/transfer", "transfer").then(async (answer) => colouredAs(page, ((await answer.json()) as { bumps: Bump[] }).bumps)),
      ]);
      this.table = transferTable(bumps, volume.low, volume.high);
      this.tell(volume, bumps);
      return new MatterDrawing(stage, new Grid(page), volume);
    } catch (error) {
      this.about.textContent = "";
      this.drawing = null;
      this.desk.fail(error);
      return null;
    }
  }

  private tell({ size, step }: CoarseVolume, bumps: Bump[]): void {
    const skins = bumps.filter((bump, i) => bumps.findIndex(({ tau }) => tau === bump.tau) === i);
    const item = ({ tau, colour }: Bump): HTMLElement =>
      html("span", {}, html("span", { class: "swatch", style: `background:${colour}` }), ` above ${value(tau)}`);
    this.legend.replaceChildren(...skins.map(item));
    const means = step === 1 ? "every sample" : `means of ${step} × ${step} × ${step} samples`;
    this.about.textContent = `${size.map(count).join(" × ")}: ${means}, 8 bits each`;
  }
}

/** In the colours of the objects that they show. */
export function colouredAs(page: Page, bumps: readonly Bump[]): Bump[] {
  const near = 1e-6 * (page.axis.high - page.axis.low);
  return bumps.map((bump) => ({
    ...bump,
    colour: page.entries.find(({ tau }) => Math.abs(tau - bump.tau) <= near)?.colour ?? bump.colour,
  }));
}
