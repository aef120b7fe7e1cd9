// Isovalue of the selected object: slider, text field, steps, player; ticks of events; estimate of the surface.
import { Axis } from "../../shared/axis";
import { html } from "../../shared/dom";
import { value } from "../../shared/format";
import { badgeOf } from "./surface_estimate";
import type { ViewerContext } from "../context/viewer_context";
import { eventNear, eventsOf, type Event } from "../state/events";
import { HistogramPlot } from "./histogram_plot";
import { Latest } from "../api/latest";
import { Player, SPEEDS } from "./player";
import { within } from "../api/entries";
import type { Shown, State } from "../state/state";
import { DELTA, deltaOf } from "./isovalue_steps";

/** of the slider */
const STEPS = 10_000;
/** pixels to either side of a tick */
const REACH = 6;

export class IsovaluePanel {
  readonly element: HTMLElement;
  readonly player: Player;
  /** axis of the slider */
  private readonly axis: Axis;
  private readonly events: Event[];
  private readonly plot: HistogramPlot;
  private readonly box = html("input", { type: "text", inputmode: "decimal", "aria-label": "isovalue" });
  private readonly step = html("input", {
    type: "text",
    inputmode: "decimal",
    class: "step",
    "aria-label": "step",
    title: "step of the keys [ and ]",
  });
  private readonly badge = html("output", { class: "badge" });
  private readonly slider = html("input", { type: "range", min: 0, max: STEPS, "aria-label": "isovalue, on the histogram" });
  private readonly tip = html("div", { class: "tip", role: "tooltip", hidden: true });
  private readonly back = html("button", { type: "button", class: "plain", click: () => this.player.toggle(-1) });
  private readonly forth = html("button", { type: "button", class: "plain", click: () => this.player.toggle(1) });
  private readonly estimator: Latest<Shown>;

  constructor(private readonly context: ViewerContext) {
    const { page, editor } = context;
    this.axis = Axis.of(page, STEPS, 0);
    this.events = eventsOf(page);
    this.plot = new HistogramPlot(page, this.events);
    this.player = new Player(context, () => this.showDirection());
    this.estimator = new Latest((shown) => this.estimate(shown));
    this.slider.addEventListener("input", () => editor.setIsovalue(this.tauOf(Number(this.slider.value)), true));
    this.slider.addEventListener("change", () => editor.setIsovalue(this.tauOf(Number(this.slider.value))));
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
    this.showDirection();
    this.addActions();
  }

  show(state: State): void {
    const shown = state.shown[state.selected];
    for (const control of [this.box, this.slider, this.back, this.forth]) control.disabled = !shown;
    this.step.value = String(deltaOf(this.context.page, state));
    this.plot.show(state);
    if (!shown) return this.clear();
    this.box.value = String(Number(shown.tau.toPrecision(7)));
    this.slider.value = String(Math.round(this.axis.x(shown.tau)));
    this.slider.setAttribute("aria-valuetext", value(shown.tau));
    this.estimator.request(shown, `${shown.entry} ${shown.tau} ${this.context.api.connection.count}`);
  }

  /** Nothing is selected: there is no isovalue to tell, and nothing to count. */
  private clear(): void {
    this.player.stop();
    this.box.value = "";
    this.badge.textContent = "";
    this.slider.removeAttribute("aria-valuetext");
    this.estimator.forget();
  }

  private controls(): HTMLElement {
    const speed = html(
      "select",
      { "aria-label": "speed" },
      ...SPEEDS.map((n) => html("option", { value: n, selected: n === this.player.speed }, `${n} steps/s`)),
    );
    speed.addEventListener("change", () => (this.player.speed = Number(speed.value)));
    return html("span", { class: "play", role: "group", "aria-label": "play" }, html("span", {}, "play"), this.back, this.forth, speed);
  }

  private showDirection(): void {
    for (const [button, direction, sign, word, what] of [
      [this.back, -1, "◀", "play downwards", "lower the isovalue step by step (P)"],
      [this.forth, 1, "▶", "play upwards", "raise the isovalue step by step (p)"],
    ] as const) {
      const plays = this.player.direction === direction;
      button.textContent = plays ? "❚❚" : sign;
      button.setAttribute("aria-label", plays ? "pause" : word);
      button.title = plays ? "pause" : `${word}: ${what}`;
    }
  }

  private addActions(): void {
    const play = (direction: 1 | -1) => (): void => this.player.toggle(direction);
    this.context.actions.add(
      { group: "Isovalue", name: "Play upwards, or pause", keys: ["p"], run: play(1), isOn: () => this.player.direction === 1 },
      { group: "Isovalue", name: "Play downwards, or pause", keys: ["P"], run: play(-1), isOn: () => this.player.direction === -1 },
    );
  }

  private async estimate(shown: Shown): Promise<void> {
    try {
      const text = await badgeOf(this.context, shown);
      if (this.context.editor.selected) this.badge.textContent = text;
    } catch (error) {
      this.context.reportError(error);
    }
  }

  /** Shows the event at the tick under the pointer. */
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
    if (tau !== null) this.context.editor.setIsovalue(within(this.context.page, tau));
    this.show(this.context.history.now);
  }

  private commitStep(): void {
    const { history } = this.context;
    const delta = numberIn(this.step);
    if (delta === null || delta > 0) history.go(DELTA.with(history.now, delta));
    this.show(history.now);
  }
}

function numberIn(box: HTMLInputElement): number | null {
  const number = Number(box.value.replace(",", "."));
  return box.value.trim() !== "" && Number.isFinite(number) ? number : null;
}
