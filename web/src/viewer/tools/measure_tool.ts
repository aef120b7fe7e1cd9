// Measures distances and angles: positions are clicked on surfaces and slices, or taken from the crosshair.
import { html } from "../../shared/dom";
import { value } from "../../shared/format";
import { shownQuantity } from "../../shared/units";
import { onClick, placeOn } from "../context/clicks";
import type { ViewerContext } from "../context/viewer_context";
import { observePart } from "../context/observe";
import type { Triple } from "../state/grid";
import { UNIT } from "../state/unit";
import { MeasureDrawing } from "../scene/measure_drawing";
import { angleOf, lengthOf, MEASURES, type Measure } from "../state/measures";

const WHAT = { 2: "distance", 3: "angle" } as const;
const NUMBERS = ["first", "second", "third"];

export class MeasureTool {
  /** positions of the current measure; 0: inactive */
  private places: 0 | 2 | 3 = 0;
  private pending: Triple[] = [];
  private readonly drawing: MeasureDrawing;
  private readonly list = html("ol", {});
  private readonly hint = html("p", { role: "status" });
  private readonly element = html("section", { class: "measures", "aria-label": "measurements", hidden: true }, this.list, this.hint);

  /** crosshair: its physical position. */
  constructor(
    private readonly context: ViewerContext,
    tools: HTMLElement,
    private readonly crosshair: () => Triple,
  ) {
    this.drawing = new MeasureDrawing(context.viewport);
    tools.append(this.element);
    observePart(context.history, MEASURES, () => this.show());
    observePart(context.history, UNIT, () => this.show());
    this.addActions();
    this.listenToClicks();
  }

  /** Adds a position that was clicked elsewhere; false: inactive. */
  addPosition(place: Triple): boolean {
    if (this.places === 0) return false;
    this.pending.push(place);
    if (this.pending.length < this.places) this.show();
    else {
      const measure = this.pending;
      this.pending = [];
      this.places = 0;
      this.go([...this.measures, measure]);
    }
    return true;
  }

  textOf(measure: Measure): string {
    if (measure.length === 3) return `${value(angleOf(measure))}°`;
    const { amount, unit } = shownQuantity(lengthOf(measure), this.context.page.volume.unit, 1);
    return `${value(amount)} ${unit ?? (amount === 1 ? "voxel" : "voxels")}`;
  }

  private get measures(): Measure[] {
    return MEASURES.of(this.context.history.now);
  }

  private go(measures: Measure[]): void {
    const { history } = this.context;
    history.go(MEASURES.with(history.now, measures));
    this.show();
  }

  private begin(places: 0 | 2 | 3): void {
    this.places = this.places === places ? 0 : places;
    this.pending = [];
    this.show();
  }

  private show(): void {
    const { measures } = this;
    const texts = measures.map((measure) => this.textOf(measure));
    this.drawing.show(measures, texts, this.pending);
    this.element.hidden = measures.length === 0 && this.places === 0;
    this.context.overlay.classList.toggle("measuring", this.places > 0);
    this.hint.textContent =
      this.places > 0
        ? `${WHAT[this.places as 2 | 3]}: click the ${NUMBERS[this.pending.length]} position, or press e to use the crosshair; Escape ends`
        : "";
    this.list.replaceChildren(
      ...measures.map((measure, i) => {
        const what = measure.length === 3 ? "angle" : "distance";
        const remove = (): void => this.go(measures.filter((_, other) => other !== i));
        return html(
          "li",
          {},
          html("span", {}, `${what} `, html("b", {}, texts[i])),
          html("button", { type: "button", "aria-label": `remove ${what} ${texts[i]}`, click: remove }, "✕"),
        );
      }),
    );
  }

  private addActions(): void {
    const isOn = (places: number) => (): boolean => this.places === places;
    const atCrosshair = (): void => {
      if (this.places === 0) this.begin(2);
      this.addPosition(this.crosshair());
    };
    this.context.actions.add(
      { group: "Tools", name: "Measure distance", keys: ["m"], run: () => this.begin(2), isOn: isOn(2) },
      { group: "Tools", name: "Measure angle", keys: ["M"], run: () => this.begin(3), isOn: isOn(3) },
      { group: "Tools", name: "Add crosshair position to measurement", keys: ["e"], run: atCrosshair },
      { group: "Tools", name: "Stop measuring", keys: ["Escape"], run: () => this.begin(0) },
      { group: "Tools", name: "Remove all measurements", run: () => this.go([]) },
    );
  }

  private listenToClicks(): void {
    const { overlay, viewport } = this.context;
    const click = (event: MouseEvent): void => {
      if (this.places === 0 || event.target !== viewport.canvas) return;
      event.stopPropagation();
      const place = viewport.pointAt(...placeOn(viewport.canvas, event));
      if (place) this.addPosition(place.toArray());
      else this.context.notify("no surface here: click a surface or a slice");
    };
    onClick(overlay, click, true);
  }
}
