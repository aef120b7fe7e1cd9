#!/usr/bin/env python3
"""Renders the three experiments of the dissertation's table 13.1 beside its own numbers in docs/performance.md.

    table131.py ISOATLAS DATA [PAGE]   ISOATLAS: the command; DATA: the folder of the shared volumes; PAGE defaults to docs/performance.md
"""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

from report import replace, table

# Table 13.1: max, average, min.
DISSERTATION = [
    {"zones": 27, "zone_points": (2659, 957, 23), "active_cells": (3148, 1978, 64), "cells_visited": (4563, 2410, 72),
     "cells_loaded": (4563, 2923, 624), "load_utility": (100, 64.7, 10.3), "travel_utility": (100, 86.4, 64.3),
     "loaded_percent": (66.5, 42.6, 9.1), "active_percent": (45.9, 28.8, 0.93)},
    {"zones": 1345, "zone_points": (2187, 1217, 1), "active_cells": (3351, 1143, 8), "cells_visited": (3356, 1149, 9),
     "cells_loaded": (4392, 1459, 26), "load_utility": (100, 71.6, 30.8), "travel_utility": (100, 97.4, 88.9),
     "loaded_percent": (64, 21.3, 0.4), "active_percent": (48.7, 16.7, 0.1)},
    {"zones": 167, "zone_points": (2605, 1116, 1), "active_cells": (2477, 800, 8), "cells_visited": (2733, 843, 9),
     "cells_loaded": (2985, 1063, 46), "load_utility": (100, 58.7, 17.0), "travel_utility": (100, 95.6, 80.1),
     "loaded_percent": (43.5, 15.5, 0.7), "active_percent": (36.1, 11.7, 0.1)},
]
ROWS = [("points in a zone", "zone_points"), ("active cells", "active_cells"), ("cells visited", "cells_visited"),
        ("cells loaded", "cells_loaded"), ("load utility, %", "load_utility"), ("travel utility, %", "travel_utility"),
        ("cells loaded, % of all", "loaded_percent"), ("active cells, % of all", "active_percent")]
OF_WAYS = {"cells_visited", "cells_loaded", "load_utility", "travel_utility", "loaded_percent"}


def experiments(isoatlas, data, folder):
    """The documents of `isoatlas table131` for the three experiments."""
    figure = folder / "figure.nrrd"
    subprocess.run([isoatlas, "phantom", "figure-plateau", "-o", figure, "--quiet"], check=True, stdout=subprocess.DEVNULL)
    lung = [data / "lung_ct" / "lung_hi.nrrd", "--box", "20:40,60:80,60:80"]
    runs = [[figure, "--box", "2:22,2:22,2:22"], lung, [*lung, "--gaussian", "2.5"]]
    for words in runs:
        done = subprocess.run([isoatlas, "table131", *words, "--json", "--quiet"], check=True, stdout=subprocess.PIPE, text=True)
        yield json.loads(done.stdout)


def numbers(spread, key):
    """max / average / min."""
    values = [spread["max"], spread["average"], spread["min"]] if isinstance(spread, dict) else spread
    digits = 1 if key.endswith(("utility", "percent")) else 0
    return " / ".join(f"{value:.{digits}f}" for value in values)


def rows_of(documents):
    yield ["zones"] + [text for paper, ours in zip(DISSERTATION, documents) for text in (paper["zones"], ours["zones"], "")]
    for title, key in ROWS:
        cells = [title]
        for paper, ours in zip(DISSERTATION, documents):
            files, bricks = (ours["zone_files"], ours["bricks"]) if key in OF_WAYS else (ours, None)
            cells += [numbers(paper[key], key), numbers(files[key], key), numbers(bricks[key], key) if bricks else ""]
        yield cells


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    isoatlas, data = Path(sys.argv[1]).resolve(), Path(sys.argv[2])
    page = Path(sys.argv[3] if len(sys.argv) == 4 else "docs/performance.md")
    with tempfile.TemporaryDirectory() as folder:
        documents = list(experiments(isoatlas, data, Path(folder)))
    header = ["max / average / min"]
    for name in ("1 simulated", "2 unfiltered", "3 filtered"):
        header += [f"{name}: table 13.1", "zone files", "bricks"]
    page.write_text(replace(page.read_text(), "table131", table(header, rows_of(documents))))
    print(f"table131: {page} is up to date")


if __name__ == "__main__":
    main()
