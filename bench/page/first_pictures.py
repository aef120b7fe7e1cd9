#!/usr/bin/env python3
"""When has a page its first five pictures, when all? From the volume file alone: store and page are made.

    first_pictures.py ISOATLAS [--volumes bonsai ...] [--pairs 2] [--cache FOLDER] [--data FOLDER] [--json FILE]

The yardstick is the store of the same volume, built in turns: a page is a store and its pictures. Medians, of one pair where that takes a
minute. Answers first: every card has a picture, and a surface to turn or a page that is full.
"""
import argparse
import json
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from runs import FIELDS, REAL, add_options, chosen, file_of

VOLUMES = [*FIELDS[:-1], "white-128", *REAL, "tooth"]  # a page of white noise of 256^3 takes minutes and 12 GB
ENOUGH = 60  # seconds of a volume: no further pair after that


def run(command, folder):
    """Seconds, those until the note about the first pictures (None: it came at the end), processor seconds, bytes resident at most."""
    start = time.perf_counter()
    process = subprocess.Popen(command, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    first = None
    words = []
    for line in process.stderr:
        words.append(line)
        if "has its first" in line:
            first = first or time.perf_counter() - start
    _, status, used = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit("".join(words))
    return time.perf_counter() - start, first, used.ru_utime + used.ru_stime, used.ru_maxrss * 1024


def pictures_of(page):
    data = json.loads(re.search(r'id="atlas-data" type="application/json">(.*?)</script>', page.read_text(), re.S)[1])
    cards = data["labels"] if "labels" in data else data["entries"]
    if not data["complete"] or any(card["picture"] is None for card in cards):
        sys.exit(f"{page}: pictures are missing")
    return len(cards), sum(card["mesh"] is not None for card in cards)


def measure(program, volume, path, pairs):
    stores, pages = [], []
    begin = time.perf_counter()
    while len(pages) < pairs and (not pages or time.perf_counter() - begin < ENOUGH):
        folder = Path(tempfile.mkdtemp(prefix="isoatlas-bench-"))
        try:
            stores.append(run([program, "build", path, "-o", "alone.atlas", "--quiet"], folder)[0])
            pages.append(run([program, path, "-o", "page.html"], folder))
            pictures, solids = pictures_of(folder / "page.html")
            size = (folder / "page.html").stat().st_size
        finally:
            shutil.rmtree(folder)
    store, all_seconds = statistics.median(stores), statistics.median(page[0] for page in pages)
    first = statistics.median(page[1] or page[0] for page in pages)
    return {"volume": volume, "pictures": pictures, "that turn": solids, "store, s": store, "five pictures, s": first,
            "all, s": all_seconds, "processor seconds": statistics.median(page[2] for page in pages), "all, in stores": all_seconds / store,
            "peak MB": statistics.median(page[3] for page in pages) / 1e6, "page MB": size / 1e6}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_options(parser, VOLUMES, pairs=2)
    arguments = parser.parse_args()
    records = []
    for volume in chosen(arguments, VOLUMES):
        records.append(measure(arguments.program, volume, file_of(volume, arguments.program, arguments), arguments.pairs))
        print("{volume}: {pictures} pictures; store {store, s:.2f} s, first five {five pictures, s:.2f} s, all {all, s:.2f} s".format(
            **records[-1]), flush=True)
        if arguments.json:  # now: what is measured stays when a later volume fails
            Path(arguments.json).write_text(json.dumps({"pages": records}, indent=1))


if __name__ == "__main__":
    main()
