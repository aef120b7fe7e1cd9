// Progress of the build, errors, pending requests, and loss of the connection.
import { html } from "../shared/dom";
import type { Page } from "../shared/page";
import { type Api, ServerError } from "./api/api";
import { detailsOf, progressOf, pendingText, type ServerState } from "./api/server_state";

const RETRY_DELAY = 2000;
/** no indicator for faster responses, in milliseconds */
const BUSY_DELAY = 400;

function connectionErrorText(error: unknown, isInFrame: boolean): string {
  if (isInFrame && !(error instanceof ServerError && error.status !== 403)) {
    return "Connection lost: the notebook has closed this view or has ended. Run its cell again.";
  }
  if (!(error instanceof ServerError)) {
    return "Connection lost: isoatlas view has ended. When it runs again, this page continues.";
  }
  if (error.status !== 403) return error.message;
  const again = "Open a new address: isoatlas view prints one when it starts, and when you press Enter; this page then continues.";
  return `The token of this page is invalid: it belongs to an isoatlas view that has ended. ${again}`;
}

/** The key of this browser, issued by the server; every request carries it in addition to a cookie. */
export function ownKey(): string {
  try {
    return localStorage.getItem("isoatlas") ?? "";
  } catch {
    return ""; // storage is disabled; the server responds with an explanation
  }
}

/** The key of a page in a frame, from its head, where it does not stay; empty: the page is in a tab. */
export function takeFrameKey(): string {
  const key = document.querySelector<HTMLMetaElement>("meta[name=isoatlas-frame]");
  key?.remove();
  return key?.content ?? "";
}

/** Equal for pages that call the same objects by the same numbers. */
function identityOf({ volume, entries, branches }: Page): string {
  const { name, size, unit } = volume;
  return JSON.stringify([name, size, unit, entries.map(({ id, tau }) => [id, tau]), branches.length]);
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
    private readonly isInFrame: boolean,
    volumes: HTMLElement | null,
    private readonly onOpen: () => void,
  ) {
    document.body.append(this.note, this.busy);
    if (volumes) this.card.append(volumes);
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

  /** The server of this address has been started with another store. */
  replaced(name: string): void {
    this.wait("");
    const reload = (): void => {
      history.replaceState(null, "", location.pathname); // this view is of the earlier volume
      location.reload();
    };
    const button = html("button", { type: "button", click: reload }, "Reload");
    this.note.replaceChildren(`The server now shows another volume, ${name}; reload the page to see it. `, button);
    this.note.hidden = false;
  }

  /** The connection failed, or the server rejected it. */
  disconnected(error: unknown): void {
    this.wait("");
    if (error instanceof ServerError) this.end();
    this.note.hidden = false;
    this.note.textContent = connectionErrorText(error, this.isInFrame);
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
 * that the server knows of this client. volumes: menus that are there meanwhile.
 */
export async function waitForPage(api: Api, main: HTMLElement, volumes: HTMLElement | null): Promise<Page> {
  let waiting: LoadingCard | undefined;
  let identity = "";
  await new Promise<void>((resolve) => {
    const own = (waiting = new LoadingCard(main, api.isInFrame, volumes, resolve));
    const listen = async (): Promise<void> => {
      try {
        for await (const state of api.events()) {
          own.show(state);
          api.connection.setScene(state.scene);
          if (state.state === "open" && api.connection.state !== "up") await reconnect(api, own, identity);
        }
        own.disconnected(null);
      } catch (error) {
        own.disconnected(error);
      }
      api.connection.set("lost");
      api.takeKey(ownKey());
      setTimeout(() => void listen(), RETRY_DELAY);
    };
    void listen();
  });
  try {
    const page = await api.page();
    identity = identityOf(page);
    return page;
  } finally {
    waiting?.end();
  }
}

/** identity: of the page that is shown; empty: none yet. */
async function reconnect(api: Api, card: LoadingCard, identity: string): Promise<void> {
  if (identity === "") return api.connection.set("up");
  const page = await api.page();
  const isSame = identityOf(page) === identity;
  api.connection.set(isSame ? "up" : "other");
  if (!isSame) card.replaced(page.volume.name);
}
