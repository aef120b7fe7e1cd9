// Progress of the build, errors, pending requests, and loss of the connection.
import { html } from "../shared/dom";
import type { Page } from "../shared/page";
import { type Api, ServerError } from "./api/api";
import { detailsOf, progressOf, pendingText, type ServerState } from "./api/server_state";

const RETRY_DELAY = 2000;
/** no indicator for faster responses, in milliseconds */
const BUSY_DELAY = 400;

function connectionErrorText(error: unknown): string {
  if (!(error instanceof ServerError)) {
    const again = "Start it again and open its address; append the part behind # to restore this view.";
    return `Connection lost: isoatlas view has ended. ${again}`;
  }
  if (error.status !== 403) return error.message;
  const again = "Open a new address: isoatlas view prints one when it starts, and when you press Enter.";
  return `The token of this page is invalid: it belongs to an isoatlas view that has ended. ${again}`;
}

class LoadingCard {
  private readonly title = html("h1", {}, "Opening the volume");
  private readonly bar = html("progress", { max: 1, "aria-label": "progress of the build" });
  private readonly details = html("p", { role: "status" });
  private readonly card = html("div", { class: "waiting" }, this.title, this.bar, this.details);
  private readonly note = html("p", { class: "alert", role: "alert", hidden: true });
  private readonly busy = html("p", { class: "busy", hidden: true });
  private busyTimer = 0;

  constructor(
    main: HTMLElement,
    private readonly onOpen: () => void,
  ) {
    document.body.append(this.note, this.busy);
    main.append(this.card);
  }

  show({ state, build, error, requests }: ServerState): void {
    this.note.hidden = true;
    this.wait(pendingText(requests));
    if (state === "open") {
      this.title.textContent = "Opening the volume";
      this.bar.removeAttribute("value");
      this.details.textContent = "";
      this.onOpen();
    } else if (build) {
      this.title.textContent = progressOf(build);
      if (build.phase === "") this.bar.removeAttribute("value");
      else this.bar.value = build.fraction;
      this.bar.hidden = false;
      this.details.textContent = detailsOf(build);
    } else if (error) {
      this.title.textContent = "Building the store failed";
      this.bar.hidden = true;
      this.details.setAttribute("role", "alert");
      this.details.replaceChildren(error.message);
    }
    if (state !== "open") document.title = `${this.title.textContent} – isoatlas`;
  }

  end(): void {
    this.card.remove();
  }

  /** The connection failed, or the server rejected it. */
  disconnected(error: unknown): void {
    this.wait("");
    if (error instanceof ServerError) this.end();
    this.note.hidden = false;
    this.note.textContent = connectionErrorText(error);
  }

  private wait(text: string): void {
    this.busy.textContent = text;
    if (text === "") {
      clearTimeout(this.busyTimer);
      this.busyTimer = 0;
      this.busy.hidden = true;
    } else if (this.busyTimer === 0) {
      this.busyTimer = window.setTimeout(() => (this.busy.hidden = false), BUSY_DELAY);
    }
  }
}

/**
 * The page, as soon as the store is open; shows the progress of the build until then. Keeps the event stream open, so
 * that the server knows of this client.
 */
export async function waitForPage(api: Api, main: HTMLElement): Promise<Page> {
  let waiting: LoadingCard | undefined;
  await new Promise<void>((resolve) => {
    const own = (waiting = new LoadingCard(main, resolve));
    const listen = async (): Promise<void> => {
      try {
        for await (const state of api.events()) own.show(state);
        own.disconnected(null);
      } catch (error) {
        own.disconnected(error);
      }
      setTimeout(() => void listen(), RETRY_DELAY);
    };
    void listen();
  });
  try {
    return await api.page();
  } finally {
    waiting?.end();
  }
}
