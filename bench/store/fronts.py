#!/usr/bin/env python3
"""Octree fronts of stores beside the exact surface: from the same samples in memory, without a step before, and step by step.

    fronts.py BENCH_STORE [--volumes smooth-512 ...] [--active 0.02 0.1] [--threads 2] [--pairs 9] [--cache FOLDER] [--data FOLDER] [--json FILE]

Isovalues as in compare_vtk.py. Checked before: a front after a step has the same bytes as without one. Needs python3-vtk9 and numpy.
"""
import argparse
import json
import statistics
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from field import Field
from runs import FIELDS, REAL, add_options, chosen, ours, sources

PHASES = ["classes", "blocks", "leaves", "points", "triangles"]
VOLUMES = ["smooth-512", *FIELDS[1:], *REAL]


def record(program, store, volume, field, tau, arguments):
    found = ours(program, "fronts", store, tau, "--threads", arguments.threads, "--repeats", arguments.pairs)
    of = {name: statistics.median(values) for name, values in found.items()}
    return {"volume": volume, "tau": round(tau, 5), "active, %": field.percent(field.active_cells(tau)),
            "triangles": int(of["exact_triangles"]), "of the front": int(of["triangles"]),
            "front / exact, %": 100 * of["triangles"] / max(of["exact_triangles"], 1),
            "classified, MB": of["classified_bytes"] / 1e6, "reading, s": of["reading"], "exact, s": of["exact"], "front, s": of["front"],
            "step, s": of["step"],
            **{f"{phase}, ms": 1000 * of[f"step: {phase}"] for phase in PHASES}, "exact / step": of["exact"] / of["step"]}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_options(parser, VOLUMES, pairs=9)
    parser.add_argument("--active", type=float, nargs="+", default=[0.02, 0.1], help="fractions of active cells")
    parser.add_argument("--threads", type=int, default=2)
    arguments = parser.parse_args()
    records = []
    for volume in chosen(arguments, VOLUMES):
        store = Path(arguments.cache) / f"{volume}.atlas"
        built = ours(arguments.program, "build", volume, store, *sources(arguments), "--threads", arguments.threads, "--repeats", 1)
        field = Field(Path(arguments.cache) / f"{volume}.raw", built["size"], built["type"])
        for tau in field.isovalues_of(arguments.active):
            records.append(record(arguments.program, store, volume, field, tau, arguments))
            print(records[-1], flush=True)
        store.unlink()
    if arguments.json:
        Path(arguments.json).write_text(json.dumps({"threads": arguments.threads, "surfaces": records}, indent=1))


if __name__ == "__main__":
    main()
