// The services that all parts of the viewer use.
import type { Page } from "../../shared/page";
import type { Actions } from "./actions";
import type { Api } from "../api/api";
import type { Catalogue } from "../api/catalogue";
import type { ObjectNames } from "../api/object_names";
import type { TransferProposal } from "../api/transfer_proposal";
import type { Pictures } from "../api/pictures";
import type { PanelSwitch } from "../panels/panel_switch";
import type { Editor } from "./editor";
import type { Scene } from "../scene/scene";
import type { Viewport } from "../scene/viewport";
import type { History } from "../state/history";
import type { Shown, State } from "../state/state";

export interface ViewerContext {
  readonly page: Page;
  readonly catalogue: Catalogue;
  readonly api: Api;
  readonly viewport: Viewport;
  readonly history: History;
  readonly actions: Actions;
  readonly editor: Editor;
  readonly names: ObjectNames;
  readonly pictures: Pictures;
  readonly proposal: TransferProposal;
  readonly panels: PanelSwitch;
  readonly scene: Scene;
  /** element over the canvas, for overlays */
  readonly overlay: HTMLElement;
  /** status line; empty: clears it */
  notify(text: string): void;
  /** reports an error in the status line, unless the request was superseded */
  reportError(error: unknown): void;
}

export function selectedOf({ shown, selected }: State): Shown | undefined {
  return shown[selected];
}

/** Downloads a file in the browser. */
export function downloadBlob(blob: Blob, name: string): void {
  const address = URL.createObjectURL(blob);
  const link = document.createElement("a");
  link.href = address;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}
