#!/usr/bin/env python3
"""A surface without an index beside VTK's Flying Edges: the same samples, threads and normals. Answers first, then medians of pairs in
turns.

    compare_vtk.py BENCH_EXTRACT [--volumes smooth-256 ...] [--active 0.002 0.02 0.1 0.5] [--threads 1 2] [--pairs 5]
                   [--cache FOLDER] [--data FOLDER] [--json FILE]

A quick look: --volumes smooth-64 --pairs 2. Needs python3-vtk9 and numpy (Debian packages; run with the system's python3).
"""
import argparse
import json
import statistics
import sys
from pathlib import Path

import vtk

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from field import Field
from flying_edges import crossed, flying_edges, seconds_of_contouring
from runs import FIELDS, REAL, add_options, chosen, ours, sources, thread_counts, times_faster

VOLUMES = FIELDS + REAL


def check(run, volume, tau, field, image):
    """Every crossed edge is one point of Flying Edges; our closed surface has the components of the cut."""
    closed = run(tau, "--repeats", 1, "--check")["check"]
    good = closed["closed"] and closed["manifold"] and closed["oriented"] and closed["zero_area_triangles"] == 0
    if not good or closed["components"] != closed["contours_of_the_cut"]:
        sys.exit(f"{volume} at {tau}: wrong surface: {closed}")
    opened = run(tau, "--repeats", 1, "--open")
    edges = flying_edges(image, tau)
    edges.Update()
    points, (edges_crossed, cells) = edges.GetOutput().GetNumberOfPoints(), crossed(field.samples >= tau)
    if points != edges_crossed or opened["points"] < edges_crossed or cells != field.active_cells(tau):
        sys.exit(f"{volume} at {tau}: Flying Edges has {points} points, isoatlas {opened['points']}; {edges_crossed} edges are crossed")


def compare(run, volume, tau, threads, pairs, field, image):
    vtk.vtkSMPTools.Initialize(threads)
    own, theirs = [], []
    for _ in range(pairs):
        own.append(min(run(tau, "--threads", threads, "--repeats", 3)["seconds"]))
        theirs.append(min(seconds_of_contouring(image, tau) for _ in range(3)))
    cells, ratios = max(field.active_cells(tau), 1), [b / a for a, b in zip(own, theirs)]
    mine, vtks = statistics.median(own), statistics.median(theirs)
    return {"volume": volume, "tau": round(tau, 5), "threads": threads, "active cells": cells, "active, %": field.percent(cells),
            "isoatlas, s": mine, "VTK, s": vtks, "ns an active cell": 1e9 * mine / cells, "VTK, ns": 1e9 * vtks / cells,
            "times faster": times_faster(own, theirs), "lowest": min(ratios), "highest": max(ratios)}


def measure(volume, arguments, results):
    def run(*options):
        return ours(arguments.program, volume, *sources(arguments), *options)

    known = run()
    field = Field(Path(arguments.cache) / f"{volume}.raw", known["size"], known["type"])
    image = field.image()
    for tau in field.isovalues_of(arguments.active):
        check(run, volume, tau, field, image)
        for threads in arguments.threads:
            results.append(compare(run, volume, tau, threads, arguments.pairs, field, image))
            print(results[-1], flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_options(parser, VOLUMES, pairs=5)
    parser.add_argument("--active", type=float, nargs="+", default=[0.002, 0.02, 0.1, 0.5], help="fractions of active cells")
    parser.add_argument("--threads", type=int, nargs="+", default=thread_counts())
    arguments = parser.parse_args()
    results = []
    for volume in chosen(arguments, VOLUMES):
        measure(volume, arguments, results)
    if arguments.json:
        document = {"program": "vtkFlyingEdges3D " + vtk.vtkVersion().GetVTKVersion(), "pairs": arguments.pairs, "results": results}
        Path(arguments.json).write_text(json.dumps(document, indent=1))


if __name__ == "__main__":
    main()
