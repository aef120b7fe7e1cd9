#!/usr/bin/env python3
"""The Python package beside the C++ program: surfaces of arrays, from file to file, and what opening, importing, dropping and Ctrl-C cost.

    package.py BENCH_EXTRACT [--volumes smooth-256 ...] [--pairs 5] [--memmap smooth-512] [--loops 10000] [--interrupts 20]
               [--cache FOLDER] [--data FOLDER] [--json FILE]

A surface of the same samples in memory, at the same isovalue, without ids, by bench_extract and by Atlas.surface(), in turns, medians. The package is
that of the folder beside the program's (BUILD/python). Answers first: the same numbers of points and triangles; of files the same bytes.
"""
import argparse
import json
import os
import statistics
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from facts import environment, facts, in_python
from field import Field
from runs import FIELDS, REAL, add_options, chosen, file_of, ours, sources

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

FILE_TO_FILE = """
import sys, isoatlas
isoatlas.open(sys.argv[1]).surface(float(sys.argv[2])).save(sys.argv[3])
"""


def processor_seconds(command, **options):
    """Of one run of a command, user and system."""
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL, **options)
    _, status, used = os.wait4(child.pid, 0)
    if status != 0:
        sys.exit(f"{command}: {status}")
    return used.ru_utime + used.ru_stime


def file_to_file(arguments, volume, tau):
    """`isoatlas extract` and a script of three lines, in turns: the same bytes."""
    program = Path(arguments.program).parent / "isoatlas"
    source, cache = file_of(volume, program, arguments), Path(arguments.cache)
    outputs = [cache / "extract.ply", cache / "script.ply"]
    extract, script = [], []
    for _ in range(arguments.pairs):
        extract.append(processor_seconds([program, "extract", source, "--tau", repr(tau), "-o", outputs[0], "--quiet"]))
        script.append(processor_seconds([sys.executable, "-B", "-c", FILE_TO_FILE, source, repr(tau), outputs[1]], env=environment(arguments)))
        if outputs[0].read_bytes() != outputs[1].read_bytes():
            sys.exit(f"{volume} at {tau}: the files of extract and of the script differ")
        for output in outputs:
            output.unlink()
    return statistics.median(extract), statistics.median(script)


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
    extract, script = file_to_file(arguments, volume, tau)
    return {"volume": volume, "tau": round(tau, 5), "triangles": native["triangles"], "C++, s": statistics.median(theirs),
            "Python, s": statistics.median(own), "Python / C++": statistics.median(a / b for a, b in zip(own, theirs)),
            "isoatlas extract, s of a processor": extract, "script, s of a processor": script}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_options(parser, VOLUMES, pairs=5)
    parser.add_argument("--memmap", default="smooth-512", help="the volume that is larger than its memory")
    parser.add_argument("--loops", type=int, default=10000)
    parser.add_argument("--interrupts", type=int, default=20, help="of each kind of call")
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
