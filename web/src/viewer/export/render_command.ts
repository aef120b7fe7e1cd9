// The `isoatlas render` command that draws the same view.
import { isCavity, referenceOf } from "../../shared/names";
import type { Page } from "../../shared/page";
import { colourOfShown, EVERYTHING } from "../api/entries";
import type { Shown } from "../state/state";
import { upText } from "../state/up_direction";

export interface Camera {
  /** six numbers: position and target */
  view: readonly number[];
  /** upwards in the picture: a unit vector */
  up: readonly number[];
  /** orthographic projection */
  flat: boolean;
  /** physical height of the picture at the target */
  height: number;
  /** removed half-space: points p with normal . p > offset; null: none */
  cut: { normal: readonly number[]; offset: number } | null;
}

const OPTIONS = ["--tau", "--object", "--contour", "--cavities"];

/** shown: as drawn, with the opacity of ghosts; invisible objects are omitted. size: pixels. beside: further options. */
export function renderCommand(
  page: Page,
  shown: readonly Shown[],
  camera: Camera,
  size: readonly [number, number],
  dark: boolean,
  beside: readonly string[] = [],
): string {
  const items = shown.filter(({ visible }) => visible).map((one) => ({ one, words: itemOf(page, one) }));
  items.sort((p, q) => OPTIONS.indexOf(p.words[0]) - OPTIONS.indexOf(q.words[0])); // colours and opacities follow this order
  const words = [`isoatlas render ${storeOf(page)}`, ...items.map(({ words: [option, what] }) => `${option} ${what}`)];
  words.push(
    ...items.map(({ one }) => `--colour '${colourOfShown(page, one).toUpperCase()}'`),
    ...items.map(({ one }) => `--opacity ${short(one.opacity)}`),
  );
  words.push(...beside);
  words.push(
    `--eye=${camera.view.slice(0, 3).map(short).join(",")}`,
    `--target=${camera.view.slice(3).map(short).join(",")}`,
    `--height ${short(camera.height)}`,
  );
  const up = upText(camera.up);
  if (up !== "z") words.push(`--up=${up}`);
  if (!camera.flat) words.push("--perspective");
  if (camera.cut) words.push(`--cut='${plane(camera.cut.normal)}>${short(camera.cut.offset)}'`);
  return [...words, `--size ${size.join("x")}`, ...(dark ? ["--background dark"] : []), "--plain", "-o scene.png"].join(" ");
}

function itemOf(page: Page, { entry, tau, walls }: Shown): [option: string, what: string] {
  if (entry === EVERYTHING) return ["--tau", String(tau)];
  const what = `${referenceOf(page, entry)}@${tau}`;
  if (isCavity(page, entry)) return ["--contour", what];
  return [walls === "cavities" ? "--cavities" : "--object", what];
}

/** The store, as in the commands of the page; one of both polarities with the option of this one. */
export function storeOf(page: Page): string {
  const line = page.entries.flatMap((entry) => entry.commands)[0]?.line ?? "";
  return /^isoatlas \w+ ((?:'[^']*'|\S+)(?: --polarity low)?)/.exec(line)?.[1] ?? `'${page.volume.name}.atlas'`;
}

function plane(normal: readonly number[]): string {
  const terms = normal
    .map((n, axis) => `${n < 0 ? "-" : "+"}${short(Math.abs(n))}${"xyz"[axis]}`)
    .filter((term) => !/^[+-]0[xyz]$/.test(term));
  return terms.join("").replace(/^\+/, "");
}

/** Plain decimal digits, without an exponent. */
function short(n: number): string {
  const rounded = Number(n.toPrecision(7));
  return Math.abs(rounded) < 1e-9 ? "0" : String(rounded);
}
