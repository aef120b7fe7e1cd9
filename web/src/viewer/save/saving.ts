// What can be taken away, each as a file or as words in the clipboard.
import { isDark } from "../../names";
import { entryOf } from "../../page";
import { besideWords } from "../state/beside";
import { keep, selectedOf, type Desk } from "../desk/desk";
import { drawPicture, pngOf, type PictureWishes } from "./picture";
import { renderCommand } from "./render_command";
import { readScene, writeScene } from "./scene_file";
import { EVERYTHING, titleOf, whichOf } from "../ask/shown";
import { tableCsv } from "./table_csv";
import { isDarkPage } from "../desk/theme";

export const SURFACES = ["stl", "ply", "obj", "glb", "vtp"];
export const LABELS = ["nrrd", "nii.gz", "nii", "tif"];

export class Saving {
  constructor(private readonly desk: Desk) {}

  /** The surface of what is selected. */
  surface(format: string): Promise<void> {
    const shown = selectedOf(this.desk.history.now);
    if (!shown) return this.nothing();
    const { api, page } = this.desk;
    return this.file(`${this.name}.${format}`, "the surface is being written", () =>
      api.file(shown.tau, whichOf(page, shown.entry), format, shown.walls),
    );
  }

  /** 1 where the selected object is at its isovalue, 0 elsewhere; or all objects there, the largest is 1. */
  labels(format: string): Promise<void> {
    const shown = selectedOf(this.desk.history.now);
    if (!shown) return this.nothing();
    const { api, page } = this.desk;
    const all = shown.entry === EVERYTHING || isDark(page, shown.entry);
    return this.file(`${this.name}.${format}`, "the labels are being written", () =>
      api.labels(shown.tau, all ? null : entryOf(page, shown.entry).id, format),
    );
  }

  picture(wishes: PictureWishes): Promise<void> {
    return this.file(`${this.desk.page.volume.name}.png`, "the picture is being drawn", () => pngOf(drawPicture(this.desk, wishes)));
  }

  table(): Promise<void> {
    const text = tableCsv(this.desk.page, this.desk.history.now);
    return this.file("objects.csv", "", () => Promise.resolve(new Blob([text], { type: "text/csv" })));
  }

  scene(): Promise<void> {
    const text = writeScene(this.desk.page, this.desk.history.now);
    return this.file(`${this.desk.page.volume.name}.scene.json`, "", () => Promise.resolve(new Blob([text], { type: "application/json" })));
  }

  /** Throws Error that says what is wrong with it. */
  async load(file: File): Promise<void> {
    this.desk.history.go(readScene(this.desk.page, await file.text()));
    this.desk.say(`the scene of ${file.name}`);
  }

  copy(text: string, what: string): Promise<void> {
    return navigator.clipboard.writeText(text).then(
      () => this.desk.say(`${what} is in the clipboard`),
      () => this.desk.say(`the browser gives no clipboard: ${text}`),
    );
  }

  /** Of exactly this view, for this browser: nothing secret is in it. */
  link(): Promise<void> {
    return this.copy(location.href, "the link");
  }

  command(): string {
    const { page, history, stage, scene } = this.desk;
    const camera = { view: stage.eye.view, flat: stage.eye.isFlat, height: stage.eye.height, cut: stage.removed };
    const size: [number, number] = [stage.canvas.clientWidth, stage.canvas.clientHeight];
    return renderCommand(page, scene.drawnOf(history.now), camera, size, isDarkPage(), besideWords(page, history.now));
  }

  private get name(): string {
    const shown = selectedOf(this.desk.history.now);
    return shown ? titleOf(this.desk.page, shown.entry).toLowerCase().replaceAll(" ", "-") : "";
  }

  private nothing(): Promise<void> {
    this.desk.say("select an object first");
    return Promise.resolve();
  }

  private async file(name: string, meanwhile: string, make: () => Promise<Blob>): Promise<void> {
    try {
      if (meanwhile) this.desk.say(meanwhile);
      keep(await make(), name);
      this.desk.say(`${name} is saved`);
    } catch (error) {
      this.desk.fail(error);
    }
  }
}
