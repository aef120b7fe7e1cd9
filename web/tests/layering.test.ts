// Folders of web/src are layers: a file imports from its own folder and those before it. Imports have no circle, types included.
import { readdirSync, readFileSync } from "node:fs";
import { dirname, join, normalize } from "node:path";
import { describe, expect, it } from "vitest";

const LAYERS = ["shared", "page", "viewer"];
const VIEWER_LAYERS = ["state", "api", "scene", "context", "panels", "tools", "export", "."];
const WEB = join(__dirname, "..");
/** characters of a line */
const MAX_COLUMNS = 140;

function sourcesIn(folder: string): string[] {
  const names = readdirSync(join(WEB, folder), { recursive: true }).map(String);
  return names.filter((name) => name.endsWith(".ts"));
}

/** Imports of a file in src. pattern: of an import; its last group is the path. */
function importsOf(file: string, pattern = /^(?:import|export) [^;]*?from "(\.[^"]*)"/gm): string[] {
  const text = readFileSync(join(WEB, "src", file), "utf8");
  return [...text.matchAll(pattern)].map(([, path]) => `${normalize(join(dirname(file), path ?? ""))}.ts`);
}

/** A circle in a graph, from a node back to itself; empty: none. */
function circleIn(edges: ReadonlyMap<string, readonly string[]>): string[] {
  const done = new Set<string>();
  const visit = (node: string, path: string[]): string[] => {
    if (path.includes(node)) return [...path.slice(path.indexOf(node)), node];
    if (done.has(node)) return [];
    for (const next of edges.get(node) ?? []) {
      const circle = visit(next, [...path, node]);
      if (circle.length > 0) return circle;
    }
    done.add(node);
    return [];
  };
  for (const node of edges.keys()) {
    const circle = visit(node, []);
    if (circle.length > 0) return circle;
  }
  return [];
}

describe("imports of web/src", () => {
  const files = sourcesIn("src");
  it("have no circle", () => {
    expect(circleIn(new Map([["a", ["b", "c"]], ["b", ["c"]], ["c", []]]))).toEqual([]);
    expect(circleIn(new Map([["a", ["b"]], ["b", ["c"]], ["c", ["b"]]]))).toEqual(["b", "c", "b"]);
    expect(importsOf("viewer/main.ts")).toContain("viewer/context/viewer_context.ts");
    expect(circleIn(new Map(files.map((file) => [file, importsOf(file)])))).toEqual([]);
  });
  it("of page and viewer come from their own folder or from shared", () => {
    const layer = (file: string): string => file.split("/")[0] ?? "";
    expect(new Set(files.map(layer))).toEqual(new Set(LAYERS));
    const isAllowed = (file: string, used: string): boolean => [layer(file), "shared"].includes(layer(used));
    expect(files.flatMap((file) => importsOf(file).filter((used) => !isAllowed(file, used)).map((used) => `${file}: ${used}`))).toEqual([]);
  });
  it("of the viewer follow its layers; types may come from anywhere", () => {
    const layer = (file: string): number => VIEWER_LAYERS.indexOf(dirname(file.slice("viewer/".length)));
    const viewer = files.filter((file) => file.startsWith("viewer/"));
    expect(viewer.filter((file) => layer(file) < 0)).toEqual([]);
    const valuesOf = (file: string): string[] => importsOf(file, /^import (?!type )[^;]*?from "(\.[^"]*)"/gm);
    const against = viewer.flatMap((file) =>
      valuesOf(file)
        .filter((used) => used.startsWith("viewer/") && layer(used) > layer(file))
        .map((used) => `${file}: ${used}`),
    );
    expect(against).toEqual([]);
  });
});

describe("a line", () => {
  it(`has at most ${MAX_COLUMNS} characters`, () => {
    const long: string[] = [];
    for (const folder of ["src", "tests"]) {
      for (const file of sourcesIn(folder)) {
        const lines = readFileSync(join(WEB, folder, file), "utf8").split("\n");
        lines.forEach((line, i) => line.length > MAX_COLUMNS && long.push(`${folder}/${file}:${i + 1}`));
      }
    }
    expect(long).toEqual([]);
  });
});
