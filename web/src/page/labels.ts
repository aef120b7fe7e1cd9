// The page of a label volume: a card for each label.
import { commandList } from "../shared/commands";
import { html } from "../shared/dom";
import { count, plural, value, volume } from "../shared/format";
import type { PageMesh, Picture } from "../shared/page";
import { turntable } from "../shared/turntable";
import { turnButton } from "./turnable";
import { missingPicture, unfinished } from "./unfinished";

/** Data as `isoatlas` writes them: docs/schema/label-page.schema.json. Largest label first. */
export interface LabelPage {
  schema: "isoatlas/label-page/1";
  version: string;
  volume: { name: string; size: number[]; type: string; spacing: number[] | null; unit: string | null };
  notes: string[];
  interpolant: string;
  /** voxels of label 0 */
  background: number;
  /** false: without some of the pictures and all meshes, while isoatlas draws them */
  complete?: boolean;
  labels: Label[];
}

export interface Label {
  label: number;
  /** that the file gives it */
  name: string | null;
  voxels: number;
  measure: number;
  components: number;
  tunnels: number;
  cavities: number;
  colour: string;
  picture: Picture | null;
  mesh?: PageMesh | null;
  commands: { name: string; line: string }[];
}

export function isLabelPage(data: unknown): data is LabelPage {
  return (data as { schema?: unknown } | null)?.schema === "isoatlas/label-page/1";
}

const orders: [string, (p: Label, q: Label) => number][] = [
  ["size", (p, q) => q.voxels - p.voxels],
  ["label", (p, q) => p.label - q.label],
  ["components", (p, q) => q.components - p.components],
  ["tunnels", (p, q) => q.tunnels - p.tunnels],
];

export function titleOf(label: Label): string {
  return label.name ?? `Label ${label.label}`;
}

function facts(page: LabelPage, label: Label): HTMLElement {
  const all = page.volume.size.reduce((p, q) => p * q, 1);
  const holes = `${plural(label.tunnels, "tunnel")}, ${plural(label.cavities, "cavity", "cavities")}`;
  const rows: [string, string][] = [
    ["label", String(label.label)],
    ["size", volume(label.measure, page.volume.unit)],
    ["voxels", `${count(label.voxels)} (${value(Number(((100 * label.voxels) / all).toPrecision(2)))} %)`],
    ["topology", `${plural(label.components, "component")}, ${holes}`],
  ];
  return html("dl", { class: "facts" }, ...rows.flatMap(([name, text]) => [html("dt", {}, name), html("dd", {}, text)]));
}

function card(page: LabelPage, label: Label): HTMLElement {
  const picture = label.picture
    ? turntable(label.picture, `Picture of ${titleOf(label)}: ${volume(label.measure, page.volume.unit)}`)
    : missingPicture(page);
  const item = html(
    "li",
    { class: "card", id: `label-${label.label}` },
    picture,
    label.mesh ? turnButton(picture, label.mesh, titleOf(label), label.colour) : null,
    html("h3", {}, titleOf(label)),
    facts(page, label),
    html("details", { class: "commands" }, html("summary", {}, "Commands"), commandList(label.commands)),
  );
  item.style.setProperty("--colour", label.colour);
  return item;
}

export function showLabels(page: LabelPage, main: HTMLElement): void {
  const { volume: about } = page;
  document.title = `${about.name} – labels`;
  const spacing = about.spacing && about.unit ? `, voxels of ${about.spacing.map(value).join(" × ")} ${about.unit}` : "";
  const items = new Map(page.labels.map((label) => [label, card(page, label)]));
  const cards = html("ol", { class: "cards" });
  const order = html("select", { name: "order" }, ...orders.map(([name]) => html("option", { value: name }, name)));
  const sort = (): void => {
    const compare = orders.find(([name]) => name === order.value)?.[1] ?? (() => 0);
    cards.replaceChildren(...[...page.labels].sort((p, q) => compare(p, q) || p.label - q.label).map((label) => items.get(label)!));
  };
  order.addEventListener("input", sort);
  sort();
  main.append(
    html(
      "header",
      { class: "about" },
      html("h1", {}, about.name),
      html("p", {}, `${about.size.join(" × ")} samples, ${about.type}, ${plural(page.labels.length, "label")}${spacing}.`),
      html("p", {}, `${count(page.background)} voxels are background (label 0).`),
      page.complete === false ? unfinished() : null,
      ...page.notes.map((words) => html("p", { class: "assumed" }, `Note: ${words}.`)),
    ),
    html(
      "section",
      {},
      html("h2", {}, "Labels"),
      html("p", { class: "note" }, "Each label is an object of its own: its surface lies half-way to the voxels around it."),
      html("form", { class: "controls", submit: (event) => event.preventDefault() }, html("label", {}, "Sort by ", order)),
      cards,
    ),
    html("footer", {}, `isoatlas ${page.version}, interpolant ${page.interpolant}. This page loads nothing from elsewhere.`),
  );
}
