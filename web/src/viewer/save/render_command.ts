// The command line that draws the same scene from the same place: `isoatlas render`.
import { isDark } from "../../names";
import { entryOf, type Page } from "../../page";
import { colourOfShown, EVERYTHING } from "../ask/shown";
import type { Shown } from "../state/state";

export interface Camera {
  /** six numbers: where it stands and what it looks at */
  view: readonly number[];
  /** without perspective */
  flat: boolean;
  /** physical, of the picture at what it looks at */
  height: number;
  /** what is cut away: points p with normal . p > offset; null: nothing */
  cut: { normal: readonly number[]; offset: number } | null;
}

const OPTIONS = ["--tau", "--object", "--contour", "--cavities"];

/** shown: as drawn, so with the opacity of a ghost; what is not visible is left out. size: pixels. beside: words for what is no surface. */
export function renderCommand(
  page: Page,
  shown: readonly Shown[],
  camera: Camera,
  size: readonly [number, number],
  dark: boolean,
  beside: readonly string[] = [],
): string {
  const things = shown.filter(({ visible }) => visible).map((one) => ({ one, words: thing(page, one) }));
  things.sort((p, q) => OPTIONS.indexOf(p.words[0]) - OPTIONS.indexOf(q.words[0])); // colours and opacities go by this order
  const words = [`isoatlas render ${storeOf(page)}`, ...things.map(({ words: [option, what] }) => `${option} ${what}`)];
  words.push(
    ...things.map(({ one }) => `--colour '${colourOfShown(page, one).toUpperCase()}'`),
    ...things.map(({ one }) => `--opacity ${short(one.opacity)}`),
  );
  words.push(...beside);
  words.push(
    `--eye=${camera.view.slice(0, 3).map(short).join(",")}`,
    `--target=${camera.view.slice(3).map(short).join(",")}`,
    `--height ${short(camera.height)}`,
  );
  if (!camera.flat) words.push("--perspective");
  if (camera.cut) words.push(`--cut='${plane(camera.cut.normal)}>${short(camera.cut.offset)}'`);
  return [...words, `--size ${size.join("x")}`, ...(dark ? ["--background dark"] : []), "--plain", "-o scene.png"].join(" ");
}

function thing(page: Page, { entry, tau, walls }: Shown): [option: string, what: string] {
  if (entry === EVERYTHING) return ["--tau", String(tau)];
  const what = `${entryOf(page, entry).id}@${tau}`;
  if (isDark(page, entry)) return ["--contour", what];
  return [walls === "cavities" ? "--cavities" : "--object", what];
}

/** The store as the commands of the page name it. */
export function storeOf(page: Page): string {
  const line = page.entries.flatMap((entry) => entry.commands)[0]?.line ?? "";
  return /^isoatlas \w+ ('[^']*'|\S+)/.exec(line)?.[1] ?? `'${page.volume.name}.atlas'`;
}

function plane(normal: readonly number[]): string {
  const terms = normal
    .map((n, axis) => `${n < 0 ? "-" : "+"}${short(Math.abs(n))}${"xyz"[axis]}`)
    .filter((term) => !/^[+-]0[xyz]$/.test(term));
  return terms.join("").replace(/^\+/, "");
}

/** As plain digits: no exponent, which a shell need not know. */
function short(n: number): string {
  const rounded = Number(n.toPrecision(7));
  return Math.abs(rounded) < 1e-9 ? "0" : String(rounded);
}
