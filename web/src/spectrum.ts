// How many objects, contours, tunnels and cavities there are at every isovalue.
import { Axis, drawTicks } from "./axis";
import { html, svg } from "./dom";
import { count, value } from "./format";
import type { Page, Spectrum } from "./page";

const lines: [keyof Omit<Spectrum, "tau">, string][] = [
  ["objects", "objects"],
  ["contours", "contours"],
  ["tunnels", "tunnels"],
  ["cavities", "cavities"],
];

/** A staircase: counts hold from an isovalue to the next one. */
function staircase(x: number[], y: number[]): string {
  return x.map((at, i) => (i === 0 ? `M${at.toFixed(1)} ${(y[0] ?? 0).toFixed(1)}` : `H${at.toFixed(1)}V${(y[i] ?? 0).toFixed(1)}`)).join("");
}

export function spectrum(page: Page): HTMLElement | null {
  const data = page.spectrum;
  if (!data || data.tau.length < 2) return null;
  const [width, height, bottom] = [1000, 240, 205];
  const axis = new Axis(page.histogram.low, page.histogram.high, width, 14);
  const most = Math.log1p(Math.max(1, ...lines.flatMap(([key]) => data[key])));
  const drawing = svg("svg", { viewBox: `0 0 ${width} ${height}`, class: "spectrum", role: "img", "aria-label": "Counts over the isovalue, logarithmic" });
  drawing.append(drawTicks(axis, bottom, 9));
  for (let ten = 1; Math.log1p(ten) <= most; ten *= 10) {
    const y = bottom - (Math.log1p(ten) / most) * (bottom - 10);
    drawing.append(svg("line", { class: "grid", x1: 14, x2: width - 14, y1: y, y2: y }), svg("text", { class: "grid", x: 16, y: y - 3 }, count(ten)));
  }
  const x = data.tau.map((tau) => axis.x(tau));
  for (const [key] of lines) {
    const y = data[key].map((n) => bottom - (Math.log1p(Math.max(0, n)) / most) * (bottom - 10));
    drawing.append(svg("path", { class: `count ${key}`, d: staircase(x, y) }));
  }
  const legend = html("p", { class: "legend" }, ...lines.map(([key, name]) => html("span", { class: key }, name)));
  const readout = html("output", { class: "readout", "aria-live": "polite" }, "Move over the picture to read numbers.");
  drawing.addEventListener("pointermove", (event) => {
    const box = drawing.getBoundingClientRect();
    const tau = axis.tau(((event.clientX - box.left) / box.width) * width);
    const i = Math.max(0, data.tau.findLastIndex((at) => at <= tau));
    readout.textContent = `${value(tau)}: ${lines.map(([key, name]) => `${count(data[key][i] ?? 0)} ${name}`).join(", ")}`;
  });
  return html("section", { class: "panel" }, html("h2", {}, "How many at which isovalue"), drawing, legend, readout);
}
