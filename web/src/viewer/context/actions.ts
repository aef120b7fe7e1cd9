// Actions of the viewer: each with its name, keys and menu. Keys, menus and help are generated from this list.
export type Group = "Objects" | "Isovalue" | "Scene" | "View" | "Tools" | "Export" | "Help";

export interface Action {
  group: Group;
  /** label in the menu */
  name: string;
  /** values of KeyboardEvent.key, with "Ctrl+" in front where needed */
  keys?: string[];
  run(): void;
  /** of a toggle */
  isOn?(): boolean;
}

export class Actions {
  readonly all: Action[] = [];

  add(...actions: Action[]): void {
    this.all.push(...actions);
  }

  /** Runs the action of a pressed key, unless text is being typed or the focused element handles the key itself. */
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

/** Sliders handle arrow keys, text fields handle all keys, checkboxes handle only space. */
function isTyping(event: KeyboardEvent): boolean {
  const { target } = event;
  if (target instanceof HTMLInputElement) return target.type !== "checkbox" || event.key === " ";
  return target instanceof HTMLSelectElement || target instanceof HTMLTextAreaElement;
}
