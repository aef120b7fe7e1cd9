// What every part of the viewer works with.
import type { Page } from "../../page";
import type { Actions } from "./actions";
import type { Api } from "../ask/api";
import type { Catalogue } from "../ask/catalogue";
import type { Editor } from "./editor";
import type { Scene } from "./scene";
import type { Stage } from "../draw/stage";
import type { History } from "../state/history";
import type { Shown, State } from "../state/state";

export interface Desk {
  readonly page: Page;
  readonly catalogue: Catalogue;
  readonly api: Api;
  readonly stage: Stage;
  readonly history: History;
  readonly actions: Actions;
  readonly editor: Editor;
  readonly scene: Scene;
  /** over the picture, for what belongs to it */
  readonly overlay: HTMLElement;
  /** one line for the reader; empty: nothing to say */
  say(text: string): void;
  /** says what went wrong, unless something newer has ended it */
  fail(error: unknown): void;
}

export function selectedOf({ shown, selected }: State): Shown | undefined {
  return shown[selected];
}

/** Gives the reader a file. */
export function keep(blob: Blob, name: string): void {
  const address = URL.createObjectURL(blob);
  const link = document.createElement("a");
  link.href = address;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}
