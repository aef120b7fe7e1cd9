// Commands, each with a button that copies it.
import { html } from "./dom";
import type { Entry } from "./page";

export function commandList(commands: Entry["commands"]): HTMLElement {
  const list = html("dl", { class: "commands" });
  for (const command of commands) {
    const copy = html("button", { type: "button", class: "copy", "aria-label": `Copy: ${command.name}` }, "Copy");
    copy.addEventListener("click", () => {
      void navigator.clipboard
        .writeText(command.line)
        .then(() => "Copied")
        .catch(() => "Select it")
        .then((label) => {
          copy.textContent = label;
          setTimeout(() => (copy.textContent = "Copy"), 1500);
        });
    });
    list.append(html("dt", {}, command.name), html("dd", {}, html("code", {}, command.line), copy));
  }
  return list;
}
