// Plots drawn by uPlot: sized by their element, in the colours of the theme. Overlays and interaction are left to the
// caller.
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { value } from "../../shared/format";
import { themeColor, onTheme } from "./theme";

type Options = Omit<uPlot.Options, "width" | "height">;

/** Draws over axes and series; pixel: canvas pixels per CSS pixel. */
type Drawn = (pen: CanvasRenderingContext2D, pixel: number) => void;

/** The element must have a size of its own, independent of its content. */
export function plotIn(element: HTMLElement, options: Options, data: uPlot.AlignedData, drawn: Drawn): uPlot {
  const draw = ({ ctx: pen }: uPlot): void => {
    pen.save(); // uPlot caches the colours that it has set
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
  const stroke = (): string => themeColor("line");
  return {
    stroke: () => themeColor("soft"),
    font: FONT,
    labelFont: FONT,
    gap: 2,
    values: (_, ticks) => ticks.map(value),
    ...axis,
    grid: { stroke, width: 1, ...axis.grid },
    ticks: { stroke, width: 1, size: 4 },
  };
}
