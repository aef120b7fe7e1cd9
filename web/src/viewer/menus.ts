// Menus of all actions by group, and the list of keys ('?').
import { html } from "../shared/dom";
import type { Action, Actions, Group } from "./context/actions";
import { markBlocked } from "./context/needs_server";
import { icon, placed, type Placed } from "./menu_layout";

const GROUPS: Group[] = ["Objects", "Isovalue", "Scene", "View", "Tools", "Export", "Help"];
const SIGNS: Record<string, string> = { ArrowLeft: "←", ArrowRight: "→", ArrowUp: "↑", ArrowDown: "↓", " ": "space" };
/** interactions that are not actions */
const GESTURES: [string, string][] = [
  ["click", "on a card, line or dot: isolate the object; in 3D: select it"],
  ["shift and click", "on a card, line or dot: add or remove the object"],
  ["Enter", "in the text field: apply the isovalue"],
  ["drag with the right or middle button", "on a slice: to the right a wider window, down a higher level"],
  ["drag with Ctrl or Alt", "on a slice: the same"],
];

function signsOf({ keys }: Action): string {
  return (keys ?? []).map((key) => SIGNS[key] ?? key.replaceAll("+", " ")).join(", ");
}

/** A menu for every group that has actions; rebuilt when opened, to show the current state of toggles. */
export function menus(actions: Actions): HTMLElement {
  const bar = html("div", { class: "menus", role: "toolbar", "aria-label": "menus" });
  const close = (): void => bar.querySelectorAll("details[open]").forEach((menu) => menu.removeAttribute("open"));
  for (const group of GROUPS) {
    const list = html("div", { class: "box" });
    const menu = html("details", { name: "menu" }, html("summary", {}, group), list);
    menu.addEventListener("toggle", () => {
      const own = actions.all.filter((action) => action.group === group);
      list.replaceChildren(...placed(group, own).flatMap((section, at) => sectionOf(actions, section, `menu-${group}-${at}`, close)));
    });
    bar.append(menu);
  }
  document.addEventListener("click", (event) => !bar.contains(event.target as Node) && close());
  bar.addEventListener("keydown", (event) => {
    const open = bar.querySelector<HTMLElement>("details[open]");
    if (event.key === "ArrowDown" || event.key === "ArrowUp") return walk(event, open);
    if (event.key !== "Escape") return;
    close();
    open?.querySelector("summary")?.focus();
  });
  return bar;
}

/** Its heading and its actions. */
function sectionOf(all: Actions, { title, actions }: Placed<Action>, id: string, done: () => void): HTMLElement[] {
  const items = actions.map(([action, name]) => html("li", { class: action.short && "half" }, buttonOf(all, action, icon(name), done)));
  return [html("p", { id }, title), html("ul", { "aria-labelledby": id }, ...items)];
}

/** Moves the focus in an open menu, cyclically. */
function walk(event: KeyboardEvent, open: HTMLElement | null): void {
  if (!open) return;
  const buttons = [...open.querySelectorAll("button")];
  const at = buttons.findIndex((button) => button === document.activeElement);
  const to = event.key === "ArrowDown" ? at + 1 : at < 0 ? -1 : at - 1;
  buttons.at(to % buttons.length)?.focus();
  event.preventDefault();
  event.stopPropagation(); // otherwise the camera turns
}

function buttonOf(actions: Actions, action: Action, sign: SVGSVGElement, done: () => void): HTMLElement {
  const run = (): void => {
    done();
    actions.run(action);
  };
  const parts = [sign, html("span", {}, ...shortened(action)), html("kbd", {}, signsOf(action))];
  const button = html("button", { type: "button", click: run }, ...parts);
  if (action.isOn) button.setAttribute("aria-pressed", String(action.isOn()));
  markBlocked(button, actions.whyBlocked(action));
  return button;
}

/** Its name; what is left out of a short one is there for screen readers. */
function shortened({ name, short }: Action): (Node | string)[] {
  const at = short === undefined ? -1 : name.indexOf(short);
  if (short === undefined || at < 0) return [name];
  const unseen = (text: string): Node => html("span", { class: "unseen" }, text);
  return [unseen(name.slice(0, at)), short, unseen(name.slice(at + short.length))];
}

export function help(actions: Actions): HTMLDialogElement {
  const lists = html("div", { class: "groups" });
  const title = html("h2", { tabindex: -1, autofocus: true }, "Keyboard shortcuts");
  const dialog = html("dialog", { class: "help", "aria-label": "keys" }, title, lists);
  dialog.append(html("button", { type: "button", click: () => dialog.close() }, "Close"));
  const show = (): void => {
    const keyed = (group: Group): [string, string][] =>
      actions.all.filter((action) => action.group === group && action.keys).map((action) => [signsOf(action), action.name]);
    const groups: [string, [string, string][]][] = [
      ...GROUPS.map((group): [string, [string, string][]] => [group, keyed(group)]),
      ["Mouse and text fields", GESTURES],
    ];
    lists.replaceChildren(...groups.filter(([, keys]) => keys.length > 0).map(([title, keys]) => keyList(title, keys)));
    dialog.showModal();
    dialog.scrollTop = 0; // the button that takes the focus is at its end
  };
  actions.add({ group: "Help", name: "Keyboard shortcuts", keys: ["?"], run: show });
  return dialog;
}

function keyList(title: string, keys: [string, string][]): HTMLElement {
  return html(
    "section",
    {},
    html("h3", {}, title),
    html("dl", {}, ...keys.flatMap(([key, what]) => [html("dt", {}, key), html("dd", {}, what)])),
  );
}
