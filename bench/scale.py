#!/usr/bin/env python3
"""How do time and memory grow with the volume? 64^3 to 512^3 voxels of the smooth and the noisy field, on one thread, two and all
processors.

    scale.py FOLDER_OF_PROGRAMS [--sections analysis extract stores render pages] [--sizes 64 128 256 512] [--cache FOLDER] [--out FOLDER]

A quick look: --sizes 32 64. Writes OUT/scale-SECTION.json: seconds by what is done and threads (medians), bytes by what they are, for every
volume. bench/report.py makes the tables, with the slope of log(time) against log(voxels) by least squares. 512^3 of the noisy field is
measured in an analysis and a surface alone: its store takes minutes. Surfaces and first queries are at 2 % of active cells.
"""
import argparse
import json
import os
import statistics
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from runs import file_of, ours, sources, thread_counts

ACTIVE = 0.02
NOISY_AT_MOST = {"stores": 256, "render": 256, "pages": 256}
ONCE = 512  # from this size on one run each


class Volume:
    """What of, how large, and how often it is measured."""

    def __init__(self, field, size, arguments):
        self.name, self.field, self.size, self.arguments = f"{field}-{size}", field, size, arguments
        self.voxels, self.repeats = size**3, 1 if size >= ONCE else 3
        self.sources = sources(arguments)

    def program(self, name):
        return os.path.join(self.arguments.programs, name)

    def record(self, seconds, bytes_, more=None):
        return {"field": self.field, "size": self.size, "voxels": self.voxels, "seconds": seconds, "bytes": bytes_, "more": more or {}}

    def isovalue(self):
        """With which ACTIVE of the cells are active; found in a process of its own: children begin with the memory of this one."""
        known = ours(self.program("bench_extract"), self.name, *self.sources)
        raw, script = Path(self.arguments.cache) / f"{self.name}.raw", Path(__file__).resolve().parent / "field.py"
        return ours(sys.executable, script, raw, *known["size"], known["type"], ACTIVE)


def analysis(volume, threads):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "engine.json")
        command = [volume.program("bench_engine"), volume.name, *volume.sources, "--no-sort", "--pairs", volume.repeats, "--json", path]
        if os.spawnv(os.P_WAIT, command[0], list(map(str, command))) != 0:
            sys.exit(f"scale: {' '.join(map(str, command))} failed")
        found = json.loads(Path(path).read_text())["volumes"][0]
    elements = found["critical_elements"]
    return volume.record({"": {n: found["seconds_by_threads"][str(n)] for n in threads}}, {"peak": found["peak_bytes"]},
                         {"critical elements": elements, "ns an element": 1e9 * found["seconds"] / elements,
                          "peak / allowed": found["peak_over_allowed"]})


def extract(volume, threads):
    tau, seconds = volume.isovalue(), {}
    for n in threads:
        found = ours(volume.program("bench_extract"), volume.name, tau, *volume.sources, "--threads", n, "--repeats", 1 + volume.repeats)
        seconds[n] = statistics.median(found["seconds"])
    return volume.record({"": seconds}, {"peak": found["peak_bytes"]}, {"triangles": found["triangles"]})


def stores(volume, threads):
    tau, build, query = volume.isovalue(), {}, {}
    with tempfile.TemporaryDirectory(dir=volume.arguments.cache) as folder:
        store = os.path.join(folder, "scale.atlas")
        for n in threads:
            built = ours(volume.program("bench_store"), "build", volume.name, store, *volume.sources, "--threads", n,
                         "--repeats", volume.repeats)
            build[n] = statistics.median(built["seconds"])
            found = ours(volume.program("bench_store"), "surface", store, tau, "--threads", n, "--repeats", 3)
            query[n] = statistics.median(found["open"]) + statistics.median(found["warm"])
    return volume.record({"build": build, "first query": query}, {"file": built["bytes"], "peak of the build": built["peak_bytes"]},
                         {"bytes read by the query, %": 100 * found["bytes"] / built["bytes"]})


def render(volume, threads):
    def draw(*options):
        return ours(volume.program("bench_render"), volume.name, *volume.sources, *options)

    first, seconds = Path(volume.arguments.cache) / "render.json", {}
    first.write_text(json.dumps(draw("--repeats", 1)))
    for n in threads:
        found = draw("--threads", n, "--repeats", 3, "--like", first)
        seconds[n] = statistics.median(map(sum, zip(found["seconds"]["prepare"], found["seconds"]["draw"])))
    first.unlink()
    return volume.record({"": seconds}, {"peak": found["peak_bytes"]})


def pages(volume, threads):
    sys.path.insert(0, str(Path(__file__).resolve().parent / "page"))
    from first_pictures import run
    isoatlas = os.path.abspath(volume.program("isoatlas"))
    path, first, whole = file_of(volume.name, isoatlas, volume.arguments), {}, {}
    for n in threads:
        with tempfile.TemporaryDirectory() as folder:
            seconds, early, _, peak = run([isoatlas, path, "-o", "page.html", "--threads", str(n)], folder)
            size = os.path.getsize(os.path.join(folder, "page.html"))
        first[n], whole[n] = early or seconds, seconds
    return volume.record({"five pictures": first, "all": whole}, {"peak": peak, "page": size})


SECTIONS = {"analysis": analysis, "extract": extract, "stores": stores, "render": render, "pages": pages}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs")
    parser.add_argument("--sections", nargs="+", choices=SECTIONS, default=list(SECTIONS))
    parser.add_argument("--sizes", type=int, nargs="+", default=[64, 128, 256, 512])
    parser.add_argument("--cache", default="build/bench/volumes")
    parser.add_argument("--out", default="build/bench")
    arguments = parser.parse_args()
    arguments.data = None
    os.makedirs(arguments.cache, exist_ok=True)
    threads = thread_counts()
    for section in arguments.sections:
        records = []
        for field in ("smooth", "noisy"):
            for size in arguments.sizes:
                if field == "noisy" and size > NOISY_AT_MOST.get(section, size):
                    continue
                records.append(SECTIONS[section](Volume(field, size, arguments), threads))
                print(section, records[-1], flush=True)
        Path(arguments.out, f"scale-{section}.json").write_text(json.dumps({"threads": threads, "records": records}, indent=1))


if __name__ == "__main__":
    main()
