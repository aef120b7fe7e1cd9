"""Figures that isoatlas draws: the pictures of `compare` and `render`, set side by side."""
import itertools

import numpy
from PIL import Image

SIDE = 480  # of a picture of `compare`


def sheet(images, columns, file):
    width, height = images[0].size
    rows = -(-len(images) // columns)
    whole = Image.new("RGB", (columns * width, rows * height), "white")
    for i, image in enumerate(images):
        whole.paste(image, (i % columns * width, i // columns * height))
    whole.save(file, lossless=True, quality=100, method=6)


def compared(run, volume, tau, methods, side, captions=True):
    """The pictures of these methods, in their order, without that of ray casting and of the reference."""
    run("compare", volume, "--tau", tau, "--methods", ",".join(methods), "-o", "compared.png")
    with Image.open("compared.png") as whole:
        pictures = [whole.crop((x, y, x + SIDE, y + SIDE)).convert("RGB")
                    for y in range(0, whole.height, SIDE) for x in range(0, whole.width, SIDE)]
    order = pictures[2:] if "trilinear" not in methods else pictures[2:len(methods) + 1] + [pictures[1]]
    shown = [picture if captions else picture.crop((36, 36, SIDE - 36, SIDE - 36)) for picture in order[:len(methods)]]
    return [picture.resize((side, side * picture.height // SIDE), Image.Resampling.LANCZOS) for picture in shown]


def save_cells(file, values):
    """Samples by their corners, x fastest."""
    numpy.save(file, numpy.array(values, dtype=numpy.float32))


def turned(cell):
    """Half a turn: the first corners lie where the surface around them is seen from its outside."""
    return cell[::-1, :, ::-1]


def patterns():
    """One of each class of High corners of a cell under rotation, with at most four of them: the 15 patterns."""
    corners = list(itertools.product((0, 1), repeat=3))
    turns = []
    for axes in itertools.permutations(range(3)):
        for flips in itertools.product((0, 1), repeat=3):
            inversions = sum(axes[i] > axes[j] for i, j in itertools.combinations(range(3), 2))
            if (inversions + sum(flips)) % 2 == 0:
                turns.append([corners.index(tuple(corner[axes[i]] ^ flips[i] for i in range(3))) for corner in corners])
    seen, found = set(), []
    for count in range(5):
        for highs in itertools.combinations(range(8), count):
            if frozenset(highs) in seen:
                continue
            seen.update(frozenset(turn[i] for i in highs) for turn in turns)
            found.append(highs)
    return found


def marching_cubes_patterns(run, file):
    tiles = []
    for highs in patterns():
        if not highs:   # a cell without a surface is not drawn
            continue
        save_cells("cell.npy", turned(numpy.isin(numpy.arange(8), highs).reshape(2, 2, 2)))
        tiles += compared(run, "cell.npy", 0.6, ["marching-cubes"], 170, captions=False)
    sheet(tiles, 7, file)


TWO_CELLS = numpy.array([0, 1, 0, 1, 0, 1, 0, 0, 1, 0, 1, 1]).reshape(2, 2, 3)


def marching_cubes_hole(run, file):
    save_cells("cells.npy", TWO_CELLS)
    sheet(compared(run, "cells.npy", 0.6, ["marching-cubes"], 400), 1, file)


def face_links(run, file):
    """The saddle of the common face is 0.5: below both isovalues, or above."""
    save_cells("cells.npy", TWO_CELLS)
    sheet(compared(run, "cells.npy", 0.6, ["asymptotic-decider"], 340) + compared(run, "cells.npy", 0.4, ["asymptotic-decider"], 340), 2, file)


def connected_contours(run, file):
    run("phantom", "figure-smooth", "-o", "figure.nrrd")
    sheet(compared(run, "figure.nrrd", 57, ["connected-contours", "trilinear"], 340), 2, file)


def dividing_cubes(run, file):
    run("phantom", "gyroid", "--size", 20, "-o", "gyroid.nrrd")
    images = []
    for divisions in (1, 2, 4):
        run("render", "gyroid.nrrd", "--tau", 0, "--points", divisions, "--size", "300x300", "--plain", "--view", "30,35", "-o", "points.png")
        with Image.open("points.png") as image:
            images.append(image.convert("RGB"))
    sheet(images, 3, file)


def spider_web(run, file):
    """Two loops of four points, no plane: two triangles each, or four around an articulation point."""
    save_cells("cell.npy", [[[1, 1], [0.4, -9]], [[-9, 0.4], [1, 1]]])
    sheet(compared(run, "cell.npy", 0.5, ["marching-cubes", "spider-web"], 340), 2, file)


def mirrored_tetrahedra(run, file):
    cell = numpy.zeros((2, 2, 2))
    cell[0, 0, 0] = cell[1, 1, 1] = 1
    images = []
    for values in (cell, cell[:, :, ::-1]):
        save_cells("cell.npy", values)
        images += compared(run, "cell.npy", 0.4, ["six-tetrahedra"], 340)
    sheet(images, 2, file)


def level_sets(run, file):
    run("phantom", "figure-smooth", "-o", "figure.nrrd")
    images = []
    for tau in (65, 57, 45, 35, 25, 15):
        run("render", "figure.nrrd", "--tau", tau, "--size", "200x200", "--plain", "--view", "30,35", "-o", "level.png")
        with Image.open("level.png") as image:
            images.append(image.convert("RGB"))
    sheet(images, 6, file)
