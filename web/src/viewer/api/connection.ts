// Whether the server of the page answers, as its stream of events says (waiting.ts).

/** "other": a server answers, but shows another volume. */
export type ConnectionState = "up" | "lost" | "other";

export class Connection {
  private now: ConnectionState = "up";
  /** connections so far: what failed in an earlier one is requested again */
  count = 1;
  /** version of the scene of the server */
  scene = 0;
  private readonly listeners: (() => void)[] = [];
  private readonly sceneListeners: ((version: number) => void)[] = [];

  get state(): ConnectionState {
    return this.now;
  }
  /** Why a control does nothing; empty: it works. */
  get problem(): string {
    if (this.now === "up") return "";
    return this.now === "lost" ? "needs isoatlas view, which has ended" : "the server now shows another volume";
  }

  set(state: ConnectionState): void {
    if (state === this.now) return;
    this.now = state;
    if (state === "up") ++this.count;
    this.listeners.forEach((listener) => listener());
  }

  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }

  setScene(version: number): void {
    if (version === this.scene) return;
    this.scene = version;
    this.sceneListeners.forEach((listener) => listener(version));
  }

  onScene(listener: (version: number) => void): void {
    this.sceneListeners.push(listener);
  }
}
