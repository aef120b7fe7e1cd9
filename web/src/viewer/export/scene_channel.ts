// The scene of a page in a frame: shared with other frames and with the program around them, through the server (docs/server.md).
import { isSuperseded } from "../api/api";
import type { ViewerContext } from "../context/viewer_context";
import { readScene, writeScene } from "./scene_file";

/** milliseconds without a further change, after which a scene is sent */
const SETTLED = 250;

export class SceneChannel {
  private timer: ReturnType<typeof setTimeout> | undefined;
  private isSending = false;
  /** text of the scene that server and page have in common */
  private common = "";

  constructor(
    private readonly context: ViewerContext,
    /** of the scene that the page has begun with */
    private version: number,
    /** resolves when objects are known that have no entry on the page */
    private readonly allKnown: Promise<void>,
  ) {}

  begin(): void {
    const { history, api } = this.context;
    history.listen(() => this.changed());
    api.connection.onScene((version) => void this.follow(version));
    if (api.connection.scene > this.version) void this.follow(api.connection.scene);
    else void this.send();
  }

  private changed(): void {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => void this.send(), SETTLED);
  }

  private get text(): string {
    return writeScene(this.context.page, this.context.history.now, 0);
  }

  private async send(): Promise<void> {
    if (this.isSending) return; // its end looks again
    this.isSending = true;
    try {
      for (let text = this.text; text !== this.common; text = this.text) {
        const version = await this.context.api.setScene(text, this.version);
        this.version = Math.max(this.version, version);
        this.common = text;
      }
    } catch (error) {
      this.context.reportError(error); // 409: a newer scene is on its way here
    } finally {
      this.isSending = false;
    }
  }

  /** Shows the scene that another page or a program has set. */
  private async follow(version: number): Promise<void> {
    if (version <= this.version) return;
    const { api, history, page } = this.context;
    try {
      const scene = await api.scene();
      if (scene.version <= this.version) return;
      this.version = scene.version;
      if (scene.isOwn) return;
      clearTimeout(this.timer);
      const { shown } = JSON.parse(scene.text) as { shown: { entry: number }[] };
      if (shown.some(({ entry }) => entry >= page.entries.length)) await this.allKnown;
      history.go(readScene(page, scene.text));
      clearTimeout(this.timer); // of this change
      this.common = this.text;
    } catch (error) {
      if (isSuperseded(error)) return; // a newer version is being followed
      this.context.reportError(error);
      this.common = "";
      this.changed(); // what is shown instead is told
    }
  }
}
