// The page from top to bottom.
import { narrowScreens } from "./axis";
import { card } from "./card";
import { chosenBranches, chosenEntries, firstChoice, type Choice } from "./choice";
import { controls } from "./controls";
import { curve, hiddenWords } from "./curve";
import { Detail } from "./detail";
import { html } from "./dom";
import { count, value } from "./format";
import { glossary } from "./glossary";
import { isDark } from "./names";
import { others } from "./others";
import { overview } from "./overview";
import { readPage, type Page } from "./page";
import { spectrum } from "./spectrum";
import "./style.css";

function about(page: Page): HTMLElement {
  const { volume } = page;
  const spacing = volume.spacing && volume.unit ? `, voxels of ${volume.spacing.map(value).join(" × ")} ${volume.unit}` : "";
  const unit = volume.valueUnit ? ` ${volume.valueUnit}` : "";
  const range =
    volume.low === volume.high ? `all of them ${value(volume.low)}${unit}` : `values ${value(volume.low)} to ${value(volume.high)}${unit}`;
  const noise = volume.noise > 0 ? `, noise about ${value(Number(volume.noise.toPrecision(2)))}` : "";
  return html(
    "header",
    { class: "about" },
    html("h1", {}, volume.name),
    html("p", {}, `${volume.size.join(" × ")} samples, ${volume.type}, ${range}${noise}${spacing}.`),
    ...verdict(page).map((words) => html("p", {}, words)),
  );
}

function verdict(page: Page): string[] {
  if (page.volume.low === page.volume.high) return ["All samples have one value: there is nothing to tell apart, at no isovalue."];
  if (page.entries.length === 0) return ["There is nothing to show: noise explains all there is."];
  const others = page.branches.some((branch) => branch.standsOut && branch.merges !== null);
  const noisy =
    1.1 * Math.sqrt(2 * Math.log(page.volume.size.reduce((p, q) => p * q, 1))) * page.volume.noise > page.volume.high - page.volume.low;
  if (!others && noisy)
    return [
      ...hiddenWords(page),
      "The noise is as strong as all contrast there is: this may be nothing but noise, whatever the picture seems to show.",
    ];
  return others
    ? hiddenWords(page)
    : [...hiddenWords(page), "No object stands out beside the largest one: the pictures show what lies above some of its isovalues."];
}

function start(page: Page, main: HTMLElement): void {
  document.title = `${page.volume.name} – atlas`;
  const detail = new Detail(page);
  const open = (i: number): void => detail.open(i);
  const items = page.entries.map((_, i) => card(page, i, open));
  const bright = html("ol", { class: "cards" });
  const dark = html("ol", { class: "cards" });
  const darkPart = html(
    "section",
    { class: "dark-part" },
    html("h2", {}, "Dark objects"),
    html(
      "p",
      { class: "note" },
      "What is darker than all around it: cavities and pores inside an object. Each is shown as the wall around it.",
    ),
    dark,
  );
  const said = html("p", { class: "said", role: "status" });
  const lanes = html("div", {});
  const rest = html("div", {});
  const counts = curve(page);
  const show = (choice: Choice): void => {
    const kept = chosenBranches(page, choice);
    const entries = chosenEntries(page, choice);
    bright.replaceChildren(...entries.filter((i) => !isDark(page, i)).map((i) => items[i] as HTMLElement));
    dark.replaceChildren(...entries.filter((i) => isDark(page, i)).map((i) => items[i] as HTMLElement));
    darkPart.hidden = dark.children.length === 0;
    said.textContent = entries.length === items.length ? "" : `${count(entries.length)} of ${count(items.length)} pictures shown`;
    lanes.replaceChildren(overview(page, kept, open));
    const pictured = new Set(page.entries.map((entry) => entry.branch));
    rest.replaceChildren(others(page, [...kept].filter((b) => !pictured.has(b))) ?? "");
    counts?.mark([...kept].filter((b) => page.branches[b]?.side === "bright").length);
  };
  main.append(about(page));
  const constant = page.volume.low === page.volume.high;
  if (items.length > 0 && !constant) {
    show(firstChoice(page));
    const { keep, filter } = controls(page, show);
    main.append(
      html("section", { class: "panel" }, html("h2", {}, "Objects over the isovalue"), keep, lanes),
      html("section", {}, html("h2", {}, "Objects"), filter, said, bright),
      darkPart,
      rest,
    );
  }
  const last = html("footer", {}, `isoatlas ${page.version}, interpolant ${page.interpolant}. This page loads nothing from elsewhere.`);
  main.append(spectrum(page) ?? "", constant ? "" : (counts?.panel ?? ""), glossary(), last, detail.dialog);
  detail.openAt(location.hash);
}

const main = document.getElementById("atlas");
const page = readPage(document.getElementById("atlas-data")?.textContent ?? "null");
if (main && page) {
  start(page, main);
  matchMedia(narrowScreens).addEventListener("change", () => {
    main.replaceChildren();
    start(page, main);
  });
} else main?.append(html("p", {}, "This page has no data: isoatlas writes it with data."));
