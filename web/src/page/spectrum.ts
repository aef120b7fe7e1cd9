// Number of objects, contours, tunnels and cavities at every isovalue.
import { Axis, axisName, drawingWidth, drawTicks } from "../shared/axis";
import { columnAt, countWords, drawCounts, Scale, type Line } from "./columns";
import { html, svg } from "../shared/dom";
import { value } from "../shared/format";
import type { Counts, Page, Spectrum } from "../shared/page";

function linesOf(counts: Counts): Line[] {
  return [
    { name: "objects", one: "object", count: counts.objects },
    { name: "contours", one: "contour", count: counts.contours },
    { name: "tunnels", one: "tunnel", count: counts.tunnels },
    { name: "cavities", one: "cavity", count: counts.cavities },
  ];
}

export function legend(lines: Line[]): HTMLElement {
  return html("p", { class: "legend" }, ...lines.map((line) => html("span", { class: line.name }, line.name)));
}

interface Counted {
  /** "all", "significant-low" */
  key: string;
  name: string;
  of: Spectrum;
  counts: Counts;
}

/** What can be counted: objects of both polarities where the page has both. */
function choicesOf(page: Page): Counted[] {
  const two = page.polarity === "both";
  return [
    { of: page.spectrum, mark: "", side: two ? " of high values" : "" },
    { of: page.low?.spectrum ?? null, mark: "-low", side: " of low values" },
  ].flatMap(({ of, mark, side }) => {
    if (!of || of.edges.length < 2) return [];
    return [
      { key: `all${mark}`, name: `all objects${side}`, of, counts: of.all },
      { key: `significant${mark}`, name: `significant objects${side}${two ? "" : " only"}`, of, counts: of.significant },
    ];
  });
}

export function spectrum(page: Page): HTMLElement | null {
  const choices = choicesOf(page);
  const [first] = choices;
  if (!first) return null;
  let data = first.of;
  const [width, height, bottom] = [drawingWidth(), 250, 210];
  const axis = Axis.of(page, width, 14);
  const scales = new Map(choices.map(({ of }) => [of, new Scale(linesOf(of.all), 14, bottom)]));
  const which = html(
    "select",
    { name: "counted" },
    ...choices.map(({ key, name }) => html("option", { value: key }, name)),
  );
  const at = html("input", {
    type: "range",
    name: "isovalue",
    min: 0,
    max: data.edges.length - 2,
    step: 1,
    value: 0,
    "aria-label": "Isovalue of the counts",
  });
  const readout = html("output", { class: "readout", "aria-live": "polite" });
  const drawing = svg("svg", {
    viewBox: `0 0 ${width} ${height}`,
    class: "spectrum",
    role: "img",
    "aria-label": "Counts over the isovalue, logarithmic",
  });
  const needle = svg("line", { class: "needle", y1: 8, y2: bottom });
  const chosen = (): Counted => choices.find(({ key }) => key === which.value) ?? first;
  const lines = (): Line[] => linesOf(chosen().counts);
  const draw = (): void => {
    drawing.replaceChildren(
      drawTicks(axis, bottom, width / 110),
      drawCounts(data.edges, lines(), axis, scales.get(data) as Scale),
      needle,
      svg("text", { class: "caption", x: width - 14, y: height - 4, "text-anchor": "end" }, axisName(page)),
    );
  };
  const read = (): void => {
    const column = Number(at.value);
    const [low, high] = [data.edges[column] ?? 0, data.edges[column + 1] ?? 0];
    const x = axis.x((low + high) / 2);
    needle.setAttribute("x1", String(x));
    needle.setAttribute("x2", String(x));
    const words = `above ${value(low)} up to ${value(high)}: ${lines().map((line) => countWords(line, column)).join(", ")}`;
    at.setAttribute("aria-valuetext", words);
    readout.textContent = words;
  };
  drawing.addEventListener("pointermove", (event) => {
    const box = drawing.getBoundingClientRect();
    at.value = String(columnAt(data.edges, axis.tau(((event.clientX - box.left) / box.width) * width)));
    read();
  });
  at.addEventListener("input", read);
  which.addEventListener("input", () => {
    if (data !== chosen().of) {
      const tau = data.edges[Number(at.value) + 1] ?? page.axis.low;
      data = chosen().of;
      at.max = String(data.edges.length - 2);
      at.value = String(columnAt(data.edges, tau));
    }
    draw();
    read();
  });
  at.value = String(columnAt(data.edges, page.entries[0]?.tau ?? page.axis.low));
  draw();
  read();
  return html(
    "section",
    { class: "panel" },
    html("h2", {}, "Object count vs. isovalue"),
    html("div", { class: "controls" }, html("label", {}, "Count ", which), html("label", { class: "at" }, "at ", at)),
    drawing,
    legend(lines()),
    readout,
  );
}
