// Opaque surfaces hide the matter behind them, so that volume rendering may seem to do nothing: says so, and offers remedies.
// Decision 44 says why surfaces stay as they are until one of them is chosen.
import { html } from "../../shared/dom";
import type { ViewerContext } from "../context/viewer_context";
import { SEE_THROUGH } from "../state/see_through";
import { changeAll, type Shown, type State } from "../state/state";
import { VOLUME_DENSITY } from "../state/volume_state";

/** Surfaces behind which nothing is seen. */
export function opaqueOf({ shown }: Pick<State, "shown">): Shown[] {
  return shown.filter(({ visible, opacity }) => visible && opacity === 1);
}

/** Opaque surfaces turn transparent; the others stay. */
export function madeTransparent(state: State): State {
  return {
    ...state,
    shown: state.shown.map((one) => (one.visible && one.opacity === 1 ? { ...one, opacity: SEE_THROUGH } : one)),
  };
}

export class HiddenVolumeNote {
  private readonly text = html("span", { role: "status" });
  readonly element: HTMLElement;
  private isDismissed = false;

  constructor(private readonly context: ViewerContext) {
    const { history } = context;
    const button = (name: string, run: () => void): HTMLElement => html("button", { type: "button", click: run }, name);
    this.element = html(
      "div",
      { class: "volume-note", role: "group", "aria-label": "surfaces hide the volume", hidden: true },
      this.text,
      button("Hide surfaces", () => history.go(changeAll(history.now, { visible: false }))),
      button("Make transparent", () => history.go(madeTransparent(history.now))),
      html("button", { type: "button", "aria-label": "leave the surfaces as they are", click: () => this.dismiss() }, "✕"),
    );
    history.listen((state) => this.show(state));
    this.show(history.now);
  }

  private dismiss(): void {
    this.isDismissed = true;
    this.show(this.context.history.now);
  }

  private show(state: State): void {
    const isOn = VOLUME_DENSITY.of(state) !== null;
    if (!isOn) this.isDismissed = false;
    const count = isOn && !this.isDismissed ? opaqueOf(state).length : 0;
    this.element.hidden = count === 0;
    this.text.textContent =
      count === 0 ? "" : `${count === 1 ? "An opaque surface hides" : "Opaque surfaces hide"} the volume behind.`;
  }
}
