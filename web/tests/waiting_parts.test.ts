import { describe, expect, it } from "vitest";
import { detailsOf, messages, pendingText, progressOf } from "../src/viewer/api/server_state";
import type { Build, PendingRequest, ServerState } from "../src/viewer/api/server_state";

function streamOf(...pieces: string[]): ReadableStream<Uint8Array> {
  return new ReadableStream({
    start(controller) {
      for (const piece of pieces) controller.enqueue(new TextEncoder().encode(piece));
      controller.close();
    },
  });
}

async function heard(...pieces: string[]): Promise<ServerState[]> {
  const all: ServerState[] = [];
  for await (const state of messages(streamOf(...pieces))) all.push(state);
  return all;
}

const building: Build = {
  phase: "trees",
  phase_index: 3,
  phase_count: 8,
  fraction: 0.4399,
  seconds_left: 12.3,
  voxels_per_second: null,
  peak_memory: 1.2e9,
};

describe("messages of the server", () => {
  it("are parsed, however they are split", async () => {
    const text = 'event: state\ndata: {"state":"open","requests":[]}\n\n:\n\nevent: state\ndata: {"state":"building","requests":[]}\n\n';
    const wanted = ["open", "building"];
    expect((await heard(text)).map(({ state }) => state)).toEqual(wanted);
    expect((await heard(...text)).map(({ state }) => state)).toEqual(wanted);
    expect(await heard(text.slice(0, 30))).toEqual([]);
  });
});

describe("the progress of a build", () => {
  it("is rounded down", () => {
    expect(progressOf(building)).toBe("building 43 %");
    expect(progressOf({ ...building, phase: "" })).toBe("building");
    expect(detailsOf(building)).toBe("Building merge trees, 12 s left, 1.2 GB of memory");
    expect(detailsOf({ ...building, phase: "pack", seconds_left: 600, voxels_per_second: 25e6, peak_memory: 0 })).toBe(
      "Writing the store, 10 min left, 25 million voxels per second",
    );
    expect(detailsOf({ ...building, phase: "new", seconds_left: null, peak_memory: 0 })).toBe("new");
  });
});

describe("pending requests", () => {
  it("are described: what is processed, or the first position in the queue", () => {
    const at = (place: number, fraction = 0, queue: PendingRequest["queue"] = "surfaces"): PendingRequest => ({
      client: "me/surface",
      queue,
      place,
      fraction,
    });
    expect(pendingText([])).toBe("");
    expect(pendingText([at(0, 0.5)])).toBe("Extracting a surface: 50 %");
    expect(pendingText([at(0, 0.5), at(0, 0.25), at(1)])).toBe("Extracting 2 surfaces: 25 %");
    expect(pendingText([at(7), at(3)])).toBe("Queued: position 3");
    expect(pendingText([at(0, 0, "atlas")])).toBe("Ranking objects");
    expect(pendingText([at(0, 0, "samples"), at(0, 0.5)])).toBe("Extracting a surface: 50 %");
    expect(pendingText([at(0, 0, "cards"), at(3, 0, "cards")])).toBe("");
  });
});
