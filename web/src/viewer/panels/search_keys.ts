// Keys of the search: arrows walk through what is found, Enter shows it, Escape goes back and then clears the text.
/** Focusable elements of what is found, in the order of the list. */
type Found = () => HTMLElement[];

/** first: shows the first object that is found; changed: the text is another one now. */
export function addSearchKeys(text: HTMLInputElement, list: HTMLElement, found: Found, first: () => void, changed: () => void): void {
  text.addEventListener("keydown", (event) => {
    if (event.key === "Enter") first();
    else if (event.key === "ArrowDown") found()[0]?.focus();
    else if (event.key !== "Escape") return;
    else if (text.value === "") text.blur();
    else {
      text.value = "";
      changed();
    }
    event.preventDefault();
  });
  list.addEventListener("keydown", (event) => {
    if (event.defaultPrevented || text.value.trim() === "") return; // without a search the keys are those of the viewer
    if (event.key === "Escape") text.focus();
    else if (event.key !== "ArrowDown" && event.key !== "ArrowUp") return;
    else walk(found(), event.key === "ArrowDown" ? 1 : -1, text);
    event.preventDefault();
  });
}

/** Upwards from the first one is the text. */
function walk(items: HTMLElement[], by: number, text: HTMLElement): void {
  const at = items.findIndex((item) => item === document.activeElement);
  if (at < 0) return;
  (at + by < 0 ? text : (items[at + by] ?? items.at(-1)))?.focus();
}
