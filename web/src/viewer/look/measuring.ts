// Measuring: places are clicked on surfaces and slices, or taken from the crosshair.
import { html } from "../../dom";
import { value } from "../../format";
import { onClick, placeOn } from "../desk/clicks";
import type { Desk } from "../desk/desk";
import { follow } from "../desk/follow";
import type { Triple } from "../state/grid";
import { MeasureDrawing } from "../draw/measure_drawing";
import { angleOf, lengthOf, MEASURES, type Measure } from "../state/measures";

const WHAT = { 2: "distance", 3: "angle" } as const;
const NUMBERS = ["first", "second", "third"];

export class Measuring {
  /** how many places one is taken of; 0: nothing is being measured */
  private places: 0 | 2 | 3 = 0;
  private pending: Triple[] = [];
  private readonly drawing: MeasureDrawing;
  private readonly list = html("ol", {});
  private readonly hint = html("p", { role: "status" });
  private readonly element = html("section", { class: "measures", "aria-label": "measures", hidden: true }, this.list, this.hint);

  /** crosshair: where it is in space. */
  constructor(
    private readonly desk: Desk,
    tools: HTMLElement,
    private readonly crosshair: () => Triple,
  ) {
    this.drawing = new MeasureDrawing(desk.stage);
    tools.append(this.element);
    follow(desk.history, MEASURES, () => this.show());
    this.addActions();
    this.listenToClicks();
  }

  /** A place that was clicked somewhere else; false: nothing is being measured. */
  take(place: Triple): boolean {
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
    const length = lengthOf(measure);
    return `${value(length)} ${this.desk.page.volume.unit ?? (length === 1 ? "voxel" : "voxels")}`;
  }

  private get measures(): Measure[] {
    return MEASURES.of(this.desk.history.now);
  }

  private go(measures: Measure[]): void {
    const { history } = this.desk;
    history.go(MEASURES.in(history.now, measures));
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
    this.desk.overlay.classList.toggle("measuring", this.places > 0);
    this.hint.textContent =
      this.places > 0
        ? `${WHAT[this.places as 2 | 3]}: click the ${NUMBERS[this.pending.length]} place, or press e for the crosshair; Escape ends`
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
      this.take(this.crosshair());
    };
    this.desk.actions.add(
      { group: "Tools", name: "measure a distance", keys: ["m"], run: () => this.begin(2), isOn: isOn(2) },
      { group: "Tools", name: "measure an angle", keys: ["M"], run: () => this.begin(3), isOn: isOn(3) },
      { group: "Tools", name: "take the crosshair as a place of the measure", keys: ["e"], run: atCrosshair },
      { group: "Tools", name: "end measuring", keys: ["Escape"], run: () => this.begin(0) },
      { group: "Tools", name: "remove all measures", run: () => this.go([]) },
    );
  }

  private listenToClicks(): void {
    const { overlay, stage } = this.desk;
    const click = (event: MouseEvent): void => {
      if (this.places === 0 || event.target !== stage.canvas) return;
      event.stopPropagation();
      const place = stage.touch(...placeOn(stage.canvas, event));
      if (place) this.take(place.toArray());
      else this.desk.say("there is no surface: click one, or a slice");
    };
    onClick(overlay, click, true);
  }
}
