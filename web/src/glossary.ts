// The words of this page.
import { html } from "./dom";

const words: [string, string][] = [
  ["Isovalue", "A threshold. Everything at least as bright belongs to an object; the surface between is the isosurface."],
  [
    "Object",
    "A connected piece of what is at least as bright as the isovalue." +
      " Each one is on its own for a range of isovalues, then merges into a larger one.",
  ],
  [
    "Dark object",
    "The same from below: a connected piece of what is darker than all around it, such as a cavity, a pore, the pulp of a tooth." +
      " It grows when the isovalue rises, until it merges with another one or opens to the outside.",
  ],
  [
    "Shown at",
    "One object looks different at different isovalues: skin, then bone inside it." +
      " Recommended are those where its size changes least when the isovalue changes, because the edge is sharpest there.",
  ],
  ["On its own", "The isovalues at which it is a piece of its own, before it merges into another."],
  ["Tunnel", "A way through an object, like the hole of a ring or the handle of a cup."],
  ["Cavity", "A closed empty space inside an object that cannot be reached from outside."],
  ["Contrast × size", "How far the object stands out of what it merges into, summed over its voxels. Objects are ranked by it."],
  ["Stands out", "Noise alone does not explain it, and it is not tiny beside the largest."],
  [
    "Noise",
    "Very many tiny objects are in every measured volume. Those that noise alone explains are left out of this page, not out of the store.",
  ],
];

export function glossary(): HTMLElement {
  return html(
    "details",
    { class: "panel glossary" },
    html("summary", {}, "What the words mean"),
    html("dl", {}, ...words.flatMap(([word, meaning]) => [html("dt", {}, word), html("dd", {}, meaning)])),
  );
}
