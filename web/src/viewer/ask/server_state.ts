// What the server says while one listens: docs/server.md, /api/events.
export interface Build {
  /** "classify", "pack", ...; empty: it has only begun */
  phase: string;
  phase_index: number;
  phase_count: number;
  /** of the whole build, 0 to 1 */
  fraction: number;
  seconds_left: number | null;
  voxels_per_second: number | null;
  peak_memory: number;
}

/** One that is not yet answered. */
export interface Question {
  client: string;
  line: "surfaces" | "samples" | "trees" | "cards" | "atlas";
  /** in the queue, from 1; 0: the answer is being made */
  place: number;
  fraction: number;
}

export interface ServerState {
  state: "building" | "open" | "failed";
  build?: Build;
  error?: { message: string; what: string; next: string };
  questions: Question[];
}

/** The messages of a text/event-stream; comments are left out. */
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
  read: "reading the samples",
  classify: "looking for what is critical",
  sort: "sorting what is critical",
  trees: "growing the trees",
  zones: "measuring the zones",
  objects: "ranking the objects",
  pack: "writing the store",
};

function timeOf(seconds: number): string {
  if (seconds < 90) return `${Math.max(1, Math.round(seconds))} s`;
  return seconds < 5400 ? `${Math.round(seconds / 60)} min` : `${(seconds / 3600).toFixed(1)} h`;
}

/** "building 43 %" */
export function progressOf(build: Build): string {
  return build.phase === "" ? "building" : `building ${Math.floor(100 * build.fraction)} %`;
}

/** "growing the trees, 12 s left, 1.2 GB of memory" */
export function detailsOf(build: Build): string {
  const parts = [PHASES[build.phase] ?? build.phase];
  if (build.seconds_left !== null) parts.push(`${timeOf(build.seconds_left)} left`);
  if (build.voxels_per_second !== null) parts.push(`${(build.voxels_per_second / 1e6).toPrecision(2)} million voxels a second`);
  if (build.peak_memory > 0) parts.push(`${(build.peak_memory / 1e9).toPrecision(2)} GB of memory`);
  return parts.filter((part) => part !== "").join(", ");
}

/** What is being done for a line that has no share to tell. */
const WORK: Partial<Record<Question["line"], string>> = {
  samples: "reading samples",
  trees: "looking into the trees",
  atlas: "finding what stands out",
};

/** What one waits for; empty: nothing. Pictures of cards come when they come. */
export function waitingFor(questions: readonly Question[]): string {
  const awaited = questions.filter(({ line }) => line !== "cards");
  const waits = awaited.filter(({ place }) => place > 0).map(({ place }) => place);
  const made = awaited.filter(({ place }) => place === 0);
  const surfaces = made.filter(({ line }) => line === "surfaces");
  if (surfaces.length > 0) {
    const share = Math.min(...surfaces.map(({ fraction }) => fraction));
    return `making ${surfaces.length === 1 ? "a surface" : `${surfaces.length} surfaces`}: ${Math.floor(100 * share)} %`;
  }
  if (made[0]) return WORK[made[0].line] ?? "";
  return waits.length > 0 ? `waiting for a turn: ${Math.min(...waits)} in the queue` : "";
}
