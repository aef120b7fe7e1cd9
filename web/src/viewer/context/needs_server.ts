// Controls that need the server: without a connection they are disabled, and say why.
import type { Connection } from "../api/connection";

export function whileConnected<E extends HTMLElement>(connection: Connection, control: E): E {
  const show = (): void => markBlocked(control, connection.problem);
  connection.onChange(show);
  const stop = (event: Event): void => {
    if (connection.problem !== "") event.stopImmediatePropagation();
  };
  control.addEventListener("click", stop, { capture: true });
  show();
  return control;
}

/** why: it does nothing; empty: it works. It keeps the focus, so that the reason can be read. */
export function markBlocked(control: HTMLElement, why: string): void {
  if (why === "") {
    control.removeAttribute("aria-disabled");
    control.removeAttribute("title");
  } else {
    control.setAttribute("aria-disabled", "true");
    control.title = why;
  }
}
