// All objects over the isovalue axis: a line for each, as long as it is on its own, from where it appears (right) to where it merges (left),
// and down to the object it merges into. The histogram lies behind.
import { Axis, drawTicks, histogramPath } from "./axis";
import { svg } from "./dom";
import { value } from "./format";
import { describe, nameOf } from "./names";
import type { Page } from "./page";

const laneHeight = 22;
const head = 90;

/** Objects that merge into one lie below it: a walk over the tree. The trunk has one lane, whatever isovalues show of it. */
export function lanesOf(page: Page): number[] {
  const lane = page.objects.map(() => -1);
  let next = 0;
  const place = (i: number): void => {
    const entry = page.objects[i];
    if (!entry || (lane[i] ?? 0) >= 0) return;
    const mine = next++;
    page.objects.forEach((other, k) => {
      if (k === i || (entry.trunk && other.trunk && other.side === entry.side)) lane[k] = mine;
    });
    page.objects.forEach((other, k) => {
      if (other.into >= 0 && lane[other.into] === mine) place(k);
    });
  };
  page.objects.forEach((entry, i) => {
    if (entry.into < 0) place(i);
  });
  page.objects.forEach((_, i) => place(i));
  return lane;
}

export function overview(page: Page, open: (i: number) => void): SVGSVGElement {
  const width = 1000;
  const axis = new Axis(page.histogram.low, page.histogram.high, width, 14);
  const lane = lanesOf(page);
  const height = head + (Math.max(-1, ...lane) + 1) * laneHeight + 40;
  const y = (i: number): number => head + (lane[i] ?? 0) * laneHeight + laneHeight / 2;
  const drawing = svg("svg", { viewBox: `0 0 ${width} ${height}`, class: "overview", role: "group", "aria-label": "Objects over the isovalue" });
  drawing.append(svg("path", { class: "histogram", d: histogramPath(page.histogram, axis, 4, height - 30) }));
  drawing.append(drawTicks(axis, height - 30, 9));
  const seen = new Set<number>();
  page.objects.forEach((entry, i) => {
    const row = lane[i] ?? 0;
    if (!seen.has(row)) {
      seen.add(row);
      const from = axis.x(entry.merges ?? page.histogram.low);
      drawing.append(svg("line", { class: "branch", x1: from, x2: axis.x(entry.appears), y1: y(i), y2: y(i), stroke: entry.colour }));
      if (entry.into >= 0)
        drawing.append(svg("line", { class: "merge", x1: from, x2: from, y1: y(i), y2: y(entry.into), stroke: entry.colour }));
    }
    const x = axis.x(entry.best);
    const [left, right] = [axis.x(entry.low), axis.x(entry.high)];
    const mark = svg("g", { class: "mark", tabindex: 0, role: "button", "aria-label": describe(page, i) });
    mark.append(
      svg("title", {}, describe(page, i)),
      svg("line", { class: "steady", x1: left, x2: Math.max(right, left + 3), y1: y(i), y2: y(i), stroke: entry.colour }),
      svg("circle", { cx: x, cy: y(i), r: 9, fill: entry.colour }),
      svg("text", { x, y: y(i) + 4, "text-anchor": "middle" }, String(i + 1)),
    );
    mark.addEventListener("click", () => open(i));
    mark.addEventListener("keydown", (event) => {
      if (event.key === "Enter" || event.key === " ") open(i);
    });
    drawing.append(mark);
  });
  drawing.append(svg("text", { class: "caption", x: width - 14, y: height - 2, "text-anchor": "end" }, axisName(page)));
  return drawing;
}

function axisName(page: Page): string {
  return `isovalue${page.volume.valueUnit ? `, ${page.volume.valueUnit}` : ""}`;
}

/** The axis of one card. */
export function rangeBar(page: Page, i: number): SVGSVGElement {
  const entry = page.objects[i];
  const [width, height] = [280, 44];
  const axis = new Axis(page.histogram.low, page.histogram.high, width, 6);
  const drawing = svg("svg", { viewBox: `0 0 ${width} ${height}`, class: "range", "aria-hidden": "true" });
  drawing.append(svg("path", { class: "histogram", d: histogramPath(page.histogram, axis, 2, 32) }));
  if (!entry) return drawing;
  const bar = (from: number, to: number, kind: string): void => {
    const [a, b] = [axis.x(from), axis.x(to)];
    drawing.append(svg("rect", { class: kind, x: a, y: kind === "whole" ? 33 : 31, width: Math.max(b - a, 2), height: kind === "whole" ? 4 : 8, fill: entry.colour }));
  };
  bar(entry.merges ?? page.histogram.low, entry.appears, "whole");
  bar(entry.low, entry.high, "steady");
  drawing.append(
    svg("title", {}, `${nameOf(page, i)} at ${value(entry.best)}`),
    svg("path", { class: "needle", d: `M${axis.x(entry.best)} 4V40` }),
  );
  return drawing;
}
