// The terms of this page.
import { html } from "../shared/dom";
import type { Page } from "../shared/page";

const terms: [string, string][] = [
  ["Isovalue", "A threshold: objects are connected components of values ≥ isovalue; the isosurface is their boundary."],
  [
    "Object",
    "A connected component of the superlevel set (values ≥ isovalue)." +
      " It exists for a range of isovalues, then merges into a larger one: a branch of the merge tree.",
  ],
  [
    "Cavity",
    "A connected region of lower values, enclosed by higher ones, such as a void, a pore, or the pulp of a tooth." +
      " It grows with the isovalue, until it merges with another cavity or opens to the outside.",
  ],
  [
    "Isovalue of an object",
    "One object looks different at different isovalues: skin, then bone inside it." +
      " Recommended are those where its size changes least with the isovalue (MSER stability): its edge is sharpest there.",
  ],
  ["Exists", "The isovalues between its appearance and its merge into another object."],
  ["Tunnel", "A hole through an object, like that of a ring or of the handle of a cup."],
  ["Contrast × size", "Contrast to the object that it merges into, summed over its voxels (hypervolume). Objects are ranked by it."],
  ["Significant", "Above noise level, and not very small compared to the largest object."],
  ["Noise", "Measured volumes contain very many tiny objects. Those below noise level are left out of this page, not out of the store."],
];

const ofBoth: [string, string][] = [
  ["Isovalue", "A threshold. Objects of high values consist of samples of at least it, objects of low values of samples of at most it."],
  [
    "Object of low values",
    "A connected set of samples of at most the isovalue: lungs, pores, channels." +
      " It appears at its lowest value and grows with the isovalue." +
      " It may reach the border of the volume; one that does not is a cavity of an object of high values.",
  ],
];

export function glossary(page: Page): HTMLElement {
  const own = page.polarity === "both" ? ofBoth : [];
  const shown = [...own, ...terms.filter(([term]) => !own.some(([name]) => name === term) && !(own.length > 0 && term === "Cavity"))];
  return html(
    "details",
    { class: "panel glossary" },
    html("summary", {}, "Glossary"),
    html("dl", {}, ...shown.flatMap(([term, meaning]) => [html("dt", {}, term), html("dd", {}, meaning)])),
  );
}
