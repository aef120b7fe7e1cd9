// Exports to files and to the clipboard.
import { plural, value } from "../../shared/format";
import { isCavity, referenceOf } from "../../shared/names";
import { entryOf } from "../../shared/page";
import { DIVISIONS, POINTS } from "../state/points";
import { renderOptions } from "../state/render_options";
import { downloadBlob, selectedOf, type ViewerContext } from "../context/viewer_context";
import { drawPicture, pngOf, type PictureOptions } from "./picture";
import { renderCommand } from "./render_command";
import type { Shown } from "../state/state";
import type { SavedFile } from "../api/api";
import { readScene, writeScene } from "./scene_file";
import { EVERYTHING, polarityOfEntry, titleOf, targetOf } from "../api/entries";
import { tableCsv } from "./table_csv";
import { isDarkPage } from "../context/theme";
import { declaredUnit, hasNoUnit } from "../../shared/units";

function simplifiedWords({ triangles, distance }: { triangles: number; distance: number }): string {
  return `; ${plural(triangles, "triangle")} within ${value(distance)} voxels of the exact surface, with the same topology`;
}

export const SURFACES = ["stl", "ply", "obj", "glb", "vtp"];
export const LABELS = ["nrrd", "nii.gz", "nii", "tif"];
/** of all that is shown */
export const SEGMENTATIONS = ["seg.nrrd", ...LABELS];

export class Exporter {
  constructor(private readonly context: ViewerContext) {}

  /** The surface of the selected object. within: see FileOptions. */
  surface(format: string, within: number | null = null): Promise<void> {
    const shown = selectedOf(this.context.history.now);
    if (!shown) return this.nothingSelected();
    const { api, page } = this.context;
    if (format === "glb" && shown.walls === "all" && shown.entry !== EVERYTHING) return this.named(shown, within);
    return this.file(`${this.name}.${format}`, "writing the surface", () =>
      api.file(shown.tau, targetOf(page, shown.entry), format, shown.walls, { unit: this.unit, within }),
    );
  }

  /** 1 where the selected object is at its isovalue, 0 elsewhere; or the labels of all objects there, 1 is the largest. */
  labels(format: string): Promise<void> {
    const shown = selectedOf(this.context.history.now);
    if (!shown) return this.nothingSelected();
    const { api, page } = this.context;
    const all = shown.entry === EVERYTHING || isCavity(page, shown.entry);
    return this.file(`${this.name}.${format}`, "writing the labels", () =>
      api.labels(shown.tau, all ? null : entryOf(page, shown.entry).id, format, this.unit, polarityOfEntry(page, shown.entry)),
    );
  }

  /** A .glb, whose node has the name and colour of the object. */
  private named(shown: Shown, within: number | null): Promise<void> {
    const { api, page } = this.context;
    const words = [`${referenceOf(page, shown.entry)}@${shown.tau}`];
    const [objects, contours] = isCavity(page, shown.entry) ? [[], words] : [words, []];
    return this.file(`${this.name}.glb`, "writing the surface", () =>
      api.several("surfaces", objects, contours, "glb", { unit: this.unit, within }),
    );
  }

  /** Every visible object at its isovalue, in one file: "surfaces" or "segmentation". */
  everything(kind: "surfaces" | "segmentation", format: string, within: number | null = null): Promise<void> {
    const { api, page, history } = this.context;
    const visible = history.now.shown.filter(({ visible, entry }) => visible && entry !== EVERYTHING);
    const words = (cavities: boolean): string[] =>
      visible.filter(({ entry }) => isCavity(page, entry) === cavities).map(({ entry, tau }) => `${referenceOf(page, entry)}@${tau}`);
    if (visible.length === 0) return this.nothingSelected("show an object first; the whole isosurface has a file of its own");
    const name = `${page.volume.name}-${kind === "surfaces" ? "objects" : "labels"}.${format}`;
    return this.file(name, kind === "surfaces" ? "writing the surfaces" : "writing the labels", () =>
      api.several(kind, words(false), words(true), format, { unit: this.unit, within }),
    );
  }

  picture(options: PictureOptions): Promise<void> {
    return this.file(`${this.context.page.volume.name}.png`, "rendering the image", () => pngOf(drawPicture(this.context, options)));
  }

  table(): Promise<void> {
    const text = tableCsv(this.context.page, this.context.history.now);
    return this.file("objects.csv", "", () => Promise.resolve(new Blob([text], { type: "text/csv" })));
  }

  scene(): Promise<void> {
    const text = writeScene(this.context.page, this.context.history.now);
    const blob = new Blob([text], { type: "application/json" });
    return this.file(`${this.context.page.volume.name}.scene.json`, "", () => Promise.resolve(blob));
  }

  /** Throws Error with the reason if the file is invalid. */
  async load(file: File): Promise<void> {
    this.context.history.go(readScene(this.context.page, await file.text()));
    this.context.notify(`loaded ${file.name}`);
  }

  copy(text: string, what: string): Promise<void> {
    const access = navigator.clipboard as Clipboard | undefined; // none in a frame of a page that has neither https nor a local address
    return (access?.writeText(text) ?? Promise.reject(new Error())).then(
      () => this.context.notify(`${what} copied to the clipboard`),
      () => this.context.notify(`no access to the clipboard: ${text}`),
    );
  }

  /** Link to this view, for this browser: it contains no token. The address of a frame is of no use to another page. */
  link(): Promise<void> {
    const own = this.context.api.isInFrame ? new URL(`.${location.hash}`, location.href).href : location.href;
    return this.copy(own, "the link");
  }

  command(): string {
    const { page, history, viewport, scene, proposal } = this.context;
    const { view, up, isFlat: flat, height } = viewport.rig;
    const camera = { view, up, flat, height, cut: viewport.clippedHalfSpace };
    const size: [number, number] = [viewport.canvas.clientWidth, viewport.canvas.clientHeight];
    const options = [...this.unitOption, ...renderOptions(page, history.now, proposal.layers)];
    let drawn = scene.drawnOf(history.now);
    if (POINTS.of(history.now)) {
      options.push(`--points ${DIVISIONS}`);
      drawn = drawn.map((shown) => ({ ...shown, opacity: 1 })); // points are drawn opaque there
    }
    return renderCommand(page, drawn, camera, size, isDarkPage(), options);
  }

  /** What the files have to be told: the chosen unit, where the volume has none. */
  private get unit(): string | null {
    return declaredUnit(this.context.page.volume.unit);
  }

  /** Files of surfaces and labels keep the lengths of the volume. */
  private get unitWords(): string {
    const unit = this.unit ?? this.context.page.volume.unit;
    return hasNoUnit(unit) ? ", lengths without a unit" : `, lengths in ${unit}`;
  }

  private get unitOption(): string[] {
    return this.unit === null ? [] : [`--unit ${this.unit.replace("µ", "u")}`];
  }

  private get name(): string {
    const shown = selectedOf(this.context.history.now);
    return shown ? titleOf(this.context.page, shown.entry).toLowerCase().replaceAll(" ", "-") : "";
  }

  private nothingSelected(next = "select an object first"): Promise<void> {
    this.context.notify(next);
    return Promise.resolve();
  }

  private async file(name: string, meanwhile: string, make: () => Promise<Blob | SavedFile>): Promise<void> {
    try {
      if (meanwhile) this.context.notify(meanwhile);
      const made = await make();
      const { blob, simplified } = made instanceof Blob ? { blob: made } : made;
      downloadBlob(blob, name);
      const unit = meanwhile === "" || meanwhile.includes("image") ? "" : this.unitWords;
      this.context.notify(`${name} saved${unit}${simplified ? simplifiedWords(simplified) : ""}`);
    } catch (error) {
      this.context.reportError(error);
    }
  }
}
