// What a surface will be and cost, before it is made: all there is at the isovalue, and the object itself where its name is known there.
import { count, plural, value } from "../../format";
import { entryOf } from "../../page";
import type { Preview } from "../ask/api";
import type { Desk } from "../desk/desk";
import { branchOfShown } from "../ask/shown";
import type { Shown } from "../state/state";

/** on the wire: docs/server.md */
const BYTES_A_TRIANGLE = 2.7;

export async function badgeOf({ api, page }: Desk, shown: Shown): Promise<string> {
  const isObject = branchOfShown(page, shown.entry)?.side === "bright";
  const preview = await api.preview(shown.tau, isObject ? entryOf(page, shown.entry).id : null);
  return `${preview.object ? `this object: ${shapeText(preview.object)}; ` : ""}${allText(preview)}`;
}

function shapeText({ tunnels, cavities }: { tunnels: number; cavities: number }): string {
  return `${plural(tunnels, "tunnel")}, ${plural(cavities, "cavity", "cavities")}`;
}

/** All there is at its isovalue. */
export function allText(preview: Preview): string {
  const [least, most] = preview.triangles;
  const triangles = least === most ? count(most) : `${count(least)} to ${count(most)}`;
  const all = `all at ${value(preview.tau)}: ${plural(preview.objects, "object")}, ${shapeText(preview)}`;
  return `${all}, ${triangles} triangles, at most ${bytesText(most * BYTES_A_TRIANGLE)}`;
}

export function bytesText(bytes: number): string {
  if (bytes < 1000) return `${Math.round(bytes)} bytes`;
  return bytes < 1e6 ? `${Math.round(bytes / 1000)} kB` : `${Number((bytes / 1e6).toPrecision(2))} MB`;
}
