// The viewer's folders stand in the order in which data flows: a file uses its own folder and those before it. Types alone may come from
// anywhere. And lines can be read.
import { readdirSync, readFileSync } from "node:fs";
import { dirname, join, normalize } from "node:path";
import { describe, expect, it } from "vitest";

const ORDER = ["state", "ask", "draw", "desk", "choose", "evolve", "inspect", "look", "save", "."];
const WEB = join(__dirname, "..");
const ROOT = join(WEB, "src", "viewer");
/** characters of a line */
const MOST = 140;

describe("the folders of the viewer", () => {
  it("depend on those before them", () => {
    const against: string[] = [];
    for (const [place, folder] of ORDER.entries()) {
      for (const file of readdirSync(join(ROOT, folder)).filter((name) => name.endsWith(".ts"))) {
        for (const [, used] of readFileSync(join(ROOT, folder, file), "utf8").matchAll(/^import (?!type )[^;]*?from "(\.[^"]*)"/gm)) {
          const from = dirname(normalize(join(folder, used ?? "")));
          if (!from.startsWith("..") && ORDER.indexOf(from) > place) against.push(`${folder}/${file} uses ${used}`);
        }
      }
    }
    expect(against).toEqual([]);
  });
});

describe("a line", () => {
  it("has at most 140 characters", () => {
    const long: string[] = [];
    for (const folder of ["src", "tests"]) {
      const names = readdirSync(join(WEB, folder), { recursive: true }).map(String);
      for (const file of names.filter((name) => name.endsWith(".ts"))) {
        const lines = readFileSync(join(WEB, folder, file), "utf8").split("\n");
        lines.forEach((line, i) => line.length > MOST && long.push(`${folder}/${file}:${i + 1}`));
      }
    }
    expect(long).toEqual([]);
  });
});
