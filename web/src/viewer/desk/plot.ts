// Plots, drawn by uPlot: as large as their element, in the colours of the page. What lies over the axes, and the hand on them, belongs to
// those who ask for one.
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { value } from "../../format";
import { ink, onTheme } from "./theme";

type Options = Omit<uPlot.Options, "width" | "height">;

/** Draws over axes and series; pixel: how many of the canvas are one of the page. */
type Drawn = (pen: CanvasRenderingContext2D, pixel: number) => void;

/** The element must have a size of its own: what is in it gives it none. */
export function plotIn(element: HTMLElement, options: Options, data: uPlot.AlignedData, drawn: Drawn): uPlot {
  const draw = ({ ctx: pen }: uPlot): void => {
    pen.save(); // uPlot remembers which colours it has set
    drawn(pen, uPlot.pxRatio);
    pen.restore();
  };
  const size = (): { width: number; height: number } => ({ width: element.clientWidth, height: element.clientHeight });
  const plot = new uPlot(
    { ...options, ...size(), legend: { show: false }, cursor: { show: false }, hooks: { draw: [draw] } },
    data,
    element,
  );
  new ResizeObserver(() => element.clientWidth > 0 && plot.setSize(size())).observe(element);
  onTheme(() => plot.redraw(false));
  return plot;
}

const FONT = "11px system-ui, sans-serif";

export function plotAxis(axis: uPlot.Axis): uPlot.Axis {
  const stroke = (): string => ink("line");
  return {
    stroke: () => ink("soft"),
    font: FONT,
    labelFont: FONT,
    gap: 2,
    values: (_, ticks) => ticks.map(value),
    ...axis,
    grid: { stroke, width: 1, ...axis.grid },
    ticks: { stroke, width: 1, size: 4 },
  };
}
