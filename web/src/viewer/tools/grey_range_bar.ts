// The window of slices: presets, level and width, and the values shown as black and white.
import { Axis } from "../../shared/axis";
import { html } from "../../shared/dom";
import { value } from "../../shared/format";
import type { Page } from "../../shared/page";
import { selectedOf, type ViewerContext } from "../context/viewer_context";
import { coalesce, observePart } from "../context/observe";
import { GREY, greyRange, SLICES } from "../state/slice_state";
import type { State } from "../state/state";
import { boundedGrey, presetGroups, presetOf, windowOf, type Grey, type PresetGroup, type Window } from "../state/window_presets";

/** of a slider */
const STEPS = 1000;
/** option of a window without a name */
const CUSTOM = "Custom";
/** of keys: factor of the width, and part of the width by which the level moves */
const [WIDER, LEVEL_STEP] = [1.1, 0.05];

/** Values of black and white now. */
export function greyOfState(page: Page, state: State): Grey {
  return (GREY.of(state) as Grey | null) ?? greyRange(page);
}

export class GreyRangeBar {
  readonly element: HTMLElement;
  private readonly select = html("select", { "aria-label": "window" });
  private readonly level = numberBox("level");
  private readonly width = numberBox("width");
  private readonly black = slider("black value");
  private readonly white = slider("white value");
  private readonly axis: Axis;
  private groups: PresetGroup[] = [];
  private readonly coalesce: (state: State) => void;

  constructor(private readonly context: ViewerContext) {
    const { page, history } = context;
    this.axis = Axis.of(page, STEPS, 0);
    this.coalesce = coalesce(history);
    const labelled = (name: string, input: HTMLElement): HTMLElement => html("label", {}, html("span", { class: "soft" }, name), input);
    this.element = html(
      "div",
      { class: "grey", role: "group", "aria-label": "grey range" },
      this.select,
      labelled("level", this.level),
      labelled("width", this.width),
      html("span", { class: "ends" }, labelled("black", this.black), labelled("white", this.white)),
    );
    this.listen();
    this.addActions();
  }

  /** Sets the window, within what can be shown. transient: during a drag. */
  setWindow(window: Window, transient: boolean): void {
    const { page, history } = this.context;
    history.go(GREY.with(history.now, boundedGrey(window, page)), transient);
  }

  get window(): Window {
    return windowOf(greyOfState(this.context.page, this.context.history.now));
  }

  private listen(): void {
    const { history } = this.context;
    for (const input of [this.black, this.white]) {
      input.addEventListener("input", () => this.slide(true));
      input.addEventListener("change", () => this.slide(false));
    }
    for (const input of [this.level, this.width]) input.addEventListener("change", () => this.type());
    this.select.addEventListener("input", () => {
      const preset = this.groups.flatMap(({ presets }) => presets).find(({ name }) => name === this.select.value);
      if (preset) this.coalesce(GREY.with(history.now, preset.grey)); // arrow keys pass others
    });
    observePart(history, GREY, () => this.show());
    history.listen((state, before) => {
      if (state.shown !== before.shown || state.selected !== before.selected) this.show(); // "around the isovalue"
    });
  }

  private slide(transient: boolean): void {
    const { history } = this.context;
    const [black, white] = [this.axis.tau(Number(this.black.value)), this.axis.tau(Number(this.white.value))];
    if (black < white) history.go(GREY.with(history.now, [black, white]), transient);
    else this.show();
  }

  private type(): void {
    const now = this.window;
    const typed = (input: HTMLInputElement, before: number): number =>
      input.value === value(before) ? before : input.value.trim() === "" ? NaN : Number(input.value);
    const [level, width] = [typed(this.level, now.level), typed(this.width, now.width)];
    if (Number.isFinite(level) && width > 0) this.setWindow({ level, width }, false);
    else this.context.notify("the level of a window is a number, its width a number above 0");
    this.show();
  }

  private show(): void {
    const { page, history } = this.context;
    const [black, white] = greyOfState(page, history.now);
    this.black.value = String(Math.round(this.axis.x(black)));
    this.white.value = String(Math.round(this.axis.x(white)));
    this.black.setAttribute("aria-valuetext", value(black));
    this.white.setAttribute("aria-valuetext", value(white));
    const { level, width } = windowOf([black, white]);
    this.level.value = value(level);
    this.width.value = value(width);
    this.level.step = this.width.step = String(10 ** Math.floor(Math.log10(width / 20)));
    this.showPresets();
  }

  private showPresets(): void {
    const { page, history } = this.context;
    this.groups = presetGroups(page, selectedOf(history.now)?.tau ?? null);
    const chosen = presetOf(this.groups, GREY.of(history.now))?.name ?? CUSTOM;
    const options = this.groups.map(({ title, presets }) => {
      const words = (grey: Grey | null): string => (title === "" || !grey ? "" : ` ${wordsOf(grey)}`);
      const own = presets.map(({ name, grey }) => html("option", { value: name }, name + words(grey)));
      return title === "" ? own : [html("optgroup", { label: title }, ...own)];
    });
    const custom = html("option", { value: CUSTOM, hidden: chosen !== CUSTOM }, CUSTOM);
    this.select.replaceChildren(...options.flat(), custom);
    this.select.value = chosen;
  }

  private addActions(): void {
    const { actions, history, page } = this.context;
    const by = (factor: number, steps: number) => (): void => {
      const { level, width } = this.window;
      const window = { level: level + steps * LEVEL_STEP * width, width: width * factor };
      this.coalesce(GREY.with(history.now, boundedGrey(window, page)));
    };
    actions.add(
      { group: "Tools", name: "Window presets", keys: ["W"], run: () => this.choose() },
      { group: "Tools", name: "Window narrower: more contrast", keys: ["-"], run: by(1 / WIDER, 0) },
      { group: "Tools", name: "Window wider: less contrast", keys: ["="], run: by(WIDER, 0) },
      { group: "Tools", name: "Window level lower: brighter", keys: [";"], run: by(1, -1) },
      { group: "Tools", name: "Window level higher: darker", keys: ["'"], run: by(1, 1) },
    );
  }

  private choose(): void {
    const { history } = this.context;
    if (!SLICES.of(history.now)) history.go(SLICES.with(history.now, true));
    this.select.focus();
    this.context.notify("choose a window of the slices with the arrow keys");
  }
}

function slider(label: string): HTMLInputElement {
  return html("input", { type: "range", min: 0, max: STEPS, "aria-label": label });
}

function numberBox(label: string): HTMLInputElement {
  return html("input", { type: "number", step: "any", "aria-label": `${label} of the window` });
}

function wordsOf(grey: Grey): string {
  const { level, width } = windowOf(grey);
  return `(W ${value(width)}, L ${value(level).replace("-", "−")})`;
}
