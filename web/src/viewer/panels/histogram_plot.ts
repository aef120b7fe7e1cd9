// Histogram over the isovalue, with the isovalues of the scene, the range of the selected object, and the events.
import uPlot from "uplot";
import { Axis } from "../../shared/axis";
import { html } from "../../shared/dom";
import { value } from "../../shared/format";
import type { Page } from "../../shared/page";
import { plotAxis, plotIn } from "../context/plot";
import { themeColor } from "../context/theme";
import { colourOfShown, ownRange } from "../api/entries";
import type { Event } from "../state/events";
import { NOTHING, type State } from "../state/state";

/** pixels: half of a slider's thumb, which aligns it with the line */
const MARGIN = 8;
const UNDER = 24;
/** minimal distance of labels */
const ROOM = 90;

const STAIRS = uPlot.paths.stepped?.({ align: 1 });

/** A constant volume has its value in the middle. */
function scaleOf(axis: Axis): uPlot.Scale {
  if (axis.low === axis.high) return { time: false, range: [axis.low - 1, axis.high + 1] };
  return { time: false, range: [axis.low, axis.high], distr: 100, fwd: (tau) => axis.x(tau), bwd: (at) => axis.tau(at) };
}

/** Labels are centred on their ticks: blanks shift those at the ends into the plot. */
function numbersOf({ low, high }: Axis): uPlot.Axis.Values {
  const text = (tick: number): string => {
    const blanks = low < high ? "\u2007".repeat(value(tick).length) : "";
    return `${tick === low ? blanks : ""}${value(tick)}${tick === high ? blanks : ""}`;
  };
  return (_, ticks) => ticks.map(text);
}

export class HistogramPlot {
  readonly element = html("div", { class: "plot", "aria-hidden": "true" });
  private readonly plot: uPlot;
  private state = NOTHING;

  constructor(
    private readonly page: Page,
    private readonly events: readonly Event[],
  ) {
    const { axis, histogram } = page;
    const whole = new Axis(axis.low, axis.high, 1, 0, axis.bend);
    const max = Math.max(1, ...histogram.counts);
    const ticks = (plot: uPlot): number[] => whole.ticks(Math.min(8, plot.width / ROOM));
    this.plot = plotIn(
      this.element,
      {
        padding: [2, MARGIN, 0, MARGIN],
        scales: {
          x: scaleOf(whole),
          y: { range: [0, max], distr: 4 }, // logarithmic, as max samples are background
        },
        axes: [
          plotAxis({ size: UNDER, grid: { show: false }, splits: ticks, filter: (_, all) => all, values: numbersOf(whole) }),
          { show: false },
        ],
        series: [{}, { paths: STAIRS, fill: () => themeColor("line"), width: 0, points: { show: false } }],
      },
      [histogram.edges, [...histogram.counts, histogram.counts.at(-1) ?? 0]],
      (pen, pixel) => this.draw(pen, pixel),
    );
  }

  show(state: State): void {
    this.state = state;
    this.plot.redraw(false);
  }

  /** Pixels from the left of the element. */
  x(tau: number): number {
    return MARGIN + this.plot.valToPos(tau, "x");
  }

  private draw(pen: CanvasRenderingContext2D, pixel: number): void {
    const { top, height } = this.plot.bbox;
    const bottom = top + height;
    const x = (tau: number): number => this.plot.valToPos(tau, "x", true);
    const line = (tau: number, high: number, wide: number, colour: string): void => {
      pen.fillStyle = colour;
      pen.fillRect(x(tau) - (wide / 2) * pixel, bottom - high * pixel, wide * pixel, high * pixel);
    };
    const { shown, selected } = this.state;
    for (const { tau } of this.events) line(tau, 6, 1, themeColor("mark"));
    for (const one of shown) line(one.tau, 16, 1, colourOfShown(this.page, one));
    const own = shown[selected];
    if (!own) return;
    line(own.tau, height / pixel, 3, themeColor("mark"));
    const [left, right] = ownRange(this.page, own.entry).map(x) as [number, number];
    pen.globalAlpha = 0.35;
    pen.fillRect(left, bottom - 18 * pixel, Math.max(pixel, right - left), 8 * pixel);
  }
}
