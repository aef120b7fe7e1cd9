// The opacity curve that the server proposes from the tree, requested once.
import type { Page } from "../../shared/page";
import { voxelLength } from "../state/volume_state";
import type { Layer } from "../state/opacity_curve";
import type { Api } from "./api";
import { colouredAs, layersOf, type OpacityTent } from "./transfer_function";

export class TransferProposal {
  private asked: Promise<readonly Layer[]> | null = null;
  private known: readonly Layer[] | null = null;

  constructor(
    private readonly api: Api,
    private readonly page: Page,
  ) {}

  /** null: not loaded */
  get layers(): readonly Layer[] | null {
    return this.known;
  }

  /** A failed request is repeated by the next call. */
  load(): Promise<readonly Layer[]> {
    this.asked ??= this.request().catch((error: unknown) => {
      this.asked = null;
      throw error;
    });
    return this.asked;
  }

  private async request(): Promise<readonly Layer[]> {
    const { api, page } = this;
    const { tents } = (await (await api.request("/api/transfer", "transfer")).json()) as { tents: OpacityTent[] };
    const { low, high } = page.axis;
    this.known = layersOf(colouredAs(page, tents), low, high, voxelLength(page));
    return this.known;
  }
}
