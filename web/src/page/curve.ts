// Number of objects against the minimum hypervolume, with the automatic choice.
import { drawingWidth } from "../shared/axis";
import { html, svg } from "../shared/dom";
import { count, value } from "../shared/format";
import { pictured } from "./choice";
import type { Curve, Page } from "../shared/page";

export interface CurvePanel {
  /** of pages of both */
  polarity?: "high" | "low";
  panel: HTMLElement;
  /** Marks the number of objects that are kept. */
  mark: (kept: number) => void;
}

/** One; of a page of both two. */
export function curves(page: Page): CurvePanel[] {
  const all = page.low ? [curve(page, page.curve, "high"), curve(page, page.low.curve, "low")] : [curve(page, page.curve)];
  return all.filter((one) => one !== null);
}

function curve(page: Page, data: Curve, polarity?: "high" | "low"): CurvePanel | null {
  if (data.kept.length < 2) return null;
  const [width, height, left, right, top, bottom] = [drawingWidth(), 220, 60, 14, 16, 180];
  const positive = data.threshold.filter((t) => t > 0);
  const [min, max] = [Math.log10(Math.min(...positive)), Math.log10(Math.max(...positive))];
  const x = (t: number): number =>
    left + ((Math.max(Math.log10(Math.max(t, 1e-300)), min) - min) / (max - min || 1)) * (width - left - right);
  const tallest = Math.log10(Math.max(10, data.kept.at(-1) ?? 1));
  const y = (n: number): number => bottom - (Math.log10(Math.max(1, n)) / tallest) * (bottom - top);
  const chosen = `${count(data.automaticKept)} in the automatic choice, contrast × size at least ${value(data.automaticThreshold)}`;
  const label = `${count(data.kept.at(-1) ?? 0)} objects without a threshold, ${chosen}`;
  const drawing = svg("svg", { viewBox: `0 0 ${width} ${height}`, class: "curve", role: "img", "aria-label": label });
  for (let ten = 1; Math.log10(ten) <= tallest; ten *= 10)
    drawing.append(
      svg("line", { class: "grid", x1: left, x2: width - right, y1: y(ten), y2: y(ten) }),
      svg("text", { x: left - 6, y: y(ten) + 4, "text-anchor": "end" }, count(ten)),
    );
  const step = Math.max(1, Math.ceil((max - min) / (width / 110)));
  for (let power = Math.ceil(min); power <= max; power += step)
    drawing.append(
      svg("text", { x: x(10 ** power), y: bottom + 16, "text-anchor": x(10 ** power) > width - 40 ? "end" : "middle" }, value(10 ** power)),
    );
  const path = data.kept.map(
    (n, i) => `${i === 0 ? `M${x(data.threshold[0] ?? 1)} ${bottom}` : ""}H${x(data.threshold[i] ?? 1).toFixed(1)}V${y(n).toFixed(1)}`,
  );
  drawing.append(svg("path", { class: "count objects", d: path.join("") }));
  const at = x(data.automaticThreshold);
  const anchor = at > width / 2 ? "end" : "start";
  const current = svg("g", { class: "current" });
  drawing.append(
    svg("line", { class: "automatic", x1: at, x2: at, y1: top, y2: bottom }),
    svg("circle", { class: "automatic", cx: at, cy: y(data.automaticKept), r: 6 }),
    svg(
      "text",
      { class: "strong", x: at + (anchor === "end" ? -10 : 10), y: top + 10, "text-anchor": anchor },
      `automatic choice: ${count(data.automaticKept)}`,
    ),
    current,
    svg("text", { class: "caption", x: width - right, y: height - 4, "text-anchor": "end" }, "contrast × size, at least"),
  );
  const mark = (kept: number): void => {
    const i = data.kept.findIndex((n) => n >= kept);
    const there = x(data.threshold[i < 0 ? data.kept.length - 1 : i] ?? 1);
    current.replaceChildren(svg("circle", { cx: there, cy: y(kept), r: 5 }), svg("title", {}, `${kept} shown`));
  };
  if (polarity === undefined) mark(pictured(page));
  const of = polarity === undefined ? "" : ` of ${polarity} values`;
  return {
    polarity,
    mark,
    panel: html(
      "section",
      { class: "panel" },
      html("h2", {}, `Number of objects${of} vs. minimum importance`),
      html(
        "p",
        { class: "note" },
        `${label}. The automatic choice excludes objects below noise level. The ring marks the current choice.`,
      ),
      drawing,
    ),
  };
}
