// The isovalue of what is selected: dragged, typed, stepped, played; where something happens; what its surface will be before it is made.
import { Axis } from "../../axis";
import { html } from "../../dom";
import { value } from "../../format";
import { badgeOf } from "./badge";
import type { Desk } from "../desk/desk";
import { eventNear, eventsOf, type Event } from "../state/events";
import { HistogramPlot } from "./histogram_plot";
import { Latest } from "../ask/latest";
import { Player, SPEEDS } from "./play";
import { within } from "../ask/shown";
import type { Shown, State } from "../state/state";
import { DELTA, deltaOf } from "./stepping";

/** of the slider */
const STEPS = 10_000;
/** pixels to either side of a tick */
const REACH = 6;

export class AxisPanel {
  readonly element: HTMLElement;
  readonly player: Player;
  /** along the slider */
  private readonly axis: Axis;
  private readonly events: Event[];
  private readonly plot: HistogramPlot;
  private readonly box = html("input", { type: "text", inputmode: "decimal", "aria-label": "isovalue" });
  private readonly step = html("input", {
    type: "text",
    inputmode: "decimal",
    class: "step",
    "aria-label": "step",
    title: "how much [ and ] change the isovalue",
  });
  private readonly badge = html("output", { class: "badge" });
  private readonly slider = html("input", { type: "range", min: 0, max: STEPS, "aria-label": "isovalue, on the histogram" });
  private readonly tip = html("div", { class: "tip", role: "tooltip", hidden: true });
  private readonly back = html("button", { type: "button", class: "plain", click: () => this.player.toggle(-1) });
  private readonly forth = html("button", { type: "button", class: "plain", click: () => this.player.toggle(1) });
  private readonly foresight: Latest<Shown>;

  constructor(private readonly desk: Desk) {
    const { page, editor } = desk;
    this.axis = Axis.of(page, STEPS, 0);
    this.events = eventsOf(page);
    this.plot = new HistogramPlot(page, this.events);
    this.player = new Player(desk, () => this.sayWay());
    this.foresight = new Latest((shown) => this.foresee(shown));
    this.slider.addEventListener("input", () => editor.move(this.tauOf(Number(this.slider.value)), true));
    this.slider.addEventListener("change", () => editor.move(this.tauOf(Number(this.slider.value))));
    this.box.addEventListener("change", () => this.commit());
    this.step.addEventListener("change", () => this.commitStep());
    const unit = page.volume.valueUnit ? ` ${page.volume.valueUnit}` : "";
    const line = html(
      "div",
      { class: "line" },
      html("label", {}, "isovalue ", this.box, unit),
      html("label", {}, "step ", this.step),
      this.controls(),
      this.badge,
    );
    const drawn = html("div", { class: "drawn" }, this.plot.element, this.slider, this.tip);
    drawn.addEventListener("pointermove", (event) => this.point(event, drawn));
    drawn.addEventListener("pointerleave", () => (this.tip.hidden = true));
    this.element = html("section", { class: "axis", "aria-label": "isovalue" }, line, drawn);
    this.sayWay();
    this.addActions();
  }

  show(state: State): void {
    const shown = state.shown[state.selected];
    this.element.classList.toggle("idle", !shown);
    this.step.value = String(deltaOf(this.desk.page, state));
    this.plot.show(state);
    if (!shown) return;
    this.box.value = String(Number(shown.tau.toPrecision(7)));
    this.slider.value = String(Math.round(this.axis.x(shown.tau)));
    this.slider.setAttribute("aria-valuetext", value(shown.tau));
    this.foresight.want(shown, `${shown.entry} ${shown.tau}`);
  }

  private controls(): HTMLElement {
    const speed = html(
      "select",
      { "aria-label": "speed" },
      ...SPEEDS.map((n) => html("option", { value: n, selected: n === this.player.speed }, `${n} steps/s`)),
    );
    speed.addEventListener("change", () => (this.player.speed = Number(speed.value)));
    return html("span", { class: "play", role: "group", "aria-label": "play" }, this.back, this.forth, speed);
  }

  private sayWay(): void {
    for (const [button, way, sign, word] of [
      [this.back, -1, "◀", "play downwards"],
      [this.forth, 1, "▶", "play upwards"],
    ] as const) {
      const plays = this.player.way === way;
      button.textContent = plays ? "❚❚" : sign;
      button.setAttribute("aria-label", plays ? "pause" : word);
      button.title = button.getAttribute("aria-label") ?? "";
    }
  }

  private addActions(): void {
    const play = (way: 1 | -1) => (): void => this.player.toggle(way);
    this.desk.actions.add(
      { group: "Isovalue", name: "play upwards, or pause", keys: ["p"], run: play(1), isOn: () => this.player.way === 1 },
      { group: "Isovalue", name: "play downwards, or pause", keys: ["P"], run: play(-1), isOn: () => this.player.way === -1 },
    );
  }

  private async foresee(shown: Shown): Promise<void> {
    try {
      this.badge.textContent = await badgeOf(this.desk, shown);
    } catch (error) {
      this.desk.fail(error);
    }
  }

  /** What happens at the tick under the pointer. */
  private point(event: PointerEvent, drawn: HTMLElement): void {
    const near = eventNear(this.events, (tau) => this.plot.x(tau), event.clientX - drawn.getBoundingClientRect().left, REACH);
    this.tip.hidden = !near;
    if (!near) return;
    const at = this.plot.x(near.tau) / drawn.clientWidth;
    this.tip.textContent = near.text;
    this.tip.style.left = `${100 * at}%`;
    this.tip.style.transform = `translateX(${-100 * at}%)`;
  }

  private tauOf(step: number): number {
    return Number(this.axis.tau(step).toPrecision(7));
  }

  private commit(): void {
    const tau = numberIn(this.box);
    if (tau !== null) this.desk.editor.move(within(this.desk.page, tau));
    this.show(this.desk.history.now);
  }

  private commitStep(): void {
    const { history } = this.desk;
    const delta = numberIn(this.step);
    if (delta === null || delta > 0) history.go(DELTA.in(history.now, delta));
    this.show(history.now);
  }
}

function numberIn(box: HTMLInputElement): number | null {
  const number = Number(box.value.replace(",", "."));
  return box.value.trim() !== "" && Number.isFinite(number) ? number : null;
}
