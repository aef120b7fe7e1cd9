#!/usr/bin/env python3
"""How long until `isoatlas view http://.../scan.atlas` has what the page shows first, over a line of 20 ms a round trip and 10 MB/s?

    remote_pictures.py ISOATLAS [--volumes smooth-128 ...] [--pairs 3] [--cache FOLDER] [--data FOLDER] [--json FILE]

The server is that of the tests, on this machine, and makes every answer wait; nothing is cached. Medians, from the start of the program:
until it has printed its address; until the data of the page are answered (cards, tree, histogram, axis); until the coarse surface of the
first object is. That of an object which fills much of a large volume takes all bricks on its surface; with levels of detail beside the store
(`isoatlas levels --top 1`, "with levels") it takes the coarse end of these.
"""
import argparse
import json
import os
import re
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
sys.path.insert(0, str(HERE.parent.parent / "tests" / "cli"))
from runs import REAL, add_options, chosen, file_of

VOLUMES = ["smooth-128", "smooth-256", "smooth-512", *REAL[:-1]]  # the viewer does not show labels
ROUND_TRIP, BYTES_A_SECOND = 0.02, 10e6


def store_of(program, name, path, cache):
    store = os.path.join(os.path.abspath(cache), f"{name}.remote.atlas")
    if not os.path.exists(store):
        subprocess.run([program, "build", path, "-o", store, "--quiet"], check=True, stdout=subprocess.DEVNULL)
    return Path(store)


def levels_of(program, store):
    levels = Path(f"{store}.lod")
    if not levels.exists():
        subprocess.run([program, "levels", store, "--top", "1", "--quiet"], check=True, stdout=subprocess.DEVNULL)
    return levels


def run(files):
    """Seconds until address, page and surface; requests, round trips, bytes. files: the store, and others that lie beside it."""
    from file_server import FileServer
    from served import Viewer
    store = files[0]
    with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory(dir=store.parent) as served, \
            FileServer(served, round_trip=ROUND_TRIP, bytes_a_second=BYTES_A_SECOND) as server:
        for file in files:
            os.link(file, Path(served) / file.name)
        begin = time.perf_counter()
        viewer = Viewer(folder, f"{server.address}/{store.name}", "--cache", "0", "-v", env={**os.environ, "XDG_CACHE_HOME": folder})
        times = [time.perf_counter() - begin]
        page = json.loads(viewer.ask("/api/atlas")[2])
        times.append(time.perf_counter() - begin)
        first = next(entry for entry in page["entries"] if not entry["background"])
        status, _, _ = viewer.ask(f"/api/surface?tau={first['tau']}&object=v{first['id']}&max=20000")
        times.append(time.perf_counter() - begin)
        _, said = viewer.stop()
        if status != 200:
            sys.exit(f"{store}: the surface is answered with {status}\n{said}")
        return times, [*map(int, re.search(r"(\d+) requests in (\d+) round trips", said).groups()), server.bytes]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_options(parser, VOLUMES, pairs=3)
    arguments = parser.parse_args()
    names = chosen(arguments, VOLUMES)
    os.environ["ISOATLAS_CLI"] = arguments.program
    records = []
    for name in names:
        store = store_of(arguments.program, name, file_of(name, arguments.program, arguments), arguments.cache)
        levels = levels_of(arguments.program, store)
        runs = [run([store]) for _ in range(arguments.pairs)]
        with_levels = [run([store, levels]) for _ in range(arguments.pairs)]
        address, page, surface = (statistics.median(times[i] for times, _ in runs) for i in range(3))
        requests, round_trips, taken = (statistics.median(numbers[i] for _, numbers in runs) for i in range(3))
        records.append({"volume": name, "store MB": store.stat().st_size / 1e6, "address, s": address, "page, s": page,
                        "first surface, s": surface, "requests": requests, "round trips": round_trips, "MB": taken / 1e6,
                        "with levels, s": statistics.median(times[2] for times, _ in with_levels),
                        "with levels, MB": statistics.median(numbers[2] for _, numbers in with_levels) / 1e6,
                        "levels MB": levels.stat().st_size / 1e6})
        print("{volume}: page {page, s:.2f} s, first surface {first surface, s:.2f} s ({with levels, s:.2f} with levels), {round trips} round trips, {MB:.1f} MB".format(
            **records[-1]), flush=True)
        if arguments.json:
            Path(arguments.json).write_text(json.dumps({"remote": records}, indent=1))


if __name__ == "__main__":
    main()
