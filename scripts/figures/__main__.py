"""The figures of the dissertation's survey of surface methods (chapter 3), from phantoms and cells made by hand.

    python3 scripts/figures ISOATLAS FOLDER     writes them all, with the program ISOATLAS: docs/methods.md shows them
    python3 scripts/figures --list              their names
    python3 scripts/figures --drawings ISOATLAS FOLDER    only the drawings (.svg), whose bytes are the same everywhere

Needs python3-numpy and python3-pil.
"""
import functools
import os
import pathlib
import subprocess
import sys
import tempfile

import grids
import intervals
import pictures
import span_space
import tetrahedra

PICTURES = {
    "connected-contours.webp": pictures.connected_contours,
    "figure-3-1.webp": pictures.marching_cubes_patterns,
    "figure-3-2.webp": pictures.marching_cubes_hole,
    "figure-3-3.webp": pictures.face_links,
    "dividing-cubes.webp": pictures.dividing_cubes,
    "spider-web.webp": pictures.spider_web,
    "mirrored-tetrahedra.webp": pictures.mirrored_tetrahedra,
    "figure-3-10.webp": pictures.level_sets,
}
DRAWINGS = {
    "figure-3-4.svg": tetrahedra.tetrahedra,
    "octree.svg": grids.octrees,
    "extrema-graph.svg": grids.extrema_graph,
    "figure-3-5.svg": span_space.span_filter,
    "figure-3-6.svg": span_space.active_list,
    "figure-3-7.svg": span_space.kd_tree,
    "figure-3-8.svg": intervals.interval_tree,
    "chessboard.svg": grids.chessboard,
    "figure-3-9.svg": intervals.file_tree,
    "figure-3-11.svg": grids.criticality_tree,
}


def run(program, *arguments):
    done = subprocess.run([program, *map(str, arguments), "--quiet"], capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"figures: {' '.join(map(str, arguments))}: {done.stderr.strip()}")


def main(arguments):
    if arguments == ["--list"]:
        print("\n".join([*PICTURES, *DRAWINGS]))
        return
    only_drawings = arguments[:1] == ["--drawings"]
    if len(arguments) != 2 + only_drawings:
        raise SystemExit(__doc__)
    program, folder = map(pathlib.Path.resolve, map(pathlib.Path, arguments[only_drawings:]))
    folder.mkdir(parents=True, exist_ok=True)
    isoatlas = functools.partial(run, program)
    with tempfile.TemporaryDirectory(prefix="isoatlas-figures-") as work:
        os.chdir(work)
        for name, draw in DRAWINGS.items():
            (folder / name).write_text(str(draw(isoatlas)))
        for name, make in ({} if only_drawings else PICTURES).items():
            make(isoatlas, folder / name)
        os.chdir(folder)
    print(f"{folder}: {len(DRAWINGS) + (0 if only_drawings else len(PICTURES))} figures")


main(sys.argv[1:])
