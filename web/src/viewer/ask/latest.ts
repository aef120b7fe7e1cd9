// One question at a time; of those that come meanwhile only the last one is asked.
export class Latest<T> {
  private next: { what: T; key: string } | null = null;
  private asked = "";
  private busy = false;

  constructor(private readonly ask: (what: T) => Promise<void>) {}

  /** key: what was asked last is not asked again */
  want(what: T, key: string): void {
    if (key === this.asked && !this.next) return;
    this.next = { what, key };
    if (!this.busy) void this.run();
  }

  private async run(): Promise<void> {
    this.busy = true;
    while (this.next) {
      const { what, key } = this.next;
      this.next = null;
      this.asked = key;
      await this.ask(what);
    }
    this.busy = false;
  }
}
