// State of the server as sent by /api/events: docs/server.md.
export interface Build {
  /** "classify", "pack", ...; empty: just started */
  phase: string;
  phase_index: number;
  phase_count: number;
  /** of the whole build, 0 to 1 */
  fraction: number;
  seconds_left: number | null;
  voxels_per_second: number | null;
  peak_memory: number;
}

/** A pending request. */
export interface PendingRequest {
  client: string;
  queue: "surfaces" | "samples" | "trees" | "cards" | "atlas";
  /** position in the queue, from 1; 0: it is being processed */
  place: number;
  fraction: number;
}

export interface ServerState {
  state: "building" | "open" | "failed";
  build?: Build;
  error?: { message: string; what: string; next: string };
  /** the version of the shared scene */
  scene: number;
  requests: PendingRequest[];
}

/** Messages of a text/event-stream, without comments. */
export async function* messages(stream: ReadableStream<Uint8Array>): AsyncGenerator<ServerState> {
  const reader = stream.getReader();
  const decoder = new TextDecoder();
  let text = "";
  try {
    for (;;) {
      const { value, done } = await reader.read();
      if (done) return;
      text += decoder.decode(value, { stream: true });
      const blocks = text.split("\n\n");
      text = blocks.pop() ?? "";
      for (const block of blocks) {
        const data = block.split("\n").filter((line) => line.startsWith("data: "));
        if (data.length > 0) yield JSON.parse(data.map((line) => line.slice(6)).join("\n")) as ServerState;
      }
    }
  } finally {
    await reader.cancel().catch(() => undefined);
  }
}

const PHASES: Record<string, string> = {
  read: "Reading samples",
  classify: "Finding critical points",
  sort: "Sorting critical points",
  trees: "Building merge trees",
  zones: "Measuring zones",
  objects: "Ranking objects",
  pack: "Writing the store",
};

function timeOf(seconds: number): string {
  if (seconds < 90) return `${Math.max(1, Math.round(seconds))} s`;
  return seconds < 5400 ? `${Math.round(seconds / 60)} min` : `${(seconds / 3600).toFixed(1)} h`;
}

/** "building 43 %" */
export function progressOf(build: Build): string {
  return build.phase === "" ? "building" : `building ${Math.floor(100 * build.fraction)} %`;
}

/** "Building merge trees, 12 s left, 1.2 GB of memory" */
export function detailsOf(build: Build): string {
  const parts = [PHASES[build.phase] ?? build.phase];
  if (build.seconds_left !== null) parts.push(`${timeOf(build.seconds_left)} left`);
  if (build.voxels_per_second !== null) parts.push(`${(build.voxels_per_second / 1e6).toPrecision(2)} million voxels per second`);
  if (build.peak_memory > 0) parts.push(`${(build.peak_memory / 1e9).toPrecision(2)} GB of memory`);
  return parts.filter((part) => part !== "").join(", ");
}

/** Text for queues without a reported fraction. */
const WORK: Partial<Record<PendingRequest["queue"], string>> = {
  samples: "Reading samples",
  trees: "Querying trees",
  atlas: "Ranking objects",
};

/** What the page is waiting for; empty: nothing. Pictures of cards have low priority and are not mentioned. */
export function pendingText(pending: readonly PendingRequest[]): string {
  const requests = pending.filter(({ queue }) => queue !== "cards");
  const places = requests.filter(({ place }) => place > 0).map(({ place }) => place);
  const active = requests.filter(({ place }) => place === 0);
  const surfaces = active.filter(({ queue }) => queue === "surfaces");
  if (surfaces.length > 0) {
    const share = Math.min(...surfaces.map(({ fraction }) => fraction));
    return `Extracting ${surfaces.length === 1 ? "a surface" : `${surfaces.length} surfaces`}: ${Math.floor(100 * share)} %`;
  }
  if (active[0]) return WORK[active[0].queue] ?? "";
  return places.length > 0 ? `Queued: position ${Math.min(...places)}` : "";
}
