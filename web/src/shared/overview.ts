// All objects over the isovalue axis: a line for each from its appearance to its merge, and on to the object it
// merges into. Objects grow to the left, cavities to the right. The histogram is drawn behind.
import { Axis, axisName, drawingWidth, drawTicks, histogramPath } from "./axis";
import { alsoAt } from "./cards";
import { svg } from "./dom";
import { value } from "./format";
import { describe, entriesOf, isCavity, nameOf, numberOf } from "./names";
import { branchOf, endOfBranch, entryOf, isLowOfBoth, type Page } from "./page";

const head = 90;
const neutral = "var(--soft)";

/** Per branch its lane, -1: not shown. A branch lies below the one it merges into: preorder of the tree; objects first. */
export function lanesOf(page: Page, kept: Set<number>): number[] {
  const lane = page.branches.map(() => -1);
  const children = new Map<number, number[]>();
  for (const b of kept) {
    const parent = keptParent(page, kept, b);
    children.set(parent, [...(children.get(parent) ?? []), b]);
  }
  const waiting = (children.get(-1) ?? []).sort((p, q) => q - p);
  let next = 0;
  for (let b = waiting.pop(); b !== undefined; b = waiting.pop()) {
    lane[b] = next++;
    waiting.push(...(children.get(b) ?? []).sort((p, q) => q - p));
  }
  return lane;
}

/** The closest ancestor of a branch that is shown; -1: none. */
export function keptParent(page: Page, kept: Set<number>, b: number): number {
  let parent = branchOf(page, b).parent;
  while (parent >= 0 && !kept.has(parent)) parent = branchOf(page, parent).parent;
  return parent;
}

/** Margin left and right of the axis. */
export const sideMargin = 14;

/** Lines have the branch as data-branch, marks the entry as data-entry. */
export function overview(page: Page, kept: Set<number>, open: (i: number) => void, width = drawingWidth()): SVGSVGElement {
  const axis = Axis.of(page, width, sideMargin);
  const lane = lanesOf(page, kept);
  const heights = laneHeights(page, kept, lane);
  const top = heights.reduce<number[]>((all, height) => [...all, (all.at(-1) ?? head) + height], [head]);
  const bottom = (top.at(-1) ?? head) + 10;
  const y = (b: number): number => ((top[lane[b] ?? 0] ?? 0) + (top[(lane[b] ?? 0) + 1] ?? 0)) / 2;
  const drawing = svg("svg", {
    viewBox: `0 0 ${width} ${bottom + 36}`,
    class: "overview",
    role: "group",
    "aria-label": "Objects over the isovalue",
  });
  drawing.append(
    svg("path", { class: "histogram", d: histogramPath(page.histogram, axis, 4, bottom) }),
    drawTicks(axis, bottom, width / 110),
  );
  for (const b of kept) drawing.append(...branchLines(page, kept, b, axis, y));
  for (const b of kept) for (const i of entriesOf(page, b)) drawing.append(stableLine(page, i, axis, y(b)));
  for (const b of kept) for (const i of entriesOf(page, b)) drawing.append(mark(page, i, axis, y(b), open));
  drawing.append(svg("text", { class: "caption", x: width - sideMargin, y: bottom + 32, "text-anchor": "end" }, axisName(page)));
  return drawing;
}

/** Heights of all lanes; lanes without a picture share the rest of the height. */
function laneHeights(page: Page, kept: Set<number>, lane: number[]): number[] {
  const heights: number[] = [];
  const thin = [...kept].filter((b) => entriesOf(page, b).length === 0).length;
  for (const b of kept) heights[lane[b] ?? 0] = entriesOf(page, b).length > 0 ? 22 : Math.max(3, Math.min(12, 500 / thin));
  return heights;
}

function branchLines(page: Page, kept: Set<number>, b: number, axis: Axis, y: (b: number) => number): SVGLineElement[] {
  const branch = branchOf(page, b);
  const [first] = entriesOf(page, b);
  const stroke = first === undefined ? neutral : entryOf(page, first).colour;
  const end = axis.x(endOfBranch(page, branch));
  const kind = first === undefined ? "branch thin" : branch.side === "cavity" ? "branch cavity" : "branch";
  const lines = [
    svg("line", { class: kind, "data-branch": b, x1: end, x2: axis.x(branch.appears), y1: y(b), y2: y(b), style: `--colour: ${stroke}` }),
  ];
  const parent = keptParent(page, kept, b);
  if (parent >= 0) lines.push(svg("line", { class: "merge", x1: end, x2: end, y1: y(b), y2: y(parent), style: `--colour: ${stroke}` }));
  return lines;
}

/** Range of isovalues in which its tunnels and cavities stay the same. */
function stableLine(page: Page, i: number, axis: Axis, y: number): SVGLineElement {
  const entry = entryOf(page, i);
  const [left, right] = [axis.x(entry.low), axis.x(entry.high)];
  return svg("line", { class: "stable", x1: left, x2: Math.max(right, left + 3), y1: y, y2: y, stroke: entry.colour });
}

function mark(page: Page, i: number, axis: Axis, y: number, open: (i: number) => void): SVGGElement {
  const radius = 9;
  const entry = entryOf(page, i);
  const x = axis.x(entry.tau);
  const group = svg("g", {
    class: isCavity(page, i) ? "mark cavity" : "mark",
    "data-entry": i,
    tabindex: 0,
    role: "button",
    "aria-label": describe(page, i),
  });
  const shape = isCavity(page, i) || isLowOfBoth(page, branchOf(page, entry.branch))
    ? svg("rect", { x: x - radius, y: y - radius, width: 2 * radius, height: 2 * radius, rx: 3, fill: entry.colour })
    : svg("circle", { cx: x, cy: y, r: radius, fill: entry.colour });
  group.append(
    svg("title", {}, describe(page, i)),
    shape,
    svg("text", { class: isDeep(entry.colour) ? "on-deep" : undefined, x, y: y + 4, "text-anchor": "middle" }, String(numberOf(page, i))),
  );
  group.addEventListener("click", () => open(i));
  group.addEventListener("keydown", (event) => {
    if (event.key !== "Enter" && event.key !== " ") return;
    event.preventDefault();
    open(i);
  });
  return group;
}

/** Does white have more contrast than black on this colour? colour: #rrggbb. */
export function isDeep(colour: string): boolean {
  const [red, green, blue] = [1, 3, 5].map((at) => (parseInt(colour.slice(at, at + 2), 16) / 255) ** 2.2) as [number, number, number];
  return 0.2126 * red + 0.7152 * green + 0.0722 * blue < 0.18; // equal contrast of both (WCAG)
}

/** Range of isovalues of one entry, on its card. */
export function rangeBar(page: Page, i: number): SVGSVGElement {
  const entry = entryOf(page, i);
  const branch = branchOf(page, entry.branch);
  const [width, height] = [280, 44];
  const axis = Axis.of(page, width, 6);
  const drawing = svg("svg", {
    viewBox: `0 0 ${width} ${height}`,
    class: "range",
    "aria-hidden": "true",
    style: `--colour: ${entry.colour}`,
  });
  drawing.append(svg("path", { class: "histogram", d: histogramPath(page.histogram, axis, 2, 32) }));
  const bar = (from: number, to: number, kind: string, y: number, thick: number): void => {
    const [a, b] = [axis.x(from), axis.x(to)].sort((p, q) => p - q) as [number, number];
    drawing.append(svg("rect", { class: kind, x: a, y, width: Math.max(b - a, 2), height: thick }));
  };
  bar(endOfBranch(page, branch), branch.appears, "whole", 33, 4);
  bar(entry.low, entry.high, "stable", 31, 8);
  for (const { tau } of alsoAt(page, i)) drawing.append(svg("path", { class: "further", d: `M${axis.x(tau)} 26V40` }));
  drawing.append(
    svg("title", {}, `${nameOf(page, i)} at ${value(entry.tau)}`),
    svg("path", { class: "needle", d: `M${axis.x(entry.tau)} 4V40` }),
  );
  return drawing;
}
