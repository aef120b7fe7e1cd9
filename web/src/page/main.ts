// The page from top to bottom.
import { narrowScreens } from "../shared/axis";
import { card } from "./card";
import { scannedField } from "./scanned_field";
import { chosenBranches, chosenEntries, firstChoice, type Choice } from "./choice";
import { controls } from "./controls";
import { curves } from "./curve";
import { Detail } from "./detail";
import { cardsOf } from "../shared/cards";
import { html } from "../shared/dom";
import { count, value } from "../shared/format";
import { glossary } from "./glossary";
import { isLabelPage, showLabels } from "./labels";
import { hiddenSentences } from "../shared/hidden_counts";
import { others } from "./others";
import { overview } from "../shared/overview";
import { hasCard, readPage, type Page } from "../shared/page";
import { smoothing } from "./smoothing";
import { spectrum } from "./spectrum";
import { unfinished } from "./unfinished";
import "./page.css";

const sides: Record<string, string> = {
  low: " Objects of low values; cavities are what they enclose.",
  both: " Objects of high values (samples of at least an isovalue) and of low values (of at most one).",
};

/** Above the pictures: what it is, in a line. */
function head(page: Page): HTMLElement {
  const { volume } = page;
  const notes = page.notes?.length ?? 0;
  const link = notes > 0 ? html("a", { href: "#about" }, "How it was read") : null;
  const size = `${volume.size.join(" × ")} samples${volume.valueUnit ? `, values in ${volume.valueUnit}` : ""}. `;
  return html("header", {}, html("h1", {}, volume.name), html("p", {}, size, link), page.complete === false ? unfinished() : null);
}

/** Below them: what is known of the volume, and what was found in it. */
function about(page: Page): HTMLElement {
  const { volume } = page;
  const side = sides[page.polarity ?? "high"] ?? "";
  const spacing = volume.spacing && volume.unit ? `, voxels of ${volume.spacing.map(value).join(" × ")} ${volume.unit}` : "";
  const unit = volume.valueUnit ? ` ${volume.valueUnit}` : "";
  const range =
    volume.low === volume.high ? `all of them ${value(volume.low)}${unit}` : `values ${value(volume.low)} to ${value(volume.high)}${unit}`;
  const noise = volume.noise > 0 ? `, noise about ${value(Number(volume.noise.toPrecision(2)))}` : "";
  return html(
    "section",
    { class: "about", id: "about" },
    html("h2", {}, "About this volume"),
    html("p", {}, `${volume.size.join(" × ")} samples, ${volume.type}, ${range}${noise}${spacing}.${side}`),
    ...verdict(page).map((words) => html("p", {}, words)),
    ...(page.notes ?? []).map((words) => html("p", { class: "assumed" }, `Note: ${words}.`)),
  );
}

function verdict(page: Page): string[] {
  if (page.volume.low === page.volume.high) return ["All samples have the same value: there are no objects at any isovalue."];
  if (page.entries.length === 0) return ["No objects to show: all of them are below noise level."];
  const others = page.branches.some((branch) => branch.significant && branch.merges !== null);
  const noisy =
    1.1 * Math.sqrt(2 * Math.log(page.volume.size.reduce((p, q) => p * q, 1))) * page.volume.noise > page.volume.high - page.volume.low;
  if (!others && noisy)
    return [
      ...hiddenSentences(page),
      "The noise is as strong as the contrast of the volume: this may be only noise, whatever the picture shows.",
    ];
  return others
    ? hiddenSentences(page)
    : [...hiddenSentences(page), onlyLargest(page)];
}

function onlyLargest(page: Page): string {
  return page.polarity === "both"
    ? "Only the largest objects of high and of low values are significant: the pictures show them at several isovalues."
    : "Only the largest object is significant: the pictures show it at several isovalues.";
}

function hasCavities(page: Page): boolean {
  return page.entries.some((entry) => page.branches[entry.branch]?.side === "cavity");
}

function heading(page: Page): string {
  return hasCavities(page) ? "Objects and cavities" : "Objects";
}

/** Pictures above the chart. */
const FIRST = 5;

/** What the order of the cards means. */
function explanation(page: Page): string {
  if (page.polarity === "both")
    return (
      "Most important first, by contrast × size: how much its values differ from those around it, summed over its volume. " +
      "Numbers with “low” are objects of low values, such as lungs, pores, channels and cavities; background comes last."
    );
  const side = page.polarity === "low" ? "higher" : "lower";
  const cavities = hasCavities(page) ? ` Cavities are enclosed regions of ${side} values, drawn as the surface around them.` : "";
  const alike = page.entries.every(hasCard) ? "" : " Isovalues with 60 % of its voxels in common share a card.";
  const order = "Most important first, by contrast × size: how much its values differ from those around it, summed over its volume.";
  return order + alike + cavities;
}

function start(page: Page, main: HTMLElement): void {
  document.title = `${page.volume.name} – atlas`;
  const detail = new Detail(page);
  const open = (i: number): void => detail.open(i);
  const items = page.entries.map((_, i) => card(page, i, open));
  const all = page.entries.filter(hasCard).length;
  const first = html("ol", { class: "cards" });
  const cards = html("ol", { class: "cards", start: FIRST + 1 });
  const more = html("section", { class: "more" }, html("h2", {}, "More pictures"), cards);
  const field = scannedField();
  const status = html("p", { class: "message", role: "status" });
  const lanes = html("div", {});
  const rest = html("div", {});
  const counts = curves(page);
  const show = (choice: Choice): void => {
    const kept = chosenBranches(page, choice);
    const entries = chosenEntries(page, choice);
    const shown = cardsOf(page, entries);
    const shownItems = shown.cards.map((i) => items[i] as HTMLElement);
    first.replaceChildren(...shownItems.slice(0, FIRST));
    cards.replaceChildren(...shownItems.slice(FIRST));
    more.hidden = shownItems.length <= FIRST;
    field.show(shown.background.map((i) => items[i] as HTMLElement), shown.cards.length === 0);
    const hidden = all - shown.cards.length - shown.background.length;
    status.textContent = hidden > 0 ? `${count(all - hidden)} of ${count(all)} pictures shown` : "";
    lanes.replaceChildren(overview(page, kept, open));
    const pictured = new Set(page.entries.map((entry) => entry.branch));
    rest.replaceChildren(others(page, [...kept].filter((b) => !pictured.has(b))) ?? "");
    for (const { polarity, mark } of counts)
      mark([...kept].filter((b) => page.branches[b]?.side === "object" && page.branches[b].polarity === polarity).length);
  };
  main.append(head(page));
  const constant = page.volume.low === page.volume.high;
  if (items.length > 0 && !constant) {
    show(firstChoice(page));
    const { keep, filter } = controls(page, show);
    main.append(
      html("section", {}, html("h2", {}, heading(page)), first),
      html("section", { class: "panel" }, html("h2", {}, "Objects over the isovalue"), keep, filter, status, lanes),
      more,
      html("p", { class: "note" }, explanation(page)),
      rest,
      field.element,
    );
  }
  main.append(about(page), ...smoothing(page));
  const last = html("footer", {}, `isoatlas ${page.version}, interpolant ${page.interpolant}. This page loads nothing from elsewhere.`);
  main.append(spectrum(page) ?? "", ...(constant ? [] : counts.map(({ panel }) => panel)), glossary(page), last, detail.dialog);
  detail.openAt(location.hash);
}

const main = document.getElementById("atlas");
const text = document.getElementById("atlas-data")?.textContent ?? "null";
const data: unknown = JSON.parse(text);
const page = isLabelPage(data) ? null : readPage(text);
if (main && isLabelPage(data)) showLabels(data, main);
else if (main && page) {
  start(page, main);
  matchMedia(narrowScreens).addEventListener("change", () => {
    main.replaceChildren();
    start(page, main);
  });
} else main?.append(html("p", {}, "This page has no data."));
