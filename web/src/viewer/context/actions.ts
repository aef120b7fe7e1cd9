// Actions of the viewer: each with its name, keys and menu. Keys, menus and help are generated from this list.
export type Group = "Objects" | "Isovalue" | "Scene" | "View" | "Tools" | "Export" | "Help";

export interface Action {
  group: Group;
  /** label in the menu */
  name: string;
  /** instead of the name in the menu, where half a line is enough: a part of the name */
  short?: string;
  /** values of KeyboardEvent.key, with "Ctrl+" in front where needed */
  keys?: string[];
  run(): void;
  /** of a toggle */
  isOn?(): boolean;
  /** does nothing without a connection */
  needsServer?: boolean;
}

export class Actions {
  readonly all: Action[] = [];

  /** problem: of the connection; empty: none. tell: says it. */
  constructor(
    private readonly problem: () => string = () => "",
    private readonly tell: (text: string) => void = () => undefined,
  ) {}

  /** Why it does nothing; empty: it works. */
  whyBlocked(action: Action): string {
    return action.needsServer ? this.problem() : "";
  }

  run(action: Action): void {
    const why = this.whyBlocked(action);
    if (why === "") action.run();
    else this.tell(`${action.name}: ${why}`);
  }

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
      this.run(action);
      event.preventDefault();
    });
    // A menu takes letters to search in it; who chose with a pointer has done that, and means the keys of the viewer.
    let byPointer = false;
    target.addEventListener("pointerdown", () => (byPointer = true), true);
    target.addEventListener("keydown", () => (byPointer = false), true);
    target.addEventListener("change", (event) => {
      if (byPointer && event.target instanceof HTMLSelectElement) event.target.blur();
    });
  }
}

/** Such as "x", "X", "ArrowLeft", "Ctrl+z", "Ctrl+Shift+z". */
export function keyOf(event: { key: string; ctrlKey: boolean; metaKey: boolean; shiftKey: boolean }): string {
  if (!event.ctrlKey && !event.metaKey) return event.key;
  return `Ctrl+${event.shiftKey ? "Shift+" : ""}${event.key.toLowerCase()}`;
}

/** Text fields and menus take all keys, sliders those that move them, checkboxes and radio buttons the space bar. */
function isTyping(event: KeyboardEvent): boolean {
  const { target } = event;
  if (target instanceof HTMLInputElement) {
    if (target.type === "range") return /^(Arrow|Page|Home$|End$)/.test(event.key);
    return !["checkbox", "radio", "button", "color"].includes(target.type) || event.key === " ";
  }
  return target instanceof HTMLSelectElement || target instanceof HTMLTextAreaElement;
}
