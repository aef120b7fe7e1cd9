#!/usr/bin/env python3
"""Surfaces of the methods of the literature beside those of VTK and scikit-image, of the same samples: what they make, then how long it takes.

    surfaces.py ISOATLAS [--volumes smooth-64 ...] [--active 0.05 0.5] [--methods surfaces] [--data FOLDER] [--cache FOLDER] [--json FILE]

ISOATLAS: the command. Isovalues lie between samples; surfaces are open where they leave the volume. The time of one run, on one thread for
the methods of the literature and for scikit-image; of VTK and the product on all. Where the product has a hole or an edge with more than two
triangles, or the asymptotic decider a hole, nothing is printed but that. Needs python3-vtk9, python3-skimage and numpy (Debian packages; run
with the system's python3).
"""
import argparse
import json
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import skimage
import vtk
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from skimage.measure import marching_cubes
from vtk.util.numpy_support import vtk_to_numpy

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from field import Field
from runs import file_of, is_field

VOLUMES = ["smooth-64", "noisy-64", "white-64", "fuel", "neghip", "headsq", "emd3001", "bonsai"]
COLUMNS = [("method", "<32"), ("triangles", ">10"), ("components", ">11"), ("euler", ">9"), ("hole_edges", ">11"),
           ("non_manifold_edges", ">19"), ("seconds", ">9")]


def measures(points, triangles, size):
    """Of points in voxel coordinates: components, Euler number, edges of holes, edges with more than two triangles."""
    edges = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    edges, count = np.unique(edges, axis=0, return_counts=True)
    used = np.unique(triangles)
    links = coo_matrix((np.ones(len(edges), np.int8), (edges[:, 0], edges[:, 1])), shape=(len(points), len(points)))
    labels = connected_components(links, directed=False)[1]
    rims = edges[count == 1]
    at_end = np.zeros(len(rims), bool)
    for axis in range(3):
        for end in (0, size[axis] - 1):
            at_end |= np.all(np.abs(points[rims, axis] - end) < 1e-5, axis=1)
    return {"triangles": len(triangles), "components": len(np.unique(labels[used])), "euler": len(used) - len(edges) + len(triangles),
            "hole_edges": int(np.count_nonzero(~at_end)), "non_manifold_edges": int(np.count_nonzero(count > 2))}


def of_vtk(contour, image, tau, size):
    contour.SetInputData(image)
    contour.SetValue(0, tau)
    contour.ComputeNormalsOff()
    contour.ComputeGradientsOff()
    contour.ComputeScalarsOff()
    start = time.perf_counter()
    contour.Update()
    seconds = time.perf_counter() - start
    mesh = contour.GetOutput()
    if mesh.GetNumberOfPolys() == 0:
        return measures(np.zeros((0, 3)), np.zeros((0, 3), int), size) | {"seconds": seconds}
    points = vtk_to_numpy(mesh.GetPoints().GetData())
    return measures(points, vtk_to_numpy(mesh.GetPolys().GetData()).reshape(-1, 4)[:, 1:], size) | {"seconds": seconds}


def of_skimage(method, samples, tau, size):
    samples = samples.astype(np.float32)
    start = time.perf_counter()
    points, triangles, _, _ = marching_cubes(samples, tau, method=method, allow_degenerate=True)
    seconds = time.perf_counter() - start
    return measures(points[:, ::-1], triangles, size) | {"seconds": seconds}


def ours(isoatlas, path, tau, methods):
    command = [isoatlas, "compare", path, "--tau", repr(tau), "--methods", methods, "--json", "--quiet"]
    done = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True)
    for surface in json.loads(done.stdout)["surfaces"]:
        row = {"method": surface["title"], **{name: surface[name] for name, _ in COLUMNS[1:]}}
        strict = {"asymptotic-decider": ["hole_edges"], "trilinear": ["hole_edges", "non_manifold_edges"]}
        for column in strict.get(surface["name"], []):
            if row[column] != 0:
                sys.exit(f"{path} at {tau}: {surface['title']} has {row[column]} {column}")
        yield row


def field_of(isoatlas, path, cache, name):
    """The samples as they are stored, and their file without headers."""
    info = json.loads(subprocess.run([isoatlas, "info", path, "--json", "--quiet"], check=True, stdout=subprocess.PIPE, text=True).stdout)
    raw = cache / f"surfaces-{name}.npy"
    subprocess.run([isoatlas, "convert", path, "-o", raw, "--quiet"], check=True, stdout=subprocess.DEVNULL)
    samples = np.load(raw)
    field = cache / f"surfaces-{name}.raw"
    samples.tofile(field)
    raw.unlink()
    return Field(field, info["volume"]["dims"], samples.dtype)


def compare(isoatlas, path, name, field, tau, methods):
    rows = list(ours(isoatlas, path, tau, methods))
    image = field.image()
    rows.append({"method": "VTK, Marching Cubes", **of_vtk(vtk.vtkMarchingCubes(), image, tau, field.size)})
    rows.append({"method": "VTK, Flying Edges", **of_vtk(vtk.vtkFlyingEdges3D(), image, tau, field.size)})
    rows.append({"method": "scikit-image, Lorensen", **of_skimage("lorensen", field.samples, tau, field.size)})
    rows.append({"method": "scikit-image, Lewiner", **of_skimage("lewiner", field.samples, tau, field.size)})
    return {"volume": name, "tau": tau, "active cells": field.active_cells(tau), "rows": rows}


def print_table(found):
    print(f"\n{found['volume']} at {found['tau']:g}, {found['active cells']:,} active cells")
    print(" ".join(f"{column.replace('_', ' '):{form}}" for column, form in COLUMNS))
    for row in found["rows"]:
        cells = [f"{row[column]:.3f}" if column == "seconds" else f"{row[column]}" for column, _ in COLUMNS]
        print(" ".join(f"{cell:{form}}" for cell, (_, form) in zip(cells, COLUMNS)), flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="the command isoatlas")
    parser.add_argument("--volumes", nargs="+", help=f"default: {' '.join(VOLUMES)}; the real ones where --data is given")
    parser.add_argument("--active", type=float, nargs="+", default=[0.05, 0.5], help="fractions of active cells")
    parser.add_argument("--methods", default="surfaces", help="of `isoatlas compare`")
    parser.add_argument("--data", help="folder with NAME/NAME.nrrd")
    parser.add_argument("--cache", default="build/bench/volumes", help="folder for samples")
    parser.add_argument("--json")
    arguments = parser.parse_args()
    cache = Path(arguments.cache)
    cache.mkdir(parents=True, exist_ok=True)
    results = []
    for name in arguments.volumes or [name for name in VOLUMES if arguments.data or is_field(name)]:
        path = file_of(name, arguments.program, arguments)
        field = field_of(arguments.program, path, cache, name)
        for tau in field.isovalues_of(arguments.active):
            results.append(compare(arguments.program, path, name, field, float(tau), arguments.methods))
            print_table(results[-1])
    if arguments.json:
        document = {"programs": {"VTK": vtk.vtkVersion().GetVTKVersion(), "scikit-image": skimage.__version__}, "results": results}
        Path(arguments.json).write_text(json.dumps(document, indent=1))


if __name__ == "__main__":
    main()
