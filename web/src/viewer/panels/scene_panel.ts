// Objects of the scene: a row each, to hide, select or remove it. The row of the selected object has more controls.
import { html, svg } from "../../shared/dom";
import { count, plural, value } from "../../shared/format";
import type { ViewerContext } from "../context/viewer_context";
import { PALETTE } from "../state/palette";
import { colourOf, colourOfShown, titleOf } from "../api/entries";
import type { Shown, State } from "../state/state";
import { keyOf, type LoadState } from "../api/surfaces";

export class ScenePanel {
  readonly element: HTMLElement;
  private readonly heading = html("h2", {}, "Scene");
  private readonly list = html("ol", {});
  private readonly undo: HTMLButtonElement;
  private readonly redo: HTMLButtonElement;
  private readonly ghosts: HTMLButtonElement;
  private rows: { row: HTMLElement; note: HTMLElement; entry: number }[] = [];
  private made = "";

  constructor(private readonly context: ViewerContext) {
    const { history, editor, scene } = context;
    this.undo = html("button", { type: "button", class: "plain", click: () => history.undo() }, "↶");
    this.redo = html("button", { type: "button", class: "plain", click: () => history.redo() }, "↷");
    this.ghosts = html("button", { type: "button", click: () => editor.toggleGhosts() }, "Ghost others");
    this.element = html(
      "section",
      { class: "scene", "aria-label": "scene" },
      html("header", {}, this.heading, this.ghosts, this.undo, this.redo),
      this.list,
    );
    scene.onLoadState((entry) => this.note(entry));
  }

  show(state: State): void {
    const { history, editor } = this.context;
    this.heading.textContent = state.shown.length > 0 ? "Scene" : "The scene is empty";
    this.ghosts.hidden = state.shown.length < 2;
    this.ghosts.setAttribute("aria-pressed", String(editor.ghosts));
    for (const [button, word, what] of [
      [this.undo, "Undo", history.undoes],
      [this.redo, "Redo", history.redoes],
    ] as const) {
      button.disabled = what === "";
      button.title = what ? `${word}: ${what}` : `nothing to ${word.toLowerCase()}`;
      button.setAttribute("aria-label", button.title);
    }
    this.refresh(state);
  }

  /** Titles have changed. */
  renew(state: State): void {
    this.made = "";
    this.refresh(state);
  }

  /** Rows are rebuilt only when the list or the selection changes: controls must survive a drag. */
  private refresh(state: State): void {
    const made = `${state.shown.map(({ entry }) => entry).join()} ${state.selected}`;
    if (made !== this.made) this.make(state);
    this.made = made;
    state.shown.forEach((shown, i) => this.fill(shown, i));
  }

  private make(state: State): void {
    const focus = this.focused();
    this.rows = state.shown.map((shown, i) => this.row(shown, i, i === state.selected));
    this.list.replaceChildren(...this.rows.map(({ row }) => row));
    if (focus) this.list.querySelector<HTMLElement>(`[data-focus="${focus}"]`)?.focus();
  }

  private focused(): string | undefined {
    const { activeElement } = document;
    return activeElement instanceof HTMLElement && this.list.contains(activeElement) ? activeElement.dataset.focus : undefined;
  }

  private row(shown: Shown, i: number, selected: boolean): (typeof this.rows)[number] {
    const { page, editor } = this.context;
    const title = titleOf(page, shown.entry);
    const name = title.toLowerCase();
    const note = html("span", { class: "state" });
    const button = (mark: string, label: string, hint: string, run: () => void): HTMLElement =>
      html(
        "button",
        {
          type: "button",
          class: `plain ${mark}`,
          "aria-label": `${label} ${name}`,
          title: hint,
          "data-focus": `${mark} ${shown.entry}`,
          click: run,
        },
        mark === "eye" && eye(),
      );
    const pick = html("button", {
      type: "button",
      class: "name",
      "data-focus": `name ${shown.entry}`,
      "aria-current": selected ? "true" : "false",
      click: () => editor.select(i),
    });
    pick.append(
      html("span", { class: "swatch" }),
      html("span", {}, html("span", { class: "unseen" }, "Select "), html("b", {}, title), " ", note),
    );
    const line = html(
      "div",
      { class: "row" },
      button("eye", "show", "show or hide", () => editor.toggleVisible(i)),
      pick,
      button("out", "remove", "remove from the scene", () => editor.remove(i)),
    );
    const row = html("li", { class: selected ? "selected" : "" }, line, selected && this.more(shown, name));
    return { row, note, entry: shown.entry };
  }

  private more(shown: Shown, name: string): HTMLElement {
    const { editor } = this.context;
    const opacity = html("input", { type: "range", class: "opacity", min: 0.05, max: 1, step: 0.05, "aria-label": `opacity of ${name}` });
    opacity.addEventListener("input", () => editor.change({ opacity: Number(opacity.value) }, true));
    opacity.addEventListener("change", () => editor.change({ opacity: Number(opacity.value) }));
    const cavities = html("button", { type: "button", class: "cavities", click: () => editor.toggleCavitiesOnly() }, "Cavities only");
    const isolate = html("button", { type: "button", click: () => editor.isolate(shown.entry) }, "Isolate");
    const level = html(
      "button",
      { type: "button", title: "set all objects to the isovalue of this one", click: () => editor.setAllIsovalues() },
      "Isovalue for all",
    );
    const others = this.context.history.now.shown.length > 1;
    const buttons = [others && isolate, editor.hasCavities && cavities, others && level];
    return html(
      "div",
      { class: "more" },
      this.colours(shown.entry, name),
      html("label", {}, "opacity ", opacity),
      html("div", { class: "line" }, ...buttons),
    );
  }

  /** Palette and colour picker. */
  private colours(entry: number, name: string): HTMLElement {
    const { editor, page } = this.context;
    const paint = (colour: string, transient = false): void =>
      editor.change({ colour: colour === colourOf(page, entry).toLowerCase() ? null : colour }, transient);
    const swatches = PALETTE.map(([word, colour]) =>
      html("button", {
        type: "button",
        class: "colour",
        "aria-label": `${word} for ${name}`,
        title: word,
        "data-colour": colour,
        style: `--colour:${colour}`,
        click: () => paint(colour),
      }),
    );
    const free = html("input", { type: "color", "aria-label": `another colour for ${name}`, title: "another colour" });
    free.addEventListener("input", () => paint(free.value, true));
    free.addEventListener("change", () => paint(free.value));
    return html("div", { class: "colours", role: "group", "aria-label": `colour of ${name}` }, ...swatches, free);
  }

  private fill(shown: Shown, i: number): void {
    const row = this.rows[i]?.row;
    if (!row) return;
    const colour = colourOfShown(this.context.page, shown).toLowerCase();
    row.classList.toggle("hidden", !shown.visible);
    row.querySelector(".eye")?.setAttribute("aria-pressed", String(shown.visible));
    row.querySelector<HTMLElement>(".swatch")?.style.setProperty("background", colour);
    const opacity = row.querySelector<HTMLInputElement>(".opacity");
    if (opacity) opacity.value = String(shown.opacity);
    const free = row.querySelector<HTMLInputElement>('input[type="color"]');
    if (free) free.value = colour;
    for (const swatch of row.querySelectorAll<HTMLElement>(".colour"))
      swatch.setAttribute("aria-pressed", String(swatch.dataset.colour === colour));
    row.querySelector(".cavities")?.setAttribute("aria-pressed", String(shown.walls === "cavities"));
    this.note(shown.entry);
  }

  private note(entry: number): void {
    const shown = this.context.history.now.shown.find((one) => one.entry === entry);
    const note = this.rows.find((row) => row.entry === entry)?.note;
    if (shown && note) note.textContent = noteOf(shown, this.context.scene.loadStateOf(entry));
  }
}

function eye(): SVGSVGElement {
  const lids = svg("path", { d: "M2 12c3-5 6-7 10-7s7 2 10 7c-3 5-6 7-10 7s-7-2-10-7z" });
  return svg(
    "svg",
    { viewBox: "0 0 24 24", "aria-hidden": "true" },
    lids,
    svg("circle", { cx: 12, cy: 12, r: 3 }),
    svg("path", { class: "shut", d: "M4 4l16 16" }),
  );
}

/** "at 81.2, 21,324 triangles" */
export function noteOf(shown: Shown, loadState: LoadState): string {
  const parts = [`at ${value(shown.tau)}`];
  if (!shown.visible) parts.push("hidden");
  else if (loadState.key !== keyOf(shown)) parts.push("loading");
  else if (loadState.error) parts.push(loadState.error);
  else if (loadState.points > 0) parts.push(`${count(loadState.points)} points${loadState.coarse ? " of it" : ""}`);
  else if (shown.walls === "cavities" && loadState.triangles === 0) parts.push("no cavities");
  else if (loadState.walls) parts.push(`${plural(loadState.walls, "cavity", "cavities")}, ${count(loadState.triangles)} triangles`);
  else if (loadState.triangles > 0) parts.push(`${count(loadState.triangles)} triangles${distanceWords(loadState)}`);
  return parts.join(", ");
}

function distanceWords({ coarse, within, pixels }: LoadState): string {
  if (pixels !== null) return `: exact topology, within ${value(pixels)} ${pixels === 1 ? "pixel" : "pixels"}`;
  return coarse && within !== null ? `, coarse: exact topology, within ${value(within)} voxels` : "";
}
