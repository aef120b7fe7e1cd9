// All actions by group, to be found without knowing a key; and all keys, on '?'.
import { html } from "../dom";
import type { Action, Actions, Group } from "./desk/actions";

const GROUPS: Group[] = ["Objects", "Isovalue", "Scene", "Look", "Tools", "Save", "Help"];
const SIGNS: Record<string, string> = { ArrowLeft: "←", ArrowRight: "→", ArrowUp: "↑", ArrowDown: "↓", " ": "space" };
/** what is done without an action */
const GESTURES: [string, string][] = [
  ["click", "a card, a line or a dot: show this object alone; in the picture: select"],
  ["shift and click", "a card, a line or a dot: add this object, or take it out"],
  ["Enter", "in the box: use this isovalue"],
];

function signsOf({ keys }: Action): string {
  return (keys ?? []).map((key) => SIGNS[key] ?? key.replaceAll("+", " ")).join(", ");
}

/** A menu for every group that has actions; made anew when it is opened, so that it says what is on. */
export function menus(actions: Actions): HTMLElement {
  const bar = html("div", { class: "menus", role: "toolbar", "aria-label": "menus" });
  const close = (): void => bar.querySelectorAll("details[open]").forEach((menu) => menu.removeAttribute("open"));
  for (const group of GROUPS) {
    const list = html("ul", {});
    const menu = html("details", { name: "menu" }, html("summary", {}, group), list);
    menu.addEventListener("toggle", () => {
      const own = actions.all.filter((action) => action.group === group);
      list.replaceChildren(...own.map((action) => html("li", {}, buttonOf(action, close))));
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

/** Up and down in an open menu, round and round. */
function walk(event: KeyboardEvent, open: HTMLElement | null): void {
  if (!open) return;
  const buttons = [...open.querySelectorAll("button")];
  const at = buttons.findIndex((button) => button === document.activeElement);
  const to = event.key === "ArrowDown" ? at + 1 : at < 0 ? -1 : at - 1;
  buttons.at(to % buttons.length)?.focus();
  event.preventDefault();
  event.stopPropagation(); // else the picture turns
}

function buttonOf(action: Action, done: () => void): HTMLElement {
  const run = (): void => {
    done();
    action.run();
  };
  const button = html("button", { type: "button", click: run }, html("span", {}, action.name), html("kbd", {}, signsOf(action)));
  if (action.isOn) button.setAttribute("aria-pressed", String(action.isOn()));
  return button;
}

export function help(actions: Actions): HTMLDialogElement {
  const lists = html("div", { class: "groups" });
  const dialog = html("dialog", { class: "help", "aria-label": "keys" }, html("h2", {}, "Keys"), lists);
  dialog.append(html("button", { type: "button", click: () => dialog.close() }, "Close"));
  const show = (): void => {
    const keyed = (group: Group): [string, string][] =>
      actions.all.filter((action) => action.group === group && action.keys).map((action) => [signsOf(action), action.name]);
    const groups: [string, [string, string][]][] = [
      ...GROUPS.map((group): [string, [string, string][]] => [group, keyed(group)]),
      ["Without a menu", GESTURES],
    ];
    lists.replaceChildren(...groups.filter(([, keys]) => keys.length > 0).map(([title, keys]) => keyList(title, keys)));
    dialog.showModal();
  };
  actions.add({ group: "Help", name: "all keys", keys: ["?"], run: show });
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
