// The viewer's folders stand in the order in which data flows: a file uses its own folder and those before it. Types alone may come from anywhere.
import { readdirSync, readFileSync } from "node:fs";
import { dirname, join, normalize } from "node:path";
import { describe, expect, it } from "vitest";

const ORDER = ["state", "ask", "draw", "desk", "choose", "evolve", "inspect", "look", "save", "."];
const ROOT = join(__dirname, "..", "src", "viewer");

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
