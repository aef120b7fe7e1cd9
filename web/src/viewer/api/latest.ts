// Runs one request at a time; of those made meanwhile, only the last one follows.
export class Latest<T> {
  private next: { what: T; key: string } | null = null;
  private started = "";
  private busy = false;

  constructor(private readonly load: (what: T) => Promise<void>) {}

  /** key: a request equal to the last one is not repeated */
  request(what: T, key: string): void {
    if (key === this.started && !this.next) return;
    this.next = { what, key };
    if (!this.busy) void this.run();
  }

  /** The next request is made in any case. */
  forget(): void {
    this.next = null;
    this.started = "";
  }

  private async run(): Promise<void> {
    this.busy = true;
    while (this.next) {
      const { what, key } = this.next;
      this.next = null;
      this.started = key;
      await this.load(what);
    }
    this.busy = false;
  }
}
