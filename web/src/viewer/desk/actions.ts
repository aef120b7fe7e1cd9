// What a reader can do: each thing once, with its name, its keys and the menu it stands in. Keys, menus and help are made from this list.
export type Group = "Objects" | "Isovalue" | "Scene" | "Look" | "Tools" | "Save" | "Help";

export interface Action {
  group: Group;
  /** as it stands in a menu, such as "cut open or close" */
  name: string;
  /** as KeyboardEvent.key has them; "Ctrl+" before those that need it */
  keys?: string[];
  run(): void;
  /** of what is either on or off */
  isOn?(): boolean;
}

export class Actions {
  readonly all: Action[] = [];

  add(...actions: Action[]): void {
    this.all.push(...actions);
  }

  /** The action of a key, where nothing is being typed and what has the focus has no use for it. */
  listen(target: Document): void {
    target.addEventListener("keydown", (event) => {
      const key = keyOf(event);
      const action = this.all.find(({ keys }) => keys?.includes(key));
      if (
        !action ||
        event.defaultPrevented ||
        event.altKey ||
        (isTyping(event) && !key.startsWith("Ctrl+")) ||
        target.querySelector("dialog[open]")
      )
        return;
      action.run();
      event.preventDefault();
    });
  }
}

/** Such as "x", "X", "ArrowLeft", "Ctrl+z", "Ctrl+Shift+z". */
export function keyOf(event: { key: string; ctrlKey: boolean; metaKey: boolean; shiftKey: boolean }): string {
  if (!event.ctrlKey && !event.metaKey) return event.key;
  return `Ctrl+${event.shiftKey ? "Shift+" : ""}${event.key.toLowerCase()}`;
}

/** A slider takes arrows, a box of text takes all; a checkbox takes nothing but the space. */
function isTyping(event: KeyboardEvent): boolean {
  const { target } = event;
  if (target instanceof HTMLInputElement) return target.type !== "checkbox" || event.key === " ";
  return target instanceof HTMLSelectElement || target instanceof HTMLTextAreaElement;
}
