#!/usr/bin/env python3
"""A store beside VTK: surfaces from the store against Flying Edges over the volume in memory (warm) and against reading the volume file and
contouring it (cold); one small object; opening; building. Answers first, then medians of runs in turns.

    compare_vtk.py BENCH_STORE [--volumes smooth-512 noisy-256 white-256] [--active 0.002 0.02 0.1 0.5] [--threads 2] [--pairs 5]
                   [--cache FOLDER] [--data FOLDER] [--json FILE]

A quick look: --volumes smooth-64 white-64 --pairs 2. Cold files: their pages are dropped before every run; "cold disk" says what then
really came from the disk, 0 where the system does not drop pages. Needs python3-vtk9 and numpy (Debian packages; the system's python3).
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

TYPES = {"uint8": np.uint8, "int16": np.int16, "uint16": np.uint16, "float32": np.float32}
REAL = ["bonsai", "engine", "pet", "seg3d_mr", "emd3001", "frog_labels"]  # CT twice, PET, MR, electron microscopy, labels


def ours(program, *arguments):
    done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stderr)
    return json.loads(done.stdout)


def drop_pages(path):
    with open(path, "rb") as file:
        os.fsync(file.fileno())
        os.posix_fadvise(file.fileno(), 0, 0, os.POSIX_FADV_DONTNEED)


class Field:
    """A volume as VTK and numpy see it, and how many of its cells are active at an isovalue."""

    def __init__(self, path, built):
        self.path, self.size, self.type = path, built["size"], TYPES[built["type"]]
        self.samples = np.fromfile(path, dtype=self.type).reshape(self.size[::-1])
        self.low = self.high = self.samples
        for axis in range(3):
            first, second = [slice(None)] * 3, [slice(None)] * 3
            first[axis], second[axis] = slice(None, -1), slice(1, None)
            self.low = np.minimum(self.low[tuple(first)], self.low[tuple(second)])
            self.high = np.maximum(self.high[tuple(first)], self.high[tuple(second)])

    def image(self):
        return self.image_of(self.samples)

    def image_of(self, samples):
        image = vtk.vtkImageData()
        image.SetDimensions(*self.size)
        image.GetPointData().SetScalars(numpy_to_vtk(samples.reshape(-1)))
        return image

    def read(self):
        return self.image_of(np.fromfile(self.path, dtype=self.type))

    def active_cells(self, tau):
        return int(np.count_nonzero((self.low < tau) & (self.high >= tau)))

    def isovalue_of(self, fraction):
        """The isovalue above the median at which this fraction of the cells is active; where it is never that many, the median."""
        middle, top = float(np.median(self.samples[::4, ::4, ::4])), float(self.samples.max())
        step = (lambda tau: np.floor(tau) + 0.5) if np.issubdtype(self.type, np.integer) else (lambda tau: float(np.float32(tau)))
        if self.active_cells(step(middle)) < fraction * self.low.size:
            return step(middle)
        for _ in range(24):
            tau = step((middle + top) / 2)
            middle, top = (tau, top) if self.active_cells(tau) >= fraction * self.low.size else (middle, tau)
        return step(middle)


def seconds_of_contouring(image, tau):
    edges = flying_edges(image, tau)
    start = time.perf_counter()
    edges.Update()
    return time.perf_counter() - start


def seconds_of_reading_and_contouring(field, tau):
    drop_pages(field.path)
    start = time.perf_counter()
    flying_edges(field.read(), tau).Update()
    return time.perf_counter() - start


def check(program, store, tau, volume, field, image, sources):
    if not ours(program, "check", store, tau, volume, *sources)["same_as_the_volume"]:
        sys.exit(f"{volume} at {tau}: the surface of the store is not that of the volume")
    edges = flying_edges(image, tau)
    edges.Update()
    points, (edges_crossed, cells) = edges.GetOutput().GetNumberOfPoints(), crossed(field.samples >= tau)
    if points != edges_crossed or cells != field.active_cells(tau):
        sys.exit(f"{volume} at {tau}: Flying Edges has {points} points, {edges_crossed} edges are crossed; {cells} cells are active")


def ratio(ours_, theirs):
    """Theirs in ours: how many times faster the store is."""
    return statistics.median(b / a for a, b in zip(ours_, theirs))


def steps_ratio(program, store, tau, arguments):
    result = ours(program, "steps", store, tau, "--threads", arguments.threads, "--repeats", 9)
    return ratio(result["step"], result["fresh"])


def surface_record(program, store, volume, field, image, tau, arguments):
    active = field.active_cells(tau)
    own = {"warm": [], "again": [], "cold": []}
    vtk_warm, vtk_cold = [], []
    for _ in range(arguments.pairs):
        result = ours(program, "surface", store, tau, "--threads", arguments.threads, "--repeats", 3)
        for name, times in own.items():
            times.append(min(result[name]))
        vtk_warm.append(min(seconds_of_contouring(image, tau) for _ in range(3)))
        vtk_cold.append(min(seconds_of_reading_and_contouring(field, tau) for _ in range(2)))
    return {"volume": volume, "tau": round(tau, 5), "active cells": active, "active, %": 100 * active / field.low.size,
            "warm, s": statistics.median(own["warm"]), "VTK in memory, s": statistics.median(vtk_warm),
            "times faster": ratio(own["warm"], vtk_warm), "again, times faster": ratio(own["again"], vtk_warm),
            "cold, s": statistics.median(own["cold"]), "VTK from the file, s": statistics.median(vtk_cold),
            "cold, times faster": ratio(own["cold"], vtk_cold), "cold disk MB": result["cold_disk_bytes"] / 1e6,
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
    program, cache = os.path.abspath(arguments.program), arguments.cache
    store = cache / f"{volume}.atlas"
    sources = ["--cache", cache] + (["--data", arguments.data] if arguments.data else [])
    built = ours(program, "build", volume, store, *sources, "--threads", arguments.threads)
    document["builds"].append({"volume": volume, "size": "x".join(map(str, built["size"])), "type": built["type"],
                               "build, s": built["seconds"], "ns a voxel": built["ns_per_voxel"], "bytes a voxel": built["bytes_per_voxel"],
                               "bytes of a sample": built["sample_bytes"]})
    print(document["builds"][-1], flush=True)
    field = Field(cache / f"{volume}.raw", built)
    image = field.image()
    isovalues = sorted({field.isovalue_of(fraction) for fraction in arguments.active}, reverse=True)
    for tau in isovalues:
        check(program, store, tau, volume, field, image, sources)
        document["surfaces"].append(surface_record(program, store, volume, field, image, tau, arguments))
        print(document["surfaces"][-1], flush=True)
    document["objects"].append(object_record(program, store, volume, isovalues[0], arguments))
    print(document["objects"][-1], flush=True)
    store.unlink()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--volumes", nargs="+", help="default: fields, and real ones where --data is given")
    parser.add_argument("--data", type=Path, help="folder with NAME/NAME.nrrd")
    parser.add_argument("--active", type=float, nargs="+", default=[0.002, 0.02, 0.1, 0.5], help="fractions of active cells")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--pairs", type=int, default=5)
    parser.add_argument("--cache", type=Path, default=Path("build/bench/volumes"))
    parser.add_argument("--json", type=Path)
    arguments = parser.parse_args()
    arguments.cache.mkdir(parents=True, exist_ok=True)
    vtk.vtkSMPTools.Initialize(arguments.threads)
    document = {"threads": arguments.threads, "pairs": arguments.pairs, "builds": [], "surfaces": [], "objects": []}
    for volume in arguments.volumes or ["smooth-512", "noisy-256", "white-256"] + (REAL if arguments.data else []):
        measure(volume, arguments, document)
    if arguments.json:
        arguments.json.write_text(json.dumps(document, indent=1))


if __name__ == "__main__":
    main()
