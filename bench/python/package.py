#!/usr/bin/env python3
"""The Python package beside the C++ program: surfaces of arrays, and what opening, importing and dropping cost.

    package.py BENCH_EXTRACT [--volumes smooth-256 ...] [--pairs 5] [--memmap smooth-512] [--loops 10000] [--cache FOLDER] [--data FOLDER]
               [--json FILE]

A surface of the same samples in memory, at the same isovalue, without ids, by bench_extract and by Atlas.surface(), in turns, medians. The package is
that of the folder beside the program's (BUILD/python). Answers first: the same numbers of points and triangles.
"""
import argparse
import json
import os
import statistics
import subprocess
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from field import Field
from runs import FIELDS, REAL, add_options, chosen, ours, sources

VOLUMES = [*FIELDS, *REAL]

SURFACE = """
import json, sys, time
import numpy, isoatlas
path, shape, dtype, tau, repeats = sys.argv[1], json.loads(sys.argv[2]), sys.argv[3], float(sys.argv[4]), int(sys.argv[5])
atlas = isoatlas.open(numpy.fromfile(path, dtype).reshape(shape))
seconds = []
for _ in range(repeats):
    start = time.perf_counter()
    mesh = atlas.surface(tau, ids=False)
    seconds.append(time.perf_counter() - start)
    points, triangles = len(mesh.points), len(mesh.triangles)
    del mesh
print(json.dumps({"seconds": seconds, "points": points, "triangles": triangles}))
"""

MEMMAP = """
import json, resource, sys, time
import numpy, isoatlas
array = numpy.memmap(sys.argv[1], sys.argv[3], "r", shape=tuple(json.loads(sys.argv[2])))
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
start = time.perf_counter()
with isoatlas.open(array, memory="1G") as atlas:
    objects = len(atlas.objects)
    triangles = len(atlas.objects[0].surface().triangles)
peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
print(json.dumps({"seconds": time.perf_counter() - start, "before": 1024 * before, "peak": 1024 * peak, "objects": objects,
                  "triangles": triangles}))
"""

LOOPS = """
import json, sys
import numpy, isoatlas
def resident():
    return 1024 * int(next(line for line in open("/proc/self/status") if line.startswith("VmRSS")).split()[1])
def once(array):
    atlas = isoatlas.open(array)
    return len(atlas.objects[0].surface().triangles)
array = isoatlas.phantom("demo", 32)
count = int(sys.argv[1])
for _ in range(count // 10):
    once(array)
early = resident()
for _ in range(count - count // 10):
    once(array)
print(json.dumps({"loops": count, "early": early, "late": resident()}))
"""

IMPORT = """
import json, sys, time
import numpy
start = time.perf_counter()
import isoatlas
imported = time.perf_counter() - start
seconds = []
for _ in range(20):
    start = time.perf_counter()
    isoatlas.open(sys.argv[1])
    seconds.append(time.perf_counter() - start)
print(json.dumps({"import": imported, "open": seconds}))
"""


def in_python(arguments, script, *words):
    environment = dict(os.environ, PYTHONPATH=str(Path(arguments.program).parent.parent / "python"))
    done = subprocess.run([sys.executable, "-B", "-c", script, *map(str, words)], capture_output=True, text=True, env=environment)
    if done.returncode != 0:
        sys.exit(done.stderr)
    return json.loads(done.stdout)


def surface_record(arguments, volume):
    program = arguments.program
    made = ours(program, volume, *sources(arguments))
    path = Path(arguments.cache) / f"{volume}.raw"
    field = Field(path, made["size"], made["type"])
    tau = field.isovalue_of(0.02)
    own, theirs = [], []
    for _ in range(arguments.pairs):
        native = ours(program, volume, tau, *sources(arguments), "--repeats", 5)
        python = in_python(arguments, SURFACE, path, made["size"][::-1], made["type"], tau, 5)
        if (native["points"], native["triangles"]) != (python["points"], python["triangles"]):
            sys.exit(f"{volume} at {tau}: {native['points']} points and {native['triangles']} triangles, in Python {python}")
        theirs.append(min(native["seconds"]))
        own.append(min(python["seconds"]))
    return {"volume": volume, "tau": round(tau, 5), "triangles": native["triangles"], "C++, s": statistics.median(theirs),
            "Python, s": statistics.median(own), "Python / C++": statistics.median(a / b for a, b in zip(own, theirs))}


def facts(arguments):
    program, cache = arguments.program, Path(arguments.cache)
    made = ours(program, arguments.memmap, *sources(arguments))
    raw, shape = cache / f"{arguments.memmap}.raw", made["size"][::-1]
    memmap = in_python(arguments, MEMMAP, raw, shape, made["type"])
    store = cache / "python.atlas"
    in_python(arguments, "import json, sys, isoatlas\nprint(json.dumps(isoatlas.build(isoatlas.phantom('demo', 64), sys.argv[1]) and 1))", store)
    start = in_python(arguments, IMPORT, store)
    store.unlink()
    loops = in_python(arguments, LOOPS, arguments.loops)
    return [{"what": f"{arguments.memmap}, a memmap with memory=\"1G\": objects and a surface", "measured":
             f"peak {memmap['peak'] / 2**20:.0f} MiB, {memmap['seconds']:.1f} s", "goal": "1.1 GB"},
            {"what": "opening a store", "measured": f"{1e3 * statistics.median(start['open']):.2f} ms", "goal": "10 ms"},
            {"what": "import isoatlas, beyond numpy", "measured": f"{1e3 * start['import']:.0f} ms", "goal": "100 ms"},
            {"what": f"{loops['loops']:,} times: open an array, objects, a surface, drop all", "measured":
             f"{(loops['late'] - loops['early']) / 2**20:+.1f} MiB after the first tenth", "goal": "no growth"}]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_options(parser, VOLUMES, pairs=5)
    parser.add_argument("--memmap", default="smooth-512", help="the volume that is larger than its memory")
    parser.add_argument("--loops", type=int, default=10000)
    arguments = parser.parse_args()
    document = {"pairs": arguments.pairs, "surfaces": [], "facts": []}
    for volume in chosen(arguments, VOLUMES):
        document["surfaces"].append(surface_record(arguments, volume))
        print(document["surfaces"][-1], flush=True)
    document["facts"] = facts(arguments)
    print(document["facts"])
    if arguments.json:
        Path(arguments.json).write_text(json.dumps(document, indent=1))


if __name__ == "__main__":
    main()
