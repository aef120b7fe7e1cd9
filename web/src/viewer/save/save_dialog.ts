// All that can be taken away, in one dialog.
import { html } from "../../dom";
import { animate } from "./animation";
import { keep, selectedOf, type Desk } from "../desk/desk";
import type { PictureWishes } from "./picture";
import { LABELS, Saving, SURFACES } from "./saving";
import { ownRange, titleOf } from "../ask/shown";
import { isDarkPage } from "../desk/theme";

const LEAST = 16;
const MOST = 8192;

export class SaveDialog {
  readonly element = html("dialog", { class: "sheet save", "aria-labelledby": "save-title" });
  private readonly saving: Saving;
  private readonly command = html("code", {});
  private readonly of = html("span", { class: "of" });
  private readonly width = numberBox("width", 1600);
  private readonly height = numberBox("height", 1200);
  private readonly scaleBar = html("input", { type: "checkbox", checked: true });
  private readonly legend = html("input", { type: "checkbox", checked: true });
  private readonly background = html(
    "select",
    { "aria-label": "background" },
    ...["as here", "white", "transparent"].map((name) => html("option", { value: name }, name)),
  );
  private readonly along = html(
    "select",
    { "aria-label": "what moves" },
    html("option", { value: "turn" }, "turning once around"),
    html("option", { value: "tau" }, "along its isovalue"),
  );
  private readonly frames = numberBox("frames", 24);
  private readonly rate = numberBox("frames a second", 12);
  private readonly progress = html("progress", { max: 1, value: 0, hidden: true, "aria-label": "frames made" });
  private readonly make = html("button", { type: "button", click: () => void this.animation() }, "Make the animation");
  private readonly problem = html("p", { class: "problem", role: "alert" });
  private making = false;

  constructor(private readonly desk: Desk) {
    this.saving = new Saving(desk);
    this.fill();
    this.addActions();
    this.element.addEventListener("close", () => (this.making = false));
  }

  open(): void {
    const shown = selectedOf(this.desk.history.now);
    this.of.textContent = shown ? titleOf(this.desk.page, shown.entry) : "nothing is selected";
    this.command.textContent = this.saving.command();
    this.problem.textContent = "";
    if (!this.element.open) this.element.showModal();
  }

  private fill(): void {
    const { saving } = this;
    const surface = choice("format of the surface", SURFACES);
    const labels = choice("format of the labels", LABELS);
    const file = html("input", { type: "file", accept: ".json,application/json", "aria-label": "a scene to load" });
    file.addEventListener("change", () => void this.load(file));
    const button = (name: string, run: () => unknown): HTMLElement => html("button", { type: "button", click: () => void run() }, name);
    this.element.append(
      html(
        "header",
        {},
        html("h2", { id: "save-title" }, "Save"),
        html("button", { type: "button", class: "plain", "aria-label": "Close", click: () => this.element.close() }, "×"),
      ),
      this.problem,
      part(
        "What is selected",
        html("p", {}, this.of),
        line(
          surface,
          button("Save the surface", () => saving.surface(surface.value)),
        ),
        line(
          labels,
          button("Save the labels", () => saving.labels(labels.value)),
        ),
      ),
      part(
        "Picture",
        line(label("width", this.width), label("height", this.height), label("background", this.background)),
        line(
          tick(this.scaleBar, "scale bar"),
          tick(this.legend, "legend"),
          button("Save a picture", () => this.checked(() => saving.picture(this.wishes()))),
        ),
        line(this.along, label("frames", this.frames), label("a second", this.rate), this.make, this.progress),
      ),
      part("Table", line(button("Save the table of objects", () => saving.table()))),
      part(
        "Scene",
        line(
          button("Copy the link", () => saving.link()),
          button("Save the scene", () => saving.scene()),
          label("load a scene", file),
        ),
      ),
      part(
        "On the command line",
        html("pre", {}, this.command),
        line(button("Copy the command", () => saving.copy(saving.command(), "the command"))),
      ),
    );
  }

  private addActions(): void {
    const { saving } = this;
    const surface = (format: string) => ({
      group: "Save" as const,
      name: `surface as ${format.toUpperCase()}`,
      run: () => void saving.surface(format),
    });
    this.desk.actions.add(
      { group: "Save", name: "save: all that can be taken away", keys: ["s", "Ctrl+s"], run: () => this.open() },
      { group: "Save", name: "copy the link to this view", keys: ["l"], run: () => void saving.link() },
      ...SURFACES.slice(0, 2).map(surface),
      {
        group: "Save",
        name: "picture as it is",
        run: () => void saving.picture({ ...this.wishes(), width: this.desk.stage.canvas.width, height: this.desk.stage.canvas.height }),
      },
      { group: "Save", name: "table of objects", run: () => void saving.table() },
      { group: "Save", name: "scene as a file", run: () => void saving.scene() },
      { group: "Save", name: "copy the command line that draws this", run: () => void saving.copy(saving.command(), "the command") },
    );
  }

  private wishes(): PictureWishes {
    const here = getComputedStyle(document.body);
    const white = this.background.value === "white";
    const background = this.background.value === "transparent" ? null : white ? "#ffffff" : here.backgroundColor;
    const size = (box: HTMLInputElement): number => Math.min(Math.max(Math.round(Number(box.value)) || LEAST, LEAST), MOST);
    return {
      width: size(this.width),
      height: size(this.height),
      scaleBar: this.scaleBar.checked,
      legend: this.legend.checked,
      background,
      ink: white || !isDarkPage() ? "#1b2430" : "#e8ecf1",
    };
  }

  private async checked(run: () => Promise<void>): Promise<void> {
    this.problem.textContent = "";
    try {
      await run();
    } catch (error) {
      this.problem.textContent = error instanceof Error ? error.message : String(error);
    }
  }

  private async load(input: HTMLInputElement): Promise<void> {
    const [file] = input.files ?? [];
    if (!file) return;
    await this.checked(() => this.saving.load(file));
    input.value = "";
    if (this.problem.textContent === "") this.element.close();
  }

  /** The button that makes it ends it, too. */
  private async animation(): Promise<void> {
    if (this.making) {
      this.making = false;
      return;
    }
    const { desk } = this;
    const shown = selectedOf(desk.history.now);
    const frames = Math.min(Math.max(Math.round(Number(this.frames.value)) || 1, 1), 360);
    const along = this.along.value === "tau" && shown ? ownRange(desk.page, shown.entry) : null;
    this.making = true;
    this.make.textContent = "Stop";
    this.progress.hidden = false;
    await this.checked(async () => {
      const wishes = { picture: this.wishes(), frames, framesPerSecond: Number(this.rate.value) || 12, along };
      const blob = await animate(
        desk,
        wishes,
        (made) => (this.progress.value = made / frames),
        () => !this.making,
      );
      if (blob) keep(blob, `${desk.page.volume.name}-animation.png`);
    });
    this.making = false;
    this.make.textContent = "Make the animation";
    this.progress.hidden = true;
  }
}

function part(title: string, ...content: HTMLElement[]): HTMLElement {
  return html("section", {}, html("h3", {}, title), ...content);
}

function line(...content: HTMLElement[]): HTMLElement {
  return html("div", { class: "line" }, ...content);
}

function label(text: string, control: HTMLElement): HTMLElement {
  return html("label", {}, `${text} `, control);
}

function tick(box: HTMLInputElement, text: string): HTMLElement {
  return html("label", {}, box, ` ${text}`);
}

function choice(name: string, formats: readonly string[]): HTMLSelectElement {
  return html(
    "select",
    { "aria-label": name, autofocus: formats === SURFACES },
    ...formats.map((format) => html("option", { value: format }, format.toUpperCase())),
  );
}

function numberBox(name: string, value: number): HTMLInputElement {
  return html("input", { type: "number", min: 1, max: MOST, value, "aria-label": name });
}
