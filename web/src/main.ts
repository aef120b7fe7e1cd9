// The page from top to bottom.
import { card } from "./card";
import { chosen, controls } from "./controls";
import { Detail } from "./detail";
import { html } from "./dom";
import { count, plural, value } from "./format";
import { glossary } from "./glossary";
import { overview } from "./overview";
import { readPage, type Page } from "./page";
import { spectrum } from "./spectrum";
import "./style.css";

function about(page: Page): HTMLElement {
  const { volume } = page;
  const spacing = volume.spacing && volume.unit ? `, voxels of ${volume.spacing.map(value).join(" × ")} ${volume.unit}` : "";
  const unit = volume.valueUnit ? ` ${volume.valueUnit}` : "";
  return html(
    "header",
    { class: "about" },
    html("h1", {}, volume.name),
    html("p", {}, `${volume.size.join(" × ")} samples, ${volume.type}, values ${value(volume.low)} to ${value(volume.high)}${unit}${spacing}.`),
    html(
      "p",
      {},
      page.objects.length === 0
        ? "There is nothing to show: all samples have one value, or noise explains all there is."
        : `${plural(page.objects.length, "picture")} of what stands out. ${count(page.branches)} objects are in this volume in all; ${page.rule}.`,
    ),
  );
}

function start(page: Page, main: HTMLElement): void {
  document.title = `${page.volume.name} – atlas`;
  const detail = new Detail(page);
  const open = (i: number): void => detail.open(i);
  const cards = html("ol", { class: "cards" });
  const items = page.objects.map((_, i) => card(page, i, open));
  const said = html("p", { class: "said", role: "status" });
  const show = (kept: number[]): void => {
    cards.replaceChildren(...kept.map((i) => items[i] as HTMLElement));
    said.textContent = kept.length === items.length ? "" : `${count(kept.length)} of ${count(items.length)} shown`;
  };
  show(chosen(page, "rank", "all", 0));
  main.append(about(page));
  if (items.length > 0)
    main.append(
      html("section", { class: "panel" }, html("h2", {}, "Objects over the isovalue"), overview(page, open)),
      html("section", {}, html("h2", {}, "Objects"), controls(page, show), said, cards),
    );
  main.append(spectrum(page) ?? "", glossary(), html("footer", {}, `isoatlas ${page.version}, interpolant ${page.interpolant}. This page loads nothing from elsewhere.`), detail.dialog);
  const asked = /^#object-(\d+)$/.exec(location.hash);
  if (asked) open(Number(asked[1]) - 1);
}

const main = document.getElementById("atlas");
const page = readPage(document.getElementById("atlas-data")?.textContent ?? "null");
if (main && page) start(page, main);
else main?.append(html("p", {}, "This page has no data: isoatlas writes it with data."));
