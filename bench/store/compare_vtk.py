#!/usr/bin/env python3
"""A store beside VTK: surfaces from the store against Flying Edges over the volume in memory (warm) and against reading the volume file and
contouring it (cold); one small object; opening. builds.py measures what building costs. Answers first, then medians of runs in turns.

    compare_vtk.py BENCH_STORE [--volumes smooth-512 ...] [--active 0.002 0.02 0.1 0.5] [--threads 2] [--pairs 3]
                   [--cache FOLDER] [--data FOLDER] [--json FILE]

A quick look: --volumes smooth-64 white-64 --pairs 2. Cold files: their pages are dropped before every run; "cold disk" says what then
really came from the disk, 0 where the system does not drop pages. Needs python3-vtk9 and numpy (Debian packages; the system's python3).
"""
import argparse
import json
import os
import statistics
import sys
import time
from pathlib import Path

import vtk

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from field import Field
from flying_edges import crossed, flying_edges, seconds_of_contouring
from runs import FIELDS, REAL, add_options, chosen, ours, sources, times_faster

VOLUMES = ["smooth-512", *FIELDS[1:], "pet", *REAL]


def drop_pages(path):
    with open(path, "rb") as file:
        os.fsync(file.fileno())
        os.posix_fadvise(file.fileno(), 0, 0, os.POSIX_FADV_DONTNEED)


def seconds_of_reading_and_contouring(field, tau):
    drop_pages(field.path)
    start = time.perf_counter()
    flying_edges(field.read(), tau).Update()
    return time.perf_counter() - start


def check(program, store, tau, volume, field, image, where):
    if not ours(program, "check", store, tau, volume, *where)["same_as_the_volume"]:
        sys.exit(f"{volume} at {tau}: the surface of the store is not that of the volume")
    edges = flying_edges(image, tau)
    edges.Update()
    points, (edges_crossed, cells) = edges.GetOutput().GetNumberOfPoints(), crossed(field.samples >= tau)
    if points != edges_crossed or cells != field.active_cells(tau):
        sys.exit(f"{volume} at {tau}: Flying Edges has {points} points, {edges_crossed} edges are crossed; {cells} cells are active")


def steps_ratio(program, store, tau, arguments):
    result = ours(program, "steps", store, tau, "--threads", arguments.threads, "--repeats", 9)
    return times_faster(result["step"], result["fresh"])


def undecoded(own, threads, decoding=0.0):
    """Seconds of a first query that only copies its samples, and decodes them for so many seconds: on all threads, and then the surface."""
    return [again + (copy + decoding) / threads for again, copy in zip(own["again"], own["copy"])]


def surface_record(program, store, volume, field, image, tau, arguments):
    active = field.active_cells(tau)
    own = {"warm": [], "again": [], "cold": [], "copy": []}
    vtk_warm, vtk_cold = [], []
    for _ in range(arguments.pairs):
        result = ours(program, "surface", store, tau, "--threads", arguments.threads, "--repeats", 3)
        for name, times in own.items():
            times.append(min(result[name]))
        vtk_warm.append(min(seconds_of_contouring(image, tau) for _ in range(3)))
        vtk_cold.append(min(seconds_of_reading_and_contouring(field, tau) for _ in range(2)))
    return {"volume": volume, "tau": round(tau, 5), "active cells": active, "active, %": field.percent(active),
            "warm, s": statistics.median(own["warm"]), "VTK in memory, s": statistics.median(vtk_warm),
            "times faster": times_faster(own["warm"], vtk_warm), "again, times faster": times_faster(own["again"], vtk_warm),
            "undecoded, times faster": times_faster(undecoded(own, arguments.threads), vtk_warm),
            "at 2 GB/s, times faster": times_faster(undecoded(own, arguments.threads, result["samples_bytes"] / 2e9), vtk_warm),
            "cold, s": statistics.median(own["cold"]), "VTK from the file, s": statistics.median(vtk_cold),
            "cold, times faster": times_faster(own["cold"], vtk_cold), "cold disk MB": result["cold_disk_bytes"] / 1e6,
            "steps, times faster than fresh": steps_ratio(program, store, tau, arguments),
            "bytes an active cell": result["bytes"] / max(active, 1), "reads": result["extents"]}


def object_record(program, store, volume, tau, arguments):
    result = ours(program, "object", store, tau, "--threads", arguments.threads, "--repeats", 7)
    milliseconds = {name: 1e3 * statistics.median(result[name]) for name in ("open", "warm", "again", "cold_open", "cold")}
    return {"volume": volume, "tau": round(tau, 5), "object's voxels": result["object_voxels"], "triangles": result["triangles"],
            "open, ms": milliseconds["open"], "warm, ms": milliseconds["warm"], "again, ms": milliseconds["again"],
            "cold open, ms": milliseconds["cold_open"], "cold query, ms": milliseconds["cold"] - milliseconds["cold_open"],
            "kB": result["bytes"] / 1e3, "reads": result["extents"], "cold disk kB": result["cold_disk_bytes"] / 1e3}


def measure(volume, arguments, document):
    program, cache = arguments.program, Path(arguments.cache)
    store = cache / f"{volume}.atlas"
    built = ours(program, "build", volume, store, *sources(arguments), "--threads", arguments.threads, "--repeats", 1)
    field = Field(cache / f"{volume}.raw", built["size"], built["type"])
    image, isovalues = field.image(), field.isovalues_of(arguments.active)
    for tau in isovalues:
        check(program, store, tau, volume, field, image, sources(arguments))
        document["surfaces"].append(surface_record(program, store, volume, field, image, tau, arguments))
        print(document["surfaces"][-1], flush=True)
    document["objects"].append(object_record(program, store, volume, isovalues[0], arguments))
    print(document["objects"][-1], flush=True)
    store.unlink()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_options(parser, VOLUMES, pairs=3)
    parser.add_argument("--active", type=float, nargs="+", default=[0.002, 0.02, 0.1, 0.5], help="fractions of active cells")
    parser.add_argument("--threads", type=int, default=2)
    arguments = parser.parse_args()
    vtk.vtkSMPTools.Initialize(arguments.threads)
    document = {"threads": arguments.threads, "pairs": arguments.pairs, "surfaces": [], "objects": []}
    for volume in chosen(arguments, VOLUMES):
        measure(volume, arguments, document)
    if arguments.json:
        Path(arguments.json).write_text(json.dumps(document, indent=1))


if __name__ == "__main__":
    main()
