// Counts over the isovalue as a staircase; where columns hold several values, as the band between them.
import { svg } from "../shared/dom";
import type { Axis } from "../shared/axis";
import { count, plural } from "../shared/format";
import type { Count } from "../shared/page";

export interface Line {
  /** also its class */
  name: string;
  one: string;
  count: Count;
}

/** Positions of counts between y = bottom (none) and y = top (the largest), logarithmic. */
export class Scale {
  private readonly max: number;
  constructor(lines: Line[], readonly top: number, readonly bottom: number) {
    this.max = Math.log1p(lines.reduce((max, line) => line.count.max.reduce((p, q) => Math.max(p, q), max), 1));
  }
  y(n: number): number {
    return this.bottom - (Math.log1p(Math.max(0, n)) / this.max) * (this.bottom - this.top);
  }
  /** Powers of ten on this scale. */
  tens(): number[] {
    const tens: number[] = [];
    for (let ten = 1; Math.log1p(ten) <= this.max + 1e-9; ten *= 10) tens.push(ten);
    return tens;
  }
}

export function countPath(edges: number[], line: Count, axis: Axis, scale: Scale): string {
  const y = (n: number | undefined): string => scale.y(n ?? 0).toFixed(1);
  return line.max
    .map((max, i) => {
      const [from, to] = [axis.x(edges[i] ?? 0).toFixed(1), axis.x(edges[i + 1] ?? 0).toFixed(1)];
      const min = line.min?.[i] ?? max;
      const start = i === 0 ? `M${from} ${y(max)}` : `V${y(max)}`;
      return `${start}${min === max ? "" : `V${y(min)}V${y(max)}`}H${to}`;
    })
    .join("");
}

export function drawCounts(edges: number[], lines: Line[], axis: Axis, scale: Scale): SVGGElement {
  const group = svg("g", {});
  for (const ten of scale.tens()) {
    const y = scale.y(ten);
    group.append(
      svg("line", { class: "grid", x1: axis.margin, x2: axis.width - axis.margin, y1: y, y2: y }),
      svg("text", { class: "grid", x: axis.margin + 2, y: y - 3 }, count(ten)),
    );
  }
  for (const line of lines) group.append(svg("path", { class: `count ${line.name}`, d: countPath(edges, line.count, axis, scale) }));
  return group;
}

/** The column that contains an isovalue. */
export function columnAt(edges: number[], tau: number): number {
  const above = edges.findIndex((edge) => edge >= tau);
  return Math.min(Math.max((above < 0 ? edges.length : above) - 1, 0), edges.length - 2);
}

/** "3 objects", or "3 to 7 objects" where a column holds several values. */
export function countWords(line: Line, column: number): string {
  const max = line.count.max[column] ?? 0;
  const min = line.count.min?.[column] ?? max;
  return min === max ? plural(max, line.one, line.name) : `${count(min)} to ${plural(max, line.one, line.name)}`;
}
