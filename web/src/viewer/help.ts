// All keys, on '?'.
import { html } from "../dom";

const KEYS: [string, string][] = [
  ["[ ]", "isovalue down, up"],
  ["{ }", "to where the next object that matters ends, begins"],
  ["arrows", "turn"],
  ["x y z, X Y Z", "look along an axis, or against it"],
  ["o", "with perspective or without"],
  ["c", "cut everything open, from where you look"],
  ["b", "edges of the volume"],
  ["t", "all objects over the isovalue: choose one"],
  ["f", "all that is shown in the middle"],
  ["Delete", "hide what is selected"],
  ["Ctrl Z, Ctrl Shift Z", "undo, redo"],
  ["?", "these keys"],
  ["click", "in the list: show this object alone; in the picture: select"],
  ["shift and click", "in the list: add this object, or take it out"],
  ["Enter", "in the box: use this isovalue"],
];

export function help(): HTMLDialogElement {
  const rows = KEYS.flatMap(([key, what]) => [html("dt", {}, key), html("dd", {}, what)]);
  const dialog = html("dialog", { class: "help", "aria-label": "keys" }, html("h2", {}, "Keys"), html("dl", {}, ...rows));
  dialog.append(html("button", { type: "button", click: () => dialog.close() }, "Close"));
  return dialog;
}
