"""Searches on the grid itself, in slices: octrees, the extrema graph, the chessboard; and the tree of a volume."""
import json
import pathlib

import numpy

from fields import active, cells_of, phantom
from svg import Drawing, FOUND, INK, LIGHT, LOOKED, SOFT


class Slice:
    """A slice of a smooth field, its cells drawn as squares of `side` pixels."""

    def __init__(self, run, cells_x, cells_y, side, tau=0.0):
        self.samples = phantom(run, "random-field", 48)[7, :cells_y + 1, :cells_x + 1]
        self.low, self.high = cells_of(self.samples)
        self.active = active(self.low, self.high, tau)
        self.side, self.tau, self.cells_x, self.cells_y = side, tau, cells_x, cells_y

    def fill_active(self, draw, left, top, colour=LOOKED):
        for y, x in zip(*numpy.nonzero(self.active)):
            draw.box(left + x * self.side, top + y * self.side, self.side, self.side, fill=colour, colour="none")


def octrees(run):
    field = Slice(run, 19, 11, 20)
    width = field.cells_x * field.side
    draw = Drawing(2 * width + 60, field.cells_y * field.side + 70)
    kinds = (("even subdivision", lambda size: (size + 1) // 2), ("branch on need", lambda size: 1 << ((size - 1).bit_length() - 1)))
    for number, (name, lower) in enumerate(kinds):
        left, top, nodes = 20 + number * (width + 20), 20, 0
        field.fill_active(draw, left, top, "#f6d9a8")
        waiting = [((0, 0), (field.cells_x, field.cells_y))]
        while waiting:
            begin, end = waiting.pop()
            nodes += 1
            box = (slice(begin[1], end[1]), slice(begin[0], end[0]))
            draw.box(left + begin[0] * field.side, top + begin[1] * field.side, (end[0] - begin[0]) * field.side,
                     (end[1] - begin[1]) * field.side, line=0.8)
            if not field.low[box].min() < field.tau <= field.high[box].max():
                continue
            cuts = []
            for axis in (0, 1):
                size = end[axis] - begin[axis]
                cuts.append([begin[axis], begin[axis] + lower(size), end[axis]] if size > 2 else [begin[axis], end[axis]])
            if max(map(len, cuts)) == 2:
                continue
            waiting += [((x0, y0), (x1, y1)) for x0, x1 in zip(cuts[0], cuts[0][1:]) for y0, y1 in zip(cuts[1], cuts[1][1:])]
        draw.text(left, top + field.cells_y * field.side + 24, f"{name}: {nodes} nodes visited", 13, anchor="start")
    return draw


def extrema_graph(run):
    field = Slice(run, 22, 16, 22, tau=0.2)
    samples = field.samples
    draw = Drawing(22 * 22 + 40, 16 * 22 + 70)
    field.fill_active(draw, 20, 20, "#f6d9a8")

    def at(x, y):
        return 20 + x * field.side, 20 + y * field.side
    extrema, before = [], None
    rows, columns = samples.shape
    for y in range(rows):
        draw.line([at(0, y), at(columns - 1, y)], colour=LIGHT, width=0.7)
    for x in range(columns):
        draw.line([at(x, 0), at(x, rows - 1)], colour=LIGHT, width=0.7)
    for y in range(rows):
        for x in range(columns):
            beside = [samples[v, u] for u, v in ((x - 1, y), (x + 1, y), (x, y - 1), (x, y + 1)) if 0 <= u < columns and 0 <= v < rows]
            if samples[y, x] < min(beside) or samples[y, x] > max(beside):
                extrema.append((x, y, samples[y, x] > max(beside)))
    for x, y, _ in extrema:
        if before:
            path = [before]
            while path[-1][0] != x:
                path.append((path[-1][0] + (1 if x > path[-1][0] else -1), path[-1][1]))
            while path[-1][1] != y:
                path.append((path[-1][0], path[-1][1] + (1 if y > path[-1][1] else -1)))
            draw.line([at(*place) for place in path], colour=INK, width=1.4)
            for a, b in zip(path, path[1:]):
                if (samples[a[1], a[0]] >= field.tau) != (samples[b[1], b[0]] >= field.tau):
                    seed = [min(a[i], b[i], limit) for i, limit in ((0, field.cells_x - 1), (1, field.cells_y - 1))]
                    draw.box(*at(*seed), field.side, field.side, fill=LOOKED, colour="none")
                    draw.line([at(*a), at(*b)], colour=INK, width=1.4)
        before = (x, y)
    for x, y, is_high in extrema:
        draw.dot(*at(x, y), 5, fill=FOUND if is_high else "#ffffff", colour=FOUND)
    draw.text(20, 16 * 22 + 46, f"{len(extrema)} extrema, blue: maxima; {field.active.sum()} active cells, dark: seeds on arcs", 13, anchor="start")
    return draw


def chessboard(run):
    side = 18
    volume = phantom(run, "random-field", 48)[8:11, :15, :15]
    low, high = cells_of(volume)
    found = active(low, high, 0.0)
    draw = Drawing(2 * 14 * side + 60, 14 * side + 60)
    for z in (0, 1):
        left = 20 + z * (14 * side + 20)
        for y in range(14):
            for x in range(14):
                is_black = x % 2 == y % 2 == z % 2
                fill = {(True, True): FOUND, (True, False): "#b9bec8", (False, True): "#f6d9a8", (False, False): "#ffffff"}[is_black, bool(found[z, y, x])]
                draw.box(left + x * side, 20 + y * side, side, side, fill=fill, colour=LIGHT, line=0.8)
        draw.text(left, 14 * side + 40, "slice of even number" if z == 0 else "slice of odd number", 13, anchor="start")
    return draw


def criticality_tree(run):
    """The contour tree of the figure with the changes of genus, which it does not have, as white dots."""
    run("phantom", "figure-smooth", "-o", "figure.nrrd")
    run("tree", "figure.nrrd", "-o", "tree.json")
    tree = json.loads(pathlib.Path("tree.json").read_text())
    events = [dict(zip(tree["columns"], event)) for event in tree["events"]]
    column, place = 0, {}
    for i, event in enumerate(events):   # a parent comes behind its children
        below = [place[k][0] for k, other in enumerate(events) if other["parent"] == i and k in place]
        if not below:
            column += 1
        place[i] = (sum(below) / len(below) if below else 110 * column, 24 + 30 * i)
    draw = Drawing(560, 470)
    for i, event in enumerate(events):   # the order is that of falling values
        if event["parent"] is not None:
            draw.line([place[i], place[event["parent"]]])
    for i, event in enumerate(events):
        changes_genus = event["kind"] == "genus change"
        draw.dot(*place[i], 5, fill="#ffffff" if changes_genus else INK, colour=INK)
        draw.text(place[i][0] + 10, place[i][1] + 4, f"{event['value']:.0f} {event['kind']}", 11, anchor="start")
    return draw
