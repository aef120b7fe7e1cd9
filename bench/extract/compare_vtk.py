#!/usr/bin/env python3
"""isoatlas extract beside VTK's Flying Edges: the same raw volume, threads and normals; answers first, then medians of pairs run in turns.

    compare_vtk.py BENCH_EXTRACT [--size 256] [--tau 0 2] [--threads 1 2] [--pairs 7] [--cache FOLDER] [--json FILE]

Needs python3-vtk9 and numpy (Debian packages; run with the system's python3).
"""
import argparse
import json
import os
import statistics
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from flying_edges import crossed, flying_edges


def ours(program, raw, size, tau, *options):
    command = [program, str(raw), str(size), repr(tau), *options]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def vtk_components(surface):
    connectivity = vtk.vtkPolyDataConnectivityFilter()
    connectivity.SetInputData(surface)
    connectivity.SetExtractionModeToAllRegions()
    connectivity.Update()
    return connectivity.GetNumberOfExtractedRegions()


def check(program, raw, size, tau, image, edges_crossed):
    """Answers first. Every crossed edge is one point of Flying Edges; our closed surface has the components of the cut."""
    closed = ours(program, raw, size, tau, "--repeats", "1", "--check")["check"]
    good = closed["closed"] and closed["manifold"] and closed["oriented"] and closed["zero_area_triangles"] == 0
    if not good or closed["components"] != closed["contours_of_the_cut"]:
        sys.exit(f"wrong surface at {tau}: {closed}")
    opened = ours(program, raw, size, tau, "--repeats", "1", "--check", "--open")
    edges = flying_edges(image, tau)
    edges.Update()
    points = edges.GetOutput().GetNumberOfPoints()
    if points != edges_crossed or opened["points"] < edges_crossed:
        sys.exit(f"points at {tau}: Flying Edges {points}, isoatlas {opened['points']}, crossed edges {edges_crossed}")
    return opened["check"]["components"], vtk_components(edges.GetOutput()), edges.GetOutput().GetNumberOfPolys()


def compare(program, raw, size, tau, threads, pairs, image, cells):
    vtk.vtkSMPTools.Initialize(threads)
    our_times, vtk_times = [], []
    for _ in range(pairs):
        result = ours(program, raw, size, tau, "--threads", str(threads), "--repeats", "3")
        our_times.append(min(result["seconds"]))
        best = float("inf")
        for _ in range(3):
            edges = flying_edges(image, tau)
            start = time.perf_counter()
            edges.Update()
            best = min(best, time.perf_counter() - start)
        vtk_times.append(best)
    ratios = [a / b for a, b in zip(our_times, vtk_times)]
    mine, theirs = statistics.median(our_times), statistics.median(vtk_times)
    return {"tau": tau, "threads": threads, "active_cells": cells, "isoatlas_seconds": mine, "vtk_seconds": theirs,
            "isoatlas_ns_per_active_cell": 1e9 * mine / cells, "vtk_ns_per_active_cell": 1e9 * theirs / cells,
            "ratio": statistics.median(ratios), "ratio_low": min(ratios), "ratio_high": max(ratios)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--size", type=int, default=256)
    parser.add_argument("--tau", type=float, nargs="+", default=[0.0, 6.0, 12.0])
    parser.add_argument("--threads", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--pairs", type=int, default=7)
    parser.add_argument("--cache", type=Path, default=Path("build/bench/volumes"))
    parser.add_argument("--json", type=Path)
    arguments = parser.parse_args()

    program, size = os.path.abspath(arguments.program), arguments.size
    raw = arguments.cache / f"cosines-{size}.raw"
    if not raw.exists():
        raw.parent.mkdir(parents=True, exist_ok=True)
        subprocess.run([program, "--make", str(size), str(raw)], check=True)
    samples = np.fromfile(raw, dtype=np.float32)
    image = vtk.vtkImageData()
    image.SetDimensions(size, size, size)
    image.GetPointData().SetScalars(numpy_to_vtk(samples))

    results = []
    for tau in arguments.tau:
        edges_crossed, cells = crossed(samples.reshape(size, size, size) >= np.float32(tau))
        our_components, vtk_count, polygons = check(program, raw, size, tau, image, edges_crossed)
        print(f"tau {tau}: {cells} active cells; components {our_components} (open), VTK {vtk_count}; VTK triangles {polygons}", flush=True)
        for threads in arguments.threads:
            record = compare(program, raw, size, tau, threads, arguments.pairs, image, cells)
            results.append(record)
            print("  {threads} threads: isoatlas {isoatlas_seconds:.3f} s, VTK {vtk_seconds:.3f} s, per active cell "
                  "{isoatlas_ns_per_active_cell:.0f} and {vtk_ns_per_active_cell:.0f} ns, ratio {ratio:.2f} "
                  "({ratio_low:.2f} to {ratio_high:.2f})".format(**record), flush=True)
    if arguments.json:
        arguments.json.write_text(json.dumps({"program": "vtkFlyingEdges3D " + vtk.vtkVersion().GetVTKVersion(), "results": results}, indent=1))


if __name__ == "__main__":
    main()
