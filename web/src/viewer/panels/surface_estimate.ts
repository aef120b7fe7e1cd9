// What a surface will be and cost, before it is made: all there is at the isovalue, and the object itself where its name is known there.
import { count, plural, value } from "../../shared/format";
import { entryOf } from "../../shared/page";
import type { Preview } from "../api/api";
import type { ViewerContext } from "../context/viewer_context";
import { branchOfShown, polarityOfEntry } from "../api/entries";
import type { Shown } from "../state/state";

/** on the wire: docs/server.md */
const BYTES_A_TRIANGLE = 2.7;

export async function badgeOf({ api, page }: ViewerContext, shown: Shown): Promise<string> {
  const isObject = branchOfShown(page, shown.entry)?.side === "object";
  const preview = await api.preview(shown.tau, isObject ? entryOf(page, shown.entry).id : null, polarityOfEntry(page, shown.entry));
  return `${preview.object ? `this object: ${shapeText(preview.object)}; ` : ""}${allText(preview)}`;
}

function shapeText({ tunnels, cavities }: { tunnels: number; cavities: number }): string {
  return `${plural(tunnels, "tunnel")}, ${plural(cavities, "cavity", "cavities")}`;
}

/** All there is at its isovalue. */
export function allText(preview: Preview): string {
  const [min, max] = preview.triangles;
  const triangles = min === max ? count(max) : `${count(min)} to ${count(max)}`;
  const all = `all at ${value(preview.tau)}: ${plural(preview.objects, "object")}, ${shapeText(preview)}`;
  return `${all}, ${triangles} triangles, at most ${bytesText(max * BYTES_A_TRIANGLE)}`;
}

export function bytesText(bytes: number): string {
  if (bytes < 1000) return `${Math.round(bytes)} bytes`;
  return bytes < 1e6 ? `${Math.round(bytes / 1000)} kB` : `${Number((bytes / 1e6).toPrecision(2))} MB`;
}
