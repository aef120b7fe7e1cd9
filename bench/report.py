#!/usr/bin/env python3
"""Renders the tables of docs/performance.md from what the benchmarks wrote.

    report.py FOLDER [PAGE]   FOLDER holds what was measured: engine.json, extract.json, store.json, render.json, pages.json; PAGE:
                             docs/performance.md
"""
import json
import re
import sys
from pathlib import Path

from machine import in_words


def table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return "\n".join(lines)


def thousands(number):
    return f"{number:,}".replace(",", " ")


def dims(record):
    return "x".join(str(n) for n in record["size"])


GOALS = {"smooth-256": 0.15, "noisy-256": 1.0, "white-256": 2.0}
NOISE = {"noisy-256", "white-256"}
BETWEEN = {"seg3d_mr"}  # an MR image: neither CT-like nor noise


def interior(record):
    if record["volume"] in BETWEEN:
        return f"{record['trilinear_ratio']:.2f}"
    goal = 1.5 if record["volume"] in NOISE else 1.3
    return f"{record['trilinear_ratio']:.2f} (at most {goal}: " + ("met)" if record["trilinear_ratio"] <= goal else "**missed**)")


def engine_table(engine):
    rows = []
    for r in engine["volumes"]:
        goal = GOALS.get(r["volume"])
        verdict = "" if goal is None else f"{goal} " + ("met" if r["ratio"] <= goal else "**missed**")
        memory = "met" if r["peak_over_allowed"] <= 1 else "**missed**"
        low, high = r["ratio_range"]
        rows.append([r["volume"], dims(r), r["type"], thousands(r["critical_elements"]), f"{r['sort_seconds']:.3f}", f"{r['seconds']:.3f}",
                     f"{r['seconds_one_thread']:.3f}", f"{r['ratio']:.3f} ({low:.3f} to {high:.3f})", verdict,
                     interior(r), thousands(r["trilinear_elements"]),
                     f"{r['peak_bytes_per_voxel']:.1f}", f"{r['peak_over_allowed']:.2f} {memory}"])
    header = ["volume", "size", "type", "critical elements", "sort, s", f"{engine['threads']} threads, s", "1 thread, s",
              "ratio to the sort (range)", "goal", "trilinear / faces", "elements with body points", "peak bytes a voxel", "peak / allowed"]
    return table(header, rows)


def phases_table(engine):
    names = []
    for r in engine["volumes"]:
        names += [name for name in r.get("phases", {}) if name not in names]
    rows = [[r["volume"]] + [f"{r['phases'][name]:.3f}" if name in r.get("phases", {}) else "" for name in names] for r in engine["volumes"]]
    return table(["seconds"] + names, rows)


def growth_table(engine):
    rows, before = [], None
    for r in engine.get("growth", []):
        same_field = before is not None and before["volume"].rsplit("-", 1)[0] == r["volume"].rsplit("-", 1)[0]
        growth = f"{r['seconds'] / before['seconds']:.1f}" if same_field else ""
        elements = r["critical_elements"]
        per_element = f"{1e9 * r['seconds'] / elements:.0f}" if 10 * elements > r["voxels"] else ""  # where elements are the cost
        rows.append([r["volume"], dims(r), thousands(elements), f"{r['seconds']:.3f}", growth,
                     f"{1e9 * r['seconds'] / r['voxels']:.1f}", per_element, f"{r['peak_bytes_per_voxel']:.1f}", f"{r['peak_over_allowed']:.2f}"])
        before = r
    header = ["volume", "size", "critical elements", f"{engine['threads']} threads, s", "times the size before", "ns a voxel", "ns an element",
              "peak bytes a voxel", "peak / allowed"]
    return table(header, rows) if rows else None


def store_misses(record, column):
    """Is a ratio below its goal?"""
    is_smooth = record["volume"].startswith("smooth")
    of_first_query = {0.2: 6, 2: 2.5, 4.4: 2}.get(round(record["active, %"], 1), 1) if is_smooth else 1
    goals = {"times faster": of_first_query, "again, times faster": 5 if is_smooth else 2, "steps, times faster than fresh": 2}
    return column in goals and record[column] < goals[column]


def render_misses(record, column):
    return column.endswith("times faster") and record[column] < 1


def page_misses(record, column):
    """Does it take longer than it may?"""
    goals = {"five pictures, s": 2, "all, s": 8} if record["volume"] == "headsq" else {"five pictures, s": 5, "all, s": 15}
    return column in goals and record[column] > goals[column]


def cell(record, key, misses):
    number = record.get(key, "")
    if not isinstance(number, float):
        return number
    return f"**{number:.4g}**" if misses(record, key) else f"{number:.4g}"


def generic_table(records, misses=lambda record, column: False):
    """A list of flat records, as the other benchmarks write it: the keys are the columns. misses: which numbers are in bold."""
    header = list(records[0])
    rows = [[cell(r, key, misses) for key in header] for r in records]
    return table([name.replace("_", " ") for name in header], rows)


def replace(page, mark, text):
    pattern = re.compile(rf"(<!-- {mark}:begin -->\n).*?(<!-- {mark}:end -->)", re.S)
    if not pattern.search(page):
        sys.exit(f"report: the page has no marks for '{mark}'")
    return page if text is None else pattern.sub(lambda match: match.group(1) + text + "\n" + match.group(2), page)


TABLES = [
    ("engine", "engine", engine_table),
    ("phases", "engine", phases_table),
    ("growth", "engine", growth_table),  # measured with --growth only
    ("extract", "extract", lambda document: generic_table(document["results"])),
    ("store-builds", "store", lambda document: generic_table(document["builds"])),
    ("store-surfaces", "store", lambda document: generic_table(document["surfaces"], store_misses)),
    ("store-objects", "store", lambda document: generic_table(document["objects"])),
    ("render", "render", lambda document: generic_table(document["pictures"], render_misses)),
    ("pages", "pages", lambda document: generic_table(document["pages"], page_misses)),
]


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    folder = Path(sys.argv[1])
    path = Path(sys.argv[2] if len(sys.argv) == 3 else "docs/performance.md")
    page = path.read_text()
    documents = {name: json.loads((folder / f"{name}.json").read_text()) for name in ("engine", "extract", "store", "render", "pages")
                 if (folder / f"{name}.json").exists()}
    for mark, name, make in TABLES:
        text = make(documents[name]) if name in documents else None
        page = replace(page, mark, text and in_words(documents[name]["machine"]) + "\n\n" + text)
    path.write_text(page)
    print(f"report: {path} is up to date")


if __name__ == "__main__":
    main()
