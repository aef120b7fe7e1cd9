#!/usr/bin/env python3
"""Renders the tables of docs/performance.md from what the benchmarks wrote.

    report.py --self-test
    report.py FOLDER [PAGE]   FOLDER holds what was measured: engine.json, extract.json, decoding.json, store.json, fronts.json, render.json, pages.json, remote.json,
                              methods.json, methods-surfaces.json and scale-SECTION.json, those that are there; PAGE: docs/performance.md

A table replaces the one of the same processor, as many of them and vectors (AVX2, AVX-512); those of others stay. What misses its goal is in bold.
"""
import json
import math
import re
import sys
from pathlib import Path

from machine import HEAD, in_words, kind, processor


def table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return "\n".join(lines)


def thousands(number):
    return f"{number:,}".replace(",", " ")


def in_threads(count):
    return f"{count} thread{'' if int(count) == 1 else 's'}, s"


def dims(record):
    return "x".join(str(n) for n in record["size"])


def bold(text, misses):
    return f"**{text}**" if misses else text


GOALS = {"smooth-256": 0.15, "noisy-256": 1.0, "white-256": 2.0}
NOISE = ("noisy", "white")
BETWEEN = {"seg3d_mr"}  # an MR image: neither CT-like nor noise


def interior_misses(record):
    goal = 1.5 if record["volume"].startswith(NOISE) else 1.3
    return record["volume"] not in BETWEEN and record["trilinear_ratio"] > goal


def engine_table(engine):
    counts = list(engine["volumes"][0]["seconds_by_threads"])
    rows = []
    for r in engine["volumes"]:
        goal, (low, high) = GOALS.get(r["volume"], ""), r["ratio_range"]
        rows.append([r["volume"], dims(r), r["type"], thousands(r["critical_elements"]), f"{r['sort_seconds']:.3f}",
                     *(f"{r['seconds_by_threads'][n]:.3f}" for n in counts),
                     bold(f"{r['ratio']:.3f}", goal and r["ratio"] > goal) + f" ({low:.3f} to {high:.3f})", goal,
                     bold(f"{r['trilinear_ratio']:.2f}", interior_misses(r)), thousands(r["trilinear_elements"]),
                     f"{r['peak_bytes_per_voxel']:.1f}", bold(f"{r['peak_over_allowed']:.2f}", r["peak_over_allowed"] > 1)])
    header = ["volume", "size", "type", "critical elements", "sort, s", *(in_threads(n) for n in counts), "ratio to the sort (range)", "goal",
              "trilinear / faces", "elements with body points", "peak bytes a voxel", "peak / allowed"]
    return table(header, rows)


def phases_table(engine):
    names = []
    for r in engine["volumes"]:
        names += [name for name in r.get("phases", {}) if name not in names]
    rows = [[r["volume"]] + [f"{r['phases'][name]:.3f}" if name in r.get("phases", {}) else "" for name in names] for r in engine["volumes"]]
    return table(["seconds"] + names, rows)


def slope(voxels, seconds):
    """Of log(seconds) against log(voxels), by least squares; None of fewer than two sizes."""
    x, y = [math.log(n) for n in voxels], [math.log(s) for s in seconds]
    middle = sum(x) / len(x)
    spread = sum((a - middle)**2 for a in x)
    return sum((a - middle) * b for a, b in zip(x, y)) / spread if spread else None


STEEPEST = math.log(10) / math.log(8)  # eight times the voxels in ten times the time


def scale_table(document):
    """Rows of records, and below those of a field its slopes."""
    records = document["records"]
    columns = [(what, n) for what, by_threads in records[0]["seconds"].items() for n in by_threads]
    header = ["volume", *(f"{what} {in_threads(n)}".strip() for what, n in columns)]
    header += [f"{what} ns a voxel".strip() for what in records[0]["seconds"]]
    header += [*(f"{what}, bytes a voxel" for what in records[0]["bytes"]), *records[0]["more"]]
    rows = []
    for field in dict.fromkeys(r["field"] for r in records):
        own = [r for r in records if r["field"] == field]
        for r in own:
            rows.append([f"{r['field']}-{r['size']}", *(f"{r['seconds'][what][n]:.4g}" for what, n in columns),
                         *(f"{1e9 * by_threads['2'] / r['voxels']:.4g}" for by_threads in r["seconds"].values()),
                         *(f"{size / r['voxels']:.4g}" for size in r["bytes"].values()),
                         *(f"{value:.4g}" if isinstance(value, float) else thousands(value) for value in r["more"].values())])
        slopes = [slope([r["voxels"] for r in own], [r["seconds"][what][n] for r in own]) for what, n in columns]
        rows.append([f"{field}: slope", *("" if s is None else bold(f"{s:.2f}", s > STEEPEST) for s in slopes)])
        rows[-1] += [""] * (len(header) - len(rows[-1]))
    return table(header, rows)


def build_misses(record, column):
    return column == "build / analysis" and record[column] > 2


def extract_misses(record, column):
    return column == "times faster" and record[column] < 1


def store_misses(record, column):
    """Is a ratio below its goal?"""
    is_smooth = record["volume"].startswith("smooth")
    of_first_query = {0.2: 6, 2: 2.5, 4.4: 2}.get(round(record["active, %"], 1), 1) if is_smooth else 1
    goals = {"times faster": of_first_query, "again, times faster": 5 if is_smooth else 2, "steps, times faster than fresh": 2}
    return column in goals and record[column] < goals[column]


def decoding_misses(record, column):
    return column == "decoded, GB/s" and record[column] < 2


def front_misses(record, column):
    return column == "step, s" and record["volume"] == "smooth-512" and record[column] > 0.05


def render_misses(record, column):
    return column.endswith("times faster") and record[column] < 1 or column in ("flat, s", "shaded, s") and record[column] > 1


def format_misses(record, column):
    return column == "isoatlas / library" and record[column] > 1.3


def python_misses(record, column):
    return column == "Python / C++" and record[column] > 1.05


def remote_misses(record, column):
    return column in ("page, s", "first surface, s") and record[column] > 2


def page_misses(record, column):
    """Does it take longer than it may?"""
    goals = {"five pictures, s": 2, "all, s": 8} if record["volume"] == "headsq" else {"five pictures, s": 5, "all, s": 15}
    return column in goals and record[column] > goals[column]


def cell(record, key, misses):
    number = record.get(key, "")
    if not isinstance(number, float):
        return number
    return bold(f"{number:.4g}", misses(record, key))


def generic_table(records, misses=lambda record, column: False):
    """A list of flat records, as the other benchmarks write it: the keys are the columns. misses: which numbers are in bold."""
    header = list(records[0])
    rows = [[cell(r, key, misses) for key in header] for r in records]
    return table([name.replace("_", " ") for name in header], rows)


def beyond(record):
    """At the worst isovalue: cells and nodes looked at beyond the active cells; of a file, blocks beyond those that they fill."""
    block = record["cells_of_block"]
    if block:
        return max(q["blocks"] - math.ceil(q["k"] / block) for q in record["queries"])
    return max(q["cells"] + q["nodes"] - q["k"] for q in record["queries"])


def of_active(record):
    """The exponent of k in all that is looked at, over the isovalues."""
    queries = [q for q in record["queries"] if q["k"] > 0]
    return slope([q["k"] for q in queries], [q["blocks"] if record["cells_of_block"] else q["cells"] + q["nodes"] for q in queries])


def methods_table(document):
    """A row for each search: exponents of n in what it looks at beyond the active cells, and of k in all that it looks at."""
    records = document["records"]
    fields = list(dict.fromkeys(r["volume"].rsplit("-", 1)[0] for r in records))
    header = ["search", "a query, as its source says"]
    for field in fields:
        largest = [r["volume"] for r in records if r["volume"].startswith(field + "-")][-1]
        header += [f"{largest}: beyond", f"{field}: exponent of n", f"{largest}: exponent of k"]
    rows = []
    for name in dict.fromkeys(r["search"] for r in records):
        rows.append([name, next(r["theorem"] for r in records if r["search"] == name)])
        for field in fields:
            own = [r for r in records if r["search"] == name and r["volume"].startswith(field + "-")]
            counts = [(r["n"], beyond(r)) for r in own if beyond(r) > 0]
            power, of_k = slope(*zip(*counts)) if counts else None, of_active(own[-1])
            unit = " blocks" if own[-1]["cells_of_block"] else ""
            rows[-1] += [thousands(beyond(own[-1])) + unit, *("" if e is None else f"{e:.2f}".replace("-0.00", "0.00") for e in (power, of_k))]
    return table(header, rows)


def surfaces_table(document):
    """A row for each method on each volume: what it makes, beside VTK and scikit-image."""
    rows = []
    for found in document["results"]:
        of = f"{found['volume']} at {found['tau']:g}, {thousands(found['active cells'])} active cells"
        for row in found["rows"]:
            counts = [row[column] for column in ("triangles", "components", "euler", "hole_edges", "non_manifold_edges")]
            if row["triangles"] == 0:
                continue  # points
            rows.append([of, row["method"], *(thousands(count) for count in counts), f"{row['seconds']:.3f}"])
            of = ""
    return table(["volume", "method", "triangles", "components", "Euler number", "edges of holes", "non-manifold edges", "seconds"], rows)


ORDER = ["no AVX2", "AVX2", "AVX-512"]


def parts_of(text):
    """{(vectors, processor, how many): head and table}: what is between the marks. What has no head is old: dropped."""
    heads = list(HEAD.finditer(text))
    ends = [head.start() for head in heads[1:]] + [len(text)]
    return {(kind(head[0]), *processor(head[0])): text[head.start():end].strip() for head, end in zip(heads, ends)}


def replace(page, mark, text):
    """The table between these marks, of the same processor, as many of them and vectors, or a new one; all of them by one that names none."""
    pattern = re.compile(rf"(<!-- {mark}:begin -->\n)(.*?)(<!-- {mark}:end -->)", re.S)
    found = pattern.search(page)
    if not found:
        sys.exit(f"report: the page has no marks for '{mark}'")
    parts = parts_of(found[2]) | parts_of(text)
    joined = "\n\n".join(parts[name] for name in sorted(parts, key=lambda name: (ORDER.index(name[0]), *name[1:]))) if parts_of(text) else text
    return page[:found.start()] + found[1] + joined + "\n" + found[3] + page[found.end():]


MEASURED_TO = 0.0011  # voxels: distances are upper bounds, a thousandth of a voxel above what is known to be there


def simplified_table(document):
    """A row for each method on each surface; what differs from the exact surface, or is farther than was asked for, is in bold."""
    rows, last = [], None
    for r in document["simplified"]:
        def count(key, row=r):
            if row[key] is None:
                return ""
            found, exact = row[key].split(" of ")
            return bold(found, found != exact)
        distance = r["distance, voxels"]
        rows.append(["" if r["surface"] == last else r["surface"], r["method"], "" if r["triangles"] is None else thousands(r["triangles"]),
                     "" if distance is None else bold(f"{distance:.3f}", distance > document["voxels"] + MEASURED_TO), count("contours"), count("genus"),
                     "" if r["self-crossings"] is None else bold(r["self-crossings"], r["self-crossings"] > 0), r["what else is wrong"],
                     "" if r["seconds"] is None else f"{r['seconds']:.2f}"])
        last = r["surface"]
    return table(["surface", "method", "triangles", "distance, voxels", "contours", "genus", "self-crossings", "what else is wrong", "seconds"], rows)


TABLES = [
    ("engine", "engine", engine_table),
    ("phases", "engine", phases_table),
    ("extract", "extract", lambda document: generic_table(document["results"], extract_misses)),
    ("store-builds", "builds", lambda document: generic_table(document["builds"], build_misses)),
    ("store-phases", "builds", phases_table),
    ("store-decoding", "decoding", lambda document: generic_table(document["decoding"], decoding_misses)),
    ("store-surfaces", "store", lambda document: generic_table(document["surfaces"], store_misses)),
    ("store-objects", "store", lambda document: generic_table(document["objects"])),
    ("fronts", "fronts", lambda document: generic_table(document["surfaces"], front_misses)),
    ("formats", "formats", lambda document: generic_table(document["formats"], format_misses)),
    ("render", "render", lambda document: generic_table(document["pictures"], render_misses)),
    ("pages", "pages", lambda document: generic_table(document["pages"], page_misses)),
    ("remote", "remote", lambda document: generic_table(document["remote"], remote_misses)),
    ("python-surfaces", "python", lambda document: generic_table(document["surfaces"], python_misses)),
    ("python-facts", "python", lambda document: generic_table(document["facts"])),
    ("methods", "methods", methods_table),
    ("methods-surfaces", "methods-surfaces", surfaces_table),
    ("simplify", "simplify", simplified_table),
] + [(f"scale-{section}", f"scale-{section}", scale_table) for section in ("analysis", "extract", "stores", "render", "pages")]


def self_test():
    avx2 = "A, AVX2, 2 processors, 2026-01-01, commit 01234567.\n\n| a |"
    wide = "B, AVX-512, 4 processors, 2026-01-02, commit 89abcdef.\n\n| b |"
    narrowed = "B, AVX-512, ISOATLAS_SIMD=avx2, 4 processors, 2026-01-03, commit 89abcdef.\n\n| c |"
    again = avx2.replace("| a |", "| d |")
    page = "x\n<!-- t:begin -->\nZ, 3 pairs.\n\n| old |\n<!-- t:end -->\ny\n"
    for text, parts in ((wide, [wide]), (avx2, [avx2, wide]), (narrowed, [avx2, narrowed, wide]), (again, [again, narrowed, wide])):
        page = replace(page, "t", text)
        assert page == "x\n<!-- t:begin -->\n" + "\n\n".join(parts) + "\n<!-- t:end -->\ny\n", page
    assert replace(page, "t", "| c |") == "x\n<!-- t:begin -->\n| c |\n<!-- t:end -->\ny\n"  # table131.py
    assert abs(slope([8, 64, 512], [2, 4, 8]) - 1 / 3) < 1e-9 and slope([8], [2]) is None
    records = [{"field": "smooth", "size": n, "voxels": n**3, "seconds": {"": {"1": n**3, "2": n**4}}, "bytes": {}, "more": {}} for n in (2, 4)]
    assert scale_table({"records": records}).endswith("| smooth: slope | 1.00 | **1.33** |  |")
    queries = lambda n: [{"k": k, "cells": k + n, "nodes": 0, "blocks": 0} for k in (1, n * n)]
    records = [{"volume": f"smooth-{n}", "n": n**3, "search": "s", "theorem": "n", "cells_of_block": 0, "queries": queries(n)} for n in (2, 4)]
    assert methods_table({"records": records}).endswith("| s | n | 4 | 0.33 | 0.50 |"), methods_table({"records": records})
    row = {"method": "m", "triangles": 1200, "components": 1, "euler": 2, "hole_edges": 0, "non_manifold_edges": 0, "seconds": 0.5}
    found = {"volume": "v", "tau": 0.5, "active cells": 600, "rows": [row, row | {"triangles": 0}]}
    assert surfaces_table({"results": [found]}).endswith("| v at 0.5, 600 active cells | m | 1 200 | 1 | 2 | 0 | 0 | 0.500 |")
    row = {"surface": "v@1", "method": "m", "triangles": 10, "distance, voxels": 0.75, "contours": "1 of 2", "genus": "3 of 3", "self-crossings": 0,
           "what else is wrong": "", "seconds": None}
    simplified = simplified_table({"voxels": 0.5, "simplified": [row, row | {"triangles": None, "contours": None, "distance, voxels": None}]})
    assert simplified.endswith("| v@1 | m | 10 | **0.750** | **1** | 3 | 0 |  |  |\n|  | m |  |  |  | 3 | 0 |  |  |"), simplified


def main():
    if sys.argv[1:] == ["--self-test"]:
        self_test()
        return
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    folder = Path(sys.argv[1])
    path = Path(sys.argv[2] if len(sys.argv) == 3 else "docs/performance.md")
    page = path.read_text()
    for mark, name, make in TABLES:
        if (folder / f"{name}.json").exists():
            document = json.loads((folder / f"{name}.json").read_text())
            page = replace(page, mark, in_words(document["machine"]) + "\n\n" + make(document))
    path.write_text(page)
    print(f"report: {path} is up to date")


if __name__ == "__main__":
    main()
