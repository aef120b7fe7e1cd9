// Strong noise: what smoothing would change, side by side, and the command that makes the page of the smoothed volume.
import { html } from "../shared/dom";
import { plural, value } from "../shared/format";
import type { Page, Smoothed } from "../shared/page";
import { turntable } from "../shared/turntable";

function figure(name: string, shown: Smoothed, tau: number): HTMLElement {
  const words = `${plural(shown.objects, "object")}, ${plural(shown.tunnels, "tunnel")}`;
  return html(
    "figure",
    {},
    shown.picture ? turntable(shown.picture, `Everything at ${value(tau)} ${name}: ${words}`) : null,
    html("figcaption", {}, html("strong", {}, name), ` ${words}`),
  );
}

export function smoothing(page: Page): HTMLElement[] {
  if (!page.smoothing) return [];
  const { noisePart, sigma, command, comparison } = page.smoothing;
  const part = value(Number((100 * noisePart).toPrecision(2)));
  return [
    html(
      "section",
      { class: "panel smoothing" },
      html("h2", {}, "Smoothed beside"),
      html(
        "p",
        { class: "assumed" },
        `The noise is ${part} % of the range of values: objects are ragged and may be joined. `,
        "A page of the smoothed volume beside this one: ",
        html("code", {}, command),
      ),
      comparison &&
        html(
          "div",
          { class: "pair" },
          figure("as it is", comparison.asItIs, comparison.tau),
          figure(`smoothed with --gaussian ${sigma}`, comparison.smooth, comparison.tau),
        ),
      comparison && html("p", { class: "note" }, `Both are everything at the isovalue ${value(comparison.tau)}.`),
    ),
  ];
}
