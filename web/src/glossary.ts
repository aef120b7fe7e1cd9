// The words of this page.
import { html } from "./dom";

const words: [string, string][] = [
  ["Isovalue", "A threshold. Everything at least as bright belongs to an object; the surface between is the isosurface."],
  ["Object", "A connected piece of what is at least as bright as the isovalue. Each one is on its own for a range of isovalues, then merges into a larger one."],
  ["Dark object", "The same from below: a connected piece of what is darker, such as a cavity or a vessel without contrast agent."],
  ["Best isovalue", "Where the size of the object changes least when the isovalue changes: the edge is sharpest there."],
  ["Tunnel", "A way through an object, like the hole of a ring or the handle of a cup."],
  ["Cavity", "A closed empty space inside an object that cannot be reached from outside."],
  ["Contrast × size", "How far the object stands out of what it merges into, summed over its voxels. Objects are ranked by it."],
  ["Noise", "Very many tiny objects are in every measured volume. Those that noise alone explains are left out of this page, not out of the store."],
];

export function glossary(): HTMLElement {
  return html(
    "details",
    { class: "panel glossary" },
    html("summary", {}, "What the words mean"),
    html("dl", {}, ...words.flatMap(([word, meaning]) => [html("dt", {}, word), html("dd", {}, meaning)])),
  );
}
