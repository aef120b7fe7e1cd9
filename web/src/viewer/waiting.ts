// While there is nothing to show, or not yet: how far a build is, why it failed, what a question waits for, and that the server has gone.
import { html } from "../dom";
import type { Page } from "../page";
import { type Api, Refusal } from "./ask/api";
import { detailsOf, progressOf, waitingFor, type ServerState } from "./ask/server_state";

const AGAIN = 2000;
/** an answer that comes sooner needs no words */
const SOON = 400;

function lossOf(error: unknown): string {
  if (!(error instanceof Refusal)) {
    const again = "Start isoatlas view again and open its address; the part behind # shows the same there.";
    return `The viewer has ended: nothing new can be shown. ${again}`;
  }
  if (error.status !== 403) return error.message;
  const again = "Open a new address: isoatlas view prints one when it starts, and at Enter.";
  return `The token of this page is wrong: it belongs to a viewer that has ended. ${again}`;
}

class Waiting {
  private readonly title = html("h1", {}, "Opening the volume");
  private readonly bar = html("progress", { max: 1, "aria-label": "how much of the store is built" });
  private readonly details = html("p", { role: "status" });
  private readonly card = html("div", { class: "waiting" }, this.title, this.bar, this.details);
  private readonly note = html("p", { class: "alert", role: "alert", hidden: true });
  private readonly busy = html("p", { class: "busy", hidden: true });
  private soon = 0;

  constructor(
    main: HTMLElement,
    private readonly opened: () => void,
  ) {
    document.body.append(this.note, this.busy);
    main.append(this.card);
  }

  show({ state, build, error, questions }: ServerState): void {
    this.note.hidden = true;
    this.wait(waitingFor(questions));
    if (state === "open") {
      this.title.textContent = "Opening the volume";
      this.bar.removeAttribute("value");
      this.details.textContent = "";
      this.opened();
    } else if (build) {
      this.title.textContent = progressOf(build);
      if (build.phase === "") this.bar.removeAttribute("value");
      else this.bar.value = build.fraction;
      this.bar.hidden = false;
      this.details.textContent = detailsOf(build);
    } else if (error) {
      this.title.textContent = "The store could not be built";
      this.bar.hidden = true;
      this.details.setAttribute("role", "alert");
      this.details.replaceChildren(error.message);
    }
    if (state !== "open") document.title = `${this.title.textContent} – isoatlas`;
  }

  end(): void {
    this.card.remove();
  }

  /** The server does not answer, or refuses to. */
  lose(error: unknown): void {
    this.wait("");
    if (error instanceof Refusal) this.end();
    this.note.hidden = false;
    this.note.textContent = lossOf(error);
  }

  private wait(text: string): void {
    this.busy.textContent = text;
    if (text === "") {
      clearTimeout(this.soon);
      this.soon = 0;
      this.busy.hidden = true;
    } else if (this.soon === 0) {
      this.soon = window.setTimeout(() => (this.busy.hidden = false), SOON);
    }
  }
}

/**
 * What there is to show, as soon as there is a store; shows until then how far it is. Listens on, so that the server knows that somebody is
 * here.
 */
export async function pageWhenThere(api: Api, main: HTMLElement): Promise<Page> {
  let waiting: Waiting | undefined;
  await new Promise<void>((resolve) => {
    const own = (waiting = new Waiting(main, resolve));
    const listen = async (): Promise<void> => {
      try {
        for await (const state of api.events()) own.show(state);
        own.lose(null);
      } catch (error) {
        own.lose(error);
      }
      setTimeout(() => void listen(), AGAIN);
    };
    void listen();
  });
  try {
    return await api.page();
  } finally {
    waiting?.end();
  }
}
