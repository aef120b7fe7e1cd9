#!/usr/bin/env python3
"""Builds of stores: beside an analysis of the same volume in memory, and beside the answers that the store holds, computed in memory; by phase.

    builds.py BENCH_STORE [--volumes smooth-512 ...] [--threads 2] [--pairs 2] [--cache FOLDER] [--data FOLDER] [--json FILE]

In turns, medians. The peak is that of the first build: later ones find memory that the analyses before them have left to the process.
"""
import argparse
import json
import statistics
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from runs import FIELDS, REAL, add_options, chosen, ours, sources

VOLUMES = ["smooth-512", *FIELDS[1:], "pet", *REAL]


def times_longer(seconds, others):
    return statistics.median(a / b for a, b in zip(seconds, others))


def build_record(volume, built):
    seconds, analysis, answers = built["seconds"], built["analysis_seconds"], built["answers_seconds"]
    in_memory = {"its answers in memory, s": statistics.median(answers), "build / answers": times_longer(seconds, answers)} if answers else \
        {"its answers in memory, s": "", "build / answers": ""}  # no table of objects: too many elements
    return {"volume": volume, "size": "x".join(map(str, built["size"])), "type": built["type"], "build, s": statistics.median(seconds),
            "analysis in memory, s": statistics.median(analysis), "build / analysis": times_longer(seconds, analysis), **in_memory,
            "ns a voxel": 1e9 * statistics.median(seconds) / built["voxels"], "peak bytes a voxel": built["peak_bytes"] / built["voxels"],
            "bytes a voxel": built["bytes_per_voxel"], "bytes of a sample": built["sample_bytes"],
            "bytes / raw": built["bytes_per_voxel"] / built["sample_bytes"]}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_options(parser, VOLUMES, pairs=2)
    parser.add_argument("--threads", type=int, default=2)
    arguments = parser.parse_args()
    document = {"threads": arguments.threads, "pairs": arguments.pairs, "builds": [], "volumes": []}
    for volume in chosen(arguments, VOLUMES):
        store = Path(arguments.cache) / f"{volume}.atlas"
        built = ours(arguments.program, "build", volume, store, *sources(arguments), "--threads", arguments.threads, "--analysis",
                     "--repeats", arguments.pairs)
        store.unlink()
        document["builds"].append(build_record(volume, built))
        document["volumes"].append({"volume": volume, "phases": built["phases"]})
        print(document["builds"][-1], flush=True)
    if arguments.json:
        Path(arguments.json).write_text(json.dumps(document, indent=1))


if __name__ == "__main__":
    main()
