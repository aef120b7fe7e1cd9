// Menus of the channels and time steps of a file of several: each volume has a page of its own.
import { html } from "../../shared/dom";
import type { Api, Volumes } from "../api/api";
import { EVERYTHING } from "../api/entries";
import { toHash } from "../state/address";
import { NOTHING, type State } from "../state/state";
import "./volume_menu.css";

/** What pages of other volumes understand of a state: the camera, and the whole isosurface. */
export function commonHash({ shown, view }: State): string {
  const whole = shown.filter(({ entry }) => entry === EVERYTHING);
  if (whole.length > 0) return toHash({ ...NOTHING, shown: whole, selected: 0, view });
  return view === null ? "" : `#camera=${view.map((n) => Number(n.toPrecision(7))).join(",")}`;
}

/** The camera of commonHash(); null: none. */
export function cameraOf(hash: string): number[] | null {
  const numbers = (new URLSearchParams(hash.replace(/^#/, "")).get("camera") ?? "").split(",").map(Number);
  return numbers.length === 6 && numbers.every(Number.isFinite) ? numbers : null;
}

/** "3 at 1.5 s" */
export function timeText({ times, time_unit: unit }: Volumes, step: number): string {
  const time = times[step];
  return time === undefined ? String(step) : `${step} at ${Number(time.toPrecision(7))}${unit === "" ? "" : ` ${unit}`}`;
}

export function channelText({ channels }: Volumes, channel: number): string {
  const name = channels[channel] ?? "";
  return name === "" ? `channel ${channel}` : name;
}

/** Path of the page of a volume, from that of any other one. */
export function pathOf(here: string, volume: number): string {
  return `${here.replace(/volume\/\d+\/$/, "")}volume/${volume}/`;
}

export class VolumeMenu {
  readonly element: HTMLElement;
  /** of the view that other volumes begin with */
  hash: () => string = () => "";
  private readonly channel: HTMLSelectElement;
  private readonly step: HTMLInputElement;
  private readonly time = html("output", {});

  /** null: the server has one volume. */
  static async of(api: Api): Promise<VolumeMenu | null> {
    if (api.isInFrame) return null; // its key is in this page alone
    const volumes = await api.volumes().catch(() => null); // the page says what is wrong with the connection
    return volumes && volumes.channels.length * volumes.time_steps > 1 ? new VolumeMenu(volumes) : null;
  }

  constructor(private readonly volumes: Volumes) {
    const { channels, time_steps: steps, volume } = volumes;
    const options = channels.map((_, i) => html("option", { value: i }, channelText(volumes, i)));
    this.channel = html("select", { "aria-label": "channel" }, ...options);
    this.channel.value = String(volume % channels.length);
    this.step = html("input", { type: "range", min: 0, max: steps - 1, step: 1, "aria-label": "time step" });
    this.step.value = String(Math.floor(volume / channels.length));
    this.channel.addEventListener("change", () => this.open());
    this.step.addEventListener("input", () => this.showTime());
    this.step.addEventListener("change", () => this.open());
    const ofTime = [this.button("previous time step", "‹", -1), this.step, this.button("next time step", "›", 1), this.time];
    this.element = html(
      "div",
      { class: "volume-menu", role: "group", "aria-label": "volumes of this file" },
      channels.length > 1 && html("label", {}, "Channel ", this.channel),
      steps > 1 && html("div", { class: "time" }, "Time ", ...ofTime),
    );
    this.showTime();
  }

  private button(name: string, sign: string, by: number): HTMLElement {
    const go = (): void => {
      const before = this.step.value;
      this.step.value = String(Number(before) + by);
      if (this.step.value !== before) this.open();
    };
    return html("button", { type: "button", "aria-label": name, title: name, click: go }, sign);
  }

  private showTime(): void {
    this.time.value = timeText(this.volumes, Number(this.step.value));
    this.step.setAttribute("aria-valuetext", this.time.value);
  }

  private open(): void {
    this.showTime();
    const volume = Number(this.channel.value) + Number(this.step.value) * this.volumes.channels.length;
    location.assign(pathOf(location.pathname, volume) + this.hash());
  }
}
