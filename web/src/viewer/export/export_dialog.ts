// The export dialog.
import { html } from "../../shared/dom";
import { animate } from "./animation";
import { downloadBlob, selectedOf, type ViewerContext } from "../context/viewer_context";
import type { PictureOptions } from "./picture";
import { LABELS, Exporter, SEGMENTATIONS, SURFACES } from "./exporter";
import { ownRange, titleOf } from "../api/entries";
import { isDarkPage } from "../context/theme";
import { whileConnected } from "../context/needs_server";

const MIN = 16;
const MAX = 8192;

export class ExportDialog {
  readonly element = html("dialog", { class: "sheet export", "aria-labelledby": "export-title" });
  private readonly exporter: Exporter;
  private readonly command = html("code", {});
  private readonly of = html("span", { class: "of" });
  private readonly width = numberBox("width", 1600);
  private readonly height = numberBox("height", 1200);
  private readonly scaleBar = html("input", { type: "checkbox", checked: true });
  private readonly legend = html("input", { type: "checkbox", checked: true });
  private readonly background = html(
    "select",
    { "aria-label": "background" },
    ...["theme", "white", "transparent"].map((name) => html("option", { value: name }, name)),
  );
  private readonly along = html(
    "select",
    { "aria-label": "motion" },
    html("option", { value: "turn" }, "turntable"),
    html("option", { value: "tau" }, "isovalue sweep"),
  );
  private readonly frames = numberBox("frames", 24);
  private readonly rate = numberBox("frames per second", 12);
  private readonly progress = html("progress", { max: 1, value: 0, hidden: true, "aria-label": "finished frames" });
  private readonly make = html("button", { type: "button", click: () => void this.animation() }, "Save the animation");
  private readonly problem = html("p", { class: "problem", role: "alert" });
  private isMaking = false;

  constructor(private readonly context: ViewerContext) {
    this.exporter = new Exporter(context);
    this.fill();
    this.addActions();
    this.element.addEventListener("close", () => (this.isMaking = false));
  }

  open(): void {
    const shown = selectedOf(this.context.history.now);
    this.of.textContent = shown ? titleOf(this.context.page, shown.entry) : "no object is selected";
    this.command.textContent = this.exporter.command();
    this.problem.textContent = "";
    if (!this.element.open) this.element.showModal();
  }

  private fill(): void {
    const { exporter } = this;
    const surface = choice("format of the surface", SURFACES);
    const labels = choice("format of the labels", LABELS);
    const surfaces = choice("format of all surfaces", ["glb", ...SURFACES.filter((format) => format !== "glb")]);
    const triangles = trianglesChoice("triangles of the surface");
    const allTriangles = trianglesChoice("triangles of all surfaces");
    const segmentation = choice("format of all labels", SEGMENTATIONS);
    const file = html("input", { type: "file", accept: ".json,application/json", "aria-label": "scene file to load" });
    file.addEventListener("change", () => void this.load(file));
    const button = (name: string, run: () => unknown): HTMLElement => html("button", { type: "button", click: () => void run() }, name);
    const fromServer = (name: string, run: () => unknown): HTMLElement => whileConnected(this.context.api.connection, button(name, run));
    this.element.append(
      html(
        "header",
        {},
        html("h2", { id: "export-title" }, "Export"),
        html("button", { type: "button", class: "plain", "aria-label": "Close", click: () => this.element.close() }, "×"),
      ),
      this.problem,
      part(
        "Selected object",
        html("p", {}, this.of),
        line(
          surface,
          triangles,
          fromServer("Save the surface", () => exporter.surface(surface.value, within(triangles))),
        ),
        line(
          labels,
          fromServer("Save the labels", () => exporter.labels(labels.value)),
        ),
      ),
      part(
        "Everything shown, each at its isovalue",
        line(
          surfaces,
          allTriangles,
          fromServer("Save all surfaces", () => exporter.everything("surfaces", surfaces.value, within(allTriangles))),
        ),
        line(
          segmentation,
          fromServer("Save all labels", () => exporter.everything("segmentation", segmentation.value)),
        ),
      ),
      part(
        "Image",
        line(label("width", this.width), label("height", this.height), label("background", this.background)),
        line(
          tick(this.scaleBar, "scale bar"),
          tick(this.legend, "legend"),
          button("Save the image", () => this.checked(() => exporter.picture(this.options()))),
        ),
        line(this.along, label("frames", this.frames), label("per second", this.rate), this.make, this.progress),
      ),
      part("Table", line(button("Save the table of objects", () => exporter.table()))),
      part(
        "Scene",
        line(
          button("Copy the link", () => exporter.link()),
          button("Save the scene", () => exporter.scene()),
          label("load a scene", file),
        ),
      ),
      part(
        "On the command line",
        html("pre", {}, this.command),
        line(button("Copy the command", () => exporter.copy(exporter.command(), "the command"))),
      ),
    );
  }

  private addActions(): void {
    const { exporter } = this;
    const surface = (format: string) => ({
      group: "Export" as const,
      name: `Surface as ${format.toUpperCase()}`,
      needsServer: true,
      run: () => void exporter.surface(format),
    });
    this.context.actions.add(
      { group: "Export", name: "Export...", keys: ["s", "Ctrl+s"], run: () => this.open() },
      { group: "Export", name: "Copy link to this view", keys: ["l"], run: () => void exporter.link() },
      ...SURFACES.slice(0, 2).map(surface),
      {
        group: "Export",
        name: "Everything shown as GLB",
        needsServer: true,
        run: () => void exporter.everything("surfaces", "glb"),
      },
      {
        group: "Export",
        name: "Image of this view",
        run: () => {
          const { width, height } = this.context.viewport.canvas;
          void exporter.picture({ ...this.options(), width, height });
        },
      },
      { group: "Export", name: "Table of objects", run: () => void exporter.table() },
      { group: "Export", name: "Scene file", run: () => void exporter.scene() },
      { group: "Export", name: "Copy command line", run: () => void exporter.copy(exporter.command(), "the command") },
    );
  }

  private options(): PictureOptions {
    const here = getComputedStyle(document.body);
    const white = this.background.value === "white";
    const background = this.background.value === "transparent" ? null : white ? "#ffffff" : here.backgroundColor;
    const size = (box: HTMLInputElement): number => Math.min(Math.max(Math.round(Number(box.value)) || MIN, MIN), MAX);
    return {
      width: size(this.width),
      height: size(this.height),
      scaleBar: this.scaleBar.checked,
      legend: this.legend.checked,
      background,
      textColour: white || !isDarkPage() ? "#1b2430" : "#e8ecf1",
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
    await this.checked(() => this.exporter.load(file));
    input.value = "";
    if (this.problem.textContent === "") this.element.close();
  }

  /** Starts the animation, or cancels the running one. */
  private async animation(): Promise<void> {
    if (this.isMaking) {
      this.isMaking = false;
      return;
    }
    const { context } = this;
    const shown = selectedOf(context.history.now);
    const frames = Math.min(Math.max(Math.round(Number(this.frames.value)) || 1, 1), 360);
    const along = this.along.value === "tau" && shown ? ownRange(context.page, shown.entry) : null;
    this.isMaking = true;
    this.make.textContent = "Stop";
    this.progress.hidden = false;
    await this.checked(async () => {
      const options = { picture: this.options(), frames, framesPerSecond: Number(this.rate.value) || 12, along };
      const blob = await animate(
        context,
        options,
        (made) => (this.progress.value = made / frames),
        () => !this.isMaking,
      );
      if (blob) downloadBlob(blob, `${context.page.volume.name}-animation.png`);
    });
    this.isMaking = false;
    this.make.textContent = "Save the animation";
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

/** All triangles, or fewer within so many voxels of the exact surface. */
function trianglesChoice(name: string): HTMLSelectElement {
  const fewer = [0.1, 0.25, 0.5, 1, 2].map((voxels) =>
    html("option", { value: String(voxels) }, `fewer, within ${voxels} ${voxels === 1 ? "voxel" : "voxels"}`),
  );
  const title = "fewer triangles, with the topology of the exact surface";
  return html("select", { "aria-label": name, title }, html("option", { value: "" }, "all triangles"), ...fewer);
}

function within(triangles: HTMLSelectElement): number | null {
  return triangles.value === "" ? null : Number(triangles.value);
}

function numberBox(name: string, value: number): HTMLInputElement {
  return html("input", { type: "number", min: 1, max: MAX, value, "aria-label": name });
}
