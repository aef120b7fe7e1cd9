"""Draws the figures of docs/theory as SVG, with the standard library only; the same bytes on every run.

    python3 docs/theory/figures/make.py path/to/isoatlas

The program is asked for the triangles of annulus.svg, the curves of mirrors.svg and the objects of noise-gate.svg; without it these figures
are left as they are.
"""
import bisect
import csv
import itertools
import math
import pathlib
import random
import struct
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
INK, GREY, PALE = "#23272d", "#8b929c", "#c9ced6"
HIGH, LOW, OTHER, GREEN = "#d5762b", "#3a6ea5", "#8e4a9e", "#3c8d5a"
HIGH_FILL, LOW_FILL = "#f7dcc2", "#d9e5f2"


def number(x):
    text = f"{x:.2f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


class Picture:
    def __init__(self, name, width, height):
        self.name, self.width, self.height, self.parts = name, width, height, []

    def path(self, points, stroke=INK, width=1.5, fill="none", dash=None, close=False, opacity=None):
        data = "M" + "L".join(f"{number(x)} {number(y)}" for x, y in points) + ("Z" if close else "")
        self.data(data, stroke, width, fill, dash, opacity)

    def data(self, data, stroke=INK, width=1.5, fill="none", dash=None, opacity=None):
        extra = (f' stroke-dasharray="{dash}"' if dash else "") + (f' fill-opacity="{opacity}"' if opacity else "")
        self.parts.append(f'<path d="{data}" fill="{fill}" stroke="{stroke}" stroke-width="{number(width)}"{extra}'
                          ' stroke-linejoin="round" stroke-linecap="round"/>')

    def line(self, p, q, stroke=INK, width=1.5, dash=None):
        self.path([p, q], stroke, width, dash=dash)

    def dot(self, p, radius, fill, stroke="#ffffff", width=1.5):
        self.parts.append(f'<circle cx="{number(p[0])}" cy="{number(p[1])}" r="{number(radius)}" fill="{fill}" stroke="{stroke}"'
                          f' stroke-width="{number(width)}"/>')

    def text(self, p, words, size=14, anchor="middle", fill=INK, bold=False, halo=False):
        words = words.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
        extra = ' font-weight="bold"' if bold else ""
        extra += ' stroke="#ffffff" stroke-width="4" paint-order="stroke" stroke-linejoin="round"' if halo else ""
        self.parts.append(f'<text x="{number(p[0])}" y="{number(p[1])}" font-size="{size}" text-anchor="{anchor}" fill="{fill}"{extra}>'
                          f"{words}</text>")

    def legend(self, y, entries):
        """Dots of a colour (None: words alone) with what they mean, in one centred row."""
        widths = [sum(4.3 if c in "iljtfr :,;()" else 11.6 if c in "mwMW" else 7.6 for c in words) + (16 if tint else 0) for tint, words in entries]
        x = (self.width - sum(widths) - 24 * (len(entries) - 1)) / 2
        for (tint, words), width in zip(entries, widths):
            if tint:
                self.dot((x + 5, y - 4.5), 5, tint, GREY if tint == "#ffffff" else "#ffffff", 1)
            self.text((x + (16 if tint else 0), y), words, 12.5, "start", "#5b626c")
            x += width + 24

    def write(self):
        head = (f'<svg xmlns="http://www.w3.org/2000/svg" width="{self.width}" height="{self.height}"'
                f' viewBox="0 0 {self.width} {self.height}" font-family="DejaVu Sans, Verdana, Arial, sans-serif">\n'
                f'<rect width="{self.width}" height="{self.height}" fill="#ffffff"/>\n')
        (HERE / self.name).write_text(head + "\n".join(self.parts) + "\n</svg>\n", encoding="utf-8")


def camera(azimuth, elevation, centre, scale, origin=(0.5, 0.5, 0.5)):
    """Orthographic projection: a function from points to (screen x, screen y), and one to the depth (larger is nearer)."""
    a, e = math.radians(azimuth), math.radians(elevation)
    right = (-math.sin(a), math.cos(a), 0.0)
    up = (-math.sin(e) * math.cos(a), -math.sin(e) * math.sin(a), math.cos(e))
    view = (math.cos(e) * math.cos(a), math.cos(e) * math.sin(a), math.sin(e))

    def along(axis, p):
        return sum(axis[i] * (p[i] - origin[i]) for i in range(3))

    return (lambda p: (centre[0] + scale * along(right, p), centre[1] - scale * along(up, p))), (lambda p: along(view, p))


# --- the cell, as in src/field/cell.h ---------------------------------------------------------------------------------------------------

def corner(k):
    return (k & 1, k >> 1 & 1, k >> 2 & 1)


EDGES = [(k, k | 1 << axis) for axis in range(3) for k in range(8) if not k >> axis & 1]
FACES = []
for first, second, normal in ((0, 1, 2), (0, 2, 1), (1, 2, 0)):
    for side in (0, 1):
        base = side << normal
        FACES.append((base, base | 1 << first, base | 1 << first | 1 << second, base | 1 << second))


def edge(k, other):
    return (min(k, other), max(k, other))


def loops_of(high, joined):
    """Loops of hits (pairs of corners); joined(face, its Highs): are the Highs of a 4-hit face joined?"""
    links = {}
    for face in FACES:
        hits = [edge(face[i], face[(i + 1) % 4]) for i in range(4) if (face[i] in high) != (face[(i + 1) % 4] in high)]
        pairs = [hits] if len(hits) == 2 else []
        if len(hits) == 4:
            highs = [k for k in face if k in high]
            for i, k in enumerate(face):  # cut off the Lows of a joined face, else the Highs
                if (k in high) != joined(face, highs):
                    pairs.append([edge(face[i - 1], k), edge(k, face[(i + 1) % 4])])
        for p, q in pairs:
            links.setdefault(p, []).append(q)
            links.setdefault(q, []).append(p)
    loops, seen = [], set()
    for start in sorted(links):
        if start in seen:
            continue
        loop, here = [], start
        while here is not None:
            loop.append(here)
            seen.add(here)
            here = next((hit for hit in links[here] if hit not in seen), None)
        loops.append(loop)
    return loops


def middle(hit, t=0.5):
    p, q = corner(hit[0]), corner(hit[1])
    return tuple(p[i] + t * (q[i] - p[i]) for i in range(3))


def is_hidden(p, q, depth):
    """An edge of the cube that touches its farthest corner."""
    far = min((corner(k) for k in range(8)), key=depth)
    return p == far or q == far


def draw_cube(picture, project, depth, hidden):
    for k, other in EDGES:
        p, q = corner(k), corner(other)
        if is_hidden(p, q, depth) == hidden:
            picture.line(project(p), project(q), PALE if hidden else GREY, 1.3, "4 4" if hidden else None)


# --- (a) an ambiguous face ----------------------------------------------------------------------------------------------------------------

def ambiguous_face():
    a, b, c, d = 9.0, 1.0, 6.0, 2.0
    saddle = (a * c - b * d) / (a + c - b - d)
    twist = a + c - b - d
    x0, y0 = (a - d) / twist, (a - b) / twist
    picture = Picture("ambiguous-face.svg", 900, 356)
    size, top = 210, 62

    def curve_y(x, tau):
        return (tau - a - (b - a) * x) / ((d - a) + twist * x)

    panels = ((5.2, "tau = 5.2, above s", "Highs separated"), (saddle, "tau = s = 4.333", "joined from here down"), (3.4, "tau = 3.4, below s", "Highs joined"))
    for i, (tau, title, note) in enumerate(panels):
        left = 60 + i * 290

        def at(x, y, left=left):
            return (left + size * x, top + size * (1 - y))

        picture.path([at(0, 0), at(1, 0), at(1, 1), at(0, 1)], GREY, 1.2, LOW_FILL, close=True)
        hits = [(0, (tau - a) / (d - a)), ((tau - a) / (b - a), 0), (1, (tau - b) / (c - b)), ((tau - d) / (c - d), 1)]
        if i == 1:
            picture.path([at(0, 0), at(x0, 0), at(x0, y0), at(0, y0)], "none", 0, HIGH_FILL, close=True)
            picture.path([at(1, 1), at(x0, 1), at(x0, y0), at(1, y0)], "none", 0, HIGH_FILL, close=True)
            picture.line(at(x0, 0), at(x0, 1), HIGH, 2.4)
            picture.line(at(0, y0), at(1, y0), HIGH, 2.4)
        else:
            joined = i == 2
            # one branch from the left border, one from the right one
            ends = (hits[0], hits[3] if joined else hits[1]), (hits[2], hits[1] if joined else hits[3])
            branches = []
            for start, end in ends:
                xs = [start[0] + (end[0] - start[0]) * j / 40 for j in range(41)]
                branches.append([start] + [(x, curve_y(x, tau)) for x in xs[1:-1]] + [end])
            if joined:
                region = [(0, 0)] + branches[0] + [(1, 1)] + branches[1]
                picture.path([at(*p) for p in region], "none", 0, HIGH_FILL, close=True)
            else:
                picture.path([at(*p) for p in [(0, 0)] + branches[0]], "none", 0, HIGH_FILL, close=True)
                picture.path([at(*p) for p in [(1, 1)] + branches[1]], "none", 0, HIGH_FILL, close=True)
            for branch in branches:
                picture.path([at(*p) for p in branch], HIGH, 2.4)
                picture.line(at(*branch[0]), at(*branch[-1]), INK, 1.4, "5 4")
            for hit in hits:
                picture.dot(at(*hit), 4, INK)
        picture.path([at(0, 0), at(1, 0), at(1, 1), at(0, 1)], GREY, 1.2, close=True)
        picture.dot(at(x0, y0), 5, GREEN)
        picture.text((at(x0, y0)[0] + 11, at(x0, y0)[1] - 9), "s", 15, fill=GREEN, bold=True, halo=True)
        for x, y, name, value in ((0, 0, "a", 9), (1, 0, "b", 1), (1, 1, "c", 6), (0, 1, "d", 2)):
            p = at(x, y)
            picture.dot(p, 7, HIGH if value >= tau else LOW)
            picture.text((p[0], p[1] + (25 if y == 0 else -14)), f"{name} = {value}", 13)
        picture.text((left + size / 2, 24), title, 15, bold=True)
        picture.text((left + size / 2, top + size + 50), note, 14)
    picture.legend(346, ((HIGH, "High; curves: the bilinear interpolant equals tau"), (LOW, "Low"), (GREEN, "face point"), (None, "dashed: links of the mesh")))
    picture.write()


# --- (b) terrain and its trees --------------------------------------------------------------------------------------------------------------

# hills and hollows: place, height, width
PEAKS = ((0.0, 1.05, 100.0, 0.5), (-1.0, -0.6, 82.0, 0.52), (1.0, -0.6, 66.0, 0.52), (-0.6, 0.25, 25.0, 0.3), (0.6, 0.22, 14.0, 0.3),
         (0.0, -0.1, -14.0, 0.28))


def terrain(x, y):
    return sum(h * math.exp(-((x - px) ** 2 + (y - py) ** 2) / (2 * w * w)) for px, py, h, w in PEAKS)


def stationary(x, y):
    """The stationary point near a guess: the flattest place around it, then Newton's method on the gradient."""
    e = 1e-4

    def slope(p):
        return math.hypot(terrain(p[0] + e, p[1]) - terrain(p[0] - e, p[1]), terrain(p[0], p[1] + e) - terrain(p[0], p[1] - e))

    x, y = min(((x + i * 0.02, y + j * 0.02) for i in range(-15, 16) for j in range(-15, 16)), key=slope)
    for _ in range(20):
        f = terrain(x, y)
        gx, gy = (terrain(x + e, y) - terrain(x - e, y)) / (2 * e), (terrain(x, y + e) - terrain(x, y - e)) / (2 * e)
        hxx = (terrain(x + e, y) - 2 * f + terrain(x - e, y)) / (e * e)
        hyy = (terrain(x, y + e) - 2 * f + terrain(x, y - e)) / (e * e)
        hxy = (terrain(x + e, y + e) - terrain(x + e, y - e) - terrain(x - e, y + e) + terrain(x - e, y - e)) / (4 * e * e)
        det = hxx * hyy - hxy * hxy
        x, y = x - (hyy * gx - hxy * gy) / det, y - (hxx * gy - hxy * gx) / det
    return x, y


def level_loops(values, columns, rows, level):
    """Closed level curves of samples on a grid whose border is low, by linking the segments of its squares."""
    follow = {}

    def hit(p, q):
        u, v = values[p[1]][p[0]], values[q[1]][q[0]]
        t = (level - u) / (v - u)
        return (p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]))

    place = {}
    for y in range(rows - 1):
        for x in range(columns - 1):
            square = [(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)]
            leave = enter = None
            for i in range(4):
                p, q = square[i], square[(i + 1) % 4]
                if (values[p[1]][p[0]] >= level) == (values[q[1]][q[0]] >= level):
                    continue
                key = (min(p, q), max(p, q))
                place[key] = hit(*key)
                if values[p[1]][p[0]] >= level:
                    leave = key
                else:
                    enter = key
            if leave is not None:
                follow[leave] = enter
    loops = []
    while follow:
        key = min(follow)
        loop = []
        while key in follow:
            loop.append(place[key])
            key = follow.pop(key)
        loops.append(loop)
    return loops


def blend(first, second, t):
    one, two = ([int(c[i:i + 2], 16) for i in (1, 3, 5)] for c in (first, second))
    return "#" + "".join(f"{round(u + t * (v - u)):02x}" for u, v in zip(one, two))


def trees_2d():
    columns, rows, span = 101, 96, (-2.4, 2.4, -2.0, 2.5)
    x_at = [span[0] + (span[1] - span[0]) * i / (columns - 1) for i in range(columns)]
    y_at = [span[2] + (span[3] - span[2]) * j / (rows - 1) for j in range(rows)]
    values = [[terrain(x, y) for x in x_at] for y in y_at]
    picture = Picture("trees-2d.svg", 960, 430)
    left, top, scale = 16, 42, 75

    def at(x, y):
        return (left + scale * (x - span[0]), top + scale * (span[3] - y))

    levels = list(range(3, 100, 8))
    picture.path([at(span[0], span[2]), at(span[1], span[2]), at(span[1], span[3]), at(span[0], span[3])], PALE, 1, "#eef3f9", close=True)
    for n, level in enumerate(levels):
        data = ""
        for loop in level_loops(values, columns, rows, level):
            points = [at(span[0] + (span[1] - span[0]) * u / (columns - 1), span[2] + (span[3] - span[2]) * v / (rows - 1)) for u, v in loop]
            data += "M" + "L".join(f"{p[0]:.1f} {p[1]:.1f}" for p in points) + "Z"
        tint = blend("#dfe9f3", "#fae8d6", min(1, n / 4)) if n < 4 else blend("#fae8d6", "#c9611a", (n - 4) / (len(levels) - 5))
        picture.parts.append(f'<path d="{data}" fill="{tint}" fill-rule="evenodd" stroke="#ffffff" stroke-width="0.8"/>')
    points = {"A": stationary(0, 1.05), "B": stationary(-1, -0.6), "C": stationary(1, -0.6), "s1": stationary(-0.5, 0.2),
              "s2": stationary(0.5, 0.2), "s3": stationary(0, -0.6), "m": stationary(0, -0.05)}
    value = {name: terrain(*p) for name, p in points.items()}
    order = sorted(value, key=lambda name: -value[name])
    if order[:3] != ["A", "B", "C"] or order[3:] != ["s1", "s2", "s3", "m"]:
        raise SystemExit(f"the terrain has another order: {value}")
    colour = {"A": HIGH, "B": HIGH, "C": HIGH, "s1": GREEN, "s2": GREEN, "s3": GREEN, "m": LOW}
    for name, p in points.items():
        q = at(*p)
        picture.dot(q, 5.5, colour[name], INK, 1.2)
        picture.text((q[0] + (13 if name[0] != "m" else 14), q[1] - 7), name, 14, bold=True, halo=True)
    picture.text((left + scale * (span[1] - span[0]) / 2, 26), "height field", 15, bold=True)

    low, high = 0.0, 100.0
    base, upper = 372, 56

    def height(v):
        return base - (v - low) / (high - low) * (base - upper)

    level_of = {**value, "EXT": -2.0}
    axis = 418
    picture.line((axis, upper - 8), (axis, base + 6), GREY, 1.2)
    for v in range(0, 101, 20):
        picture.line((axis - 4, height(v)), (axis, height(v)), GREY, 1.2)
        picture.text((axis - 8, height(v) + 4.5), str(v), 12, "end", GREY)
    for name in order:
        picture.line((axis, height(value[name])), (935, height(value[name])), "#e3e6ea", 1)
    trees = (
        ("join tree", 520, {"A": -38, "B": 6, "C": 46, "s1": -14, "s2": 8, "s3": 8, "m": 8, "EXT": 8},
         [("A", "s1"), ("B", "s1"), ("s1", "s2"), ("C", "s2"), ("s2", "s3"), ("s3", "m"), ("m", "EXT")], ("s3", "m")),
        ("split tree", 690, {"A": 0, "B": 0, "C": 0, "s1": 0, "s2": 0, "s3": 0, "m": -28, "EXT": 26},
         [("A", "B"), ("B", "C"), ("C", "s1"), ("s1", "s2"), ("s2", "s3"), ("s3", "m"), ("s3", "EXT")], ("B", "C", "s1", "s2")),
        ("contour tree", 850, {"A": -44, "B": 0, "C": 44, "s1": -20, "s2": 6, "s3": 6, "m": -24, "EXT": 30},
         [("A", "s1"), ("B", "s1"), ("s1", "s2"), ("C", "s2"), ("s2", "s3"), ("s3", "m"), ("s3", "EXT")], ()),
    )
    for title, x, shift, arcs, passing in trees:
        spot = {name: (x + shift[name], height(level_of[name])) for name in level_of}
        for p, q in arcs:
            picture.line(spot[p], spot[q], INK, 2)
        for name in level_of:
            through = name in passing
            fill = "#ffffff" if through else GREY if name == "EXT" else colour[name]
            picture.dot(spot[name], 4.5 if through else 6, fill, INK if through else "#ffffff", 1.2 if through else 1.5)
            side = -1 if title != "join tree" and name in ("m",) or title == "contour tree" and name in ("A", "s1") or title == "join tree" and name in ("A", "s1") else 1
            if name == "EXT":
                picture.text((spot[name][0], spot[name][1] + 20), "EXT", 12, fill=GREY)
            else:
                picture.text((spot[name][0] + 11 * side, spot[name][1] + 4.5), name, 13, "start" if side > 0 else "end", halo=True)
        picture.text((x, 26), title, 15, bold=True)
    picture.legend(422, ((HIGH, "maximum"), (GREEN, "saddle"), (LOW, "minimum"), (GREY, "outside"), ("#ffffff", "one arc above, one below")))
    picture.write()
    return value


# --- (c) link types of a voxel ----------------------------------------------------------------------------------------------------------------

def link_types():
    picture = Picture("link-types.svg", 960, 292)
    # which neighbours lie above: -x +x -y +y -z +z
    panels = (("k = 0", "maximum (0,1)", (0, 0, 0, 0, 0, 0)), ("k = 1", "saddle (2,1)", (0, 0, 0, 0, 1, 1)), ("k = 2", "saddle (1,2)", (1, 1, 1, 1, 0, 0)),
              ("k = 3", "minimum (1,0)", (1, 1, 1, 1, 1, 1)), ("a mixed axis", "regular (1,1)", (0, 1, 1, 1, 0, 0)))
    spots = ((-1, 0, 0), (1, 0, 0), (0, -1, 0), (0, 1, 0), (0, 0, -1), (0, 0, 1))
    for n, (title, note, above) in enumerate(panels):
        project, depth = camera(-62, 20, (98 + n * 191, 138), 72, (0, 0, 0))
        lines = []
        for i in range(6):
            for j in range(i + 1, 6):
                if i // 2 != j // 2:
                    p, q = spots[i], spots[j]
                    mean = tuple((p[c] + q[c]) / 2 for c in range(3))
                    lines.append((depth(mean), i, j))
        for far, i, j in sorted(lines):
            same = above[i] == above[j]
            tint = (HIGH if above[i] else LOW) if same else PALE
            picture.line(project(spots[i]), project(spots[j]), tint, 3.2 if same else 1.2, None if far > -0.05 else "5 5")
        for i in range(6):
            picture.line(project((0, 0, 0)), project(spots[i]), GREY, 1, "2 4")
        picture.dot(project((0, 0, 0)), 6, INK)
        for i in sorted(range(6), key=lambda i: depth(spots[i])):
            picture.dot(project(spots[i]), 8, HIGH if above[i] else LOW)
        picture.text((98 + n * 191, 30), title, 15, bold=True)
        picture.text((98 + n * 191, 250), note, 14)
    picture.legend(282, ((INK, "the voxel"), (HIGH, "neighbours above it"), (LOW, "neighbours below it"), (None, "thick lines: joined inside their common face")))
    picture.write()


# --- (d) the loops of a cell and their fans ---------------------------------------------------------------------------------------------------

def far_corner(depth):
    return min(range(8), key=lambda k: depth(corner(k)))


def draw_loops(picture, project, depth, loops, colours, at, fans):
    for near in (False, True):
        for loop, tint in zip(loops, colours):
            for i, hit in enumerate(loop):
                p, q = at(hit), at(loop[(i + 1) % len(loop)])
                face_middle = tuple((p[c] + q[c]) / 2 for c in range(3))
                on_far = any(face_middle[c] in (0.0, 1.0) and depth(tuple(face_middle[c] if i == c else 0.5 for i in range(3))) < 0 for c in range(3))
                if on_far == near:
                    continue
                picture.line(project(p), project(q), tint, 2.6, "6 5" if on_far and not fans else None)


def cell_loops():
    picture = Picture("cell-loops.svg", 900, 344)
    high = {3, 0, 4}
    value = [7.0, 1.0, 2.0, 9.0, 8.0, 0.5, 1.5, 2.5]
    tau = 5.0

    def at(hit):
        return middle(hit, (tau - value[hit[0]]) / (value[hit[1]] - value[hit[0]]))

    panels = (("hits, links, loops", False, False), ("the fans of both loops", False, True), ("ambiguous face joined: one loop", True, True))
    for n, (title, joined, fans) in enumerate(panels):
        project, depth = camera(-62, 22, (152 + n * 298, 178), 158)
        loops = loops_of(high, lambda face, highs, joined=joined: joined)
        colours = [OTHER, GREEN] if len(loops) == 2 else [OTHER]
        draw_cube(picture, project, depth, True)
        far = far_corner(depth)
        picture.dot(project(corner(far)), 8, HIGH if far in high else LOW)
        if not fans:
            draw_loops(picture, project, depth, loops, colours, at, False)
        else:
            triangles = []
            for loop, tint in zip(loops, colours):
                hub = tuple(sum(at(hit)[c] for hit in loop) / len(loop) for c in range(3))
                for i, hit in enumerate(loop):
                    corners = [hub, at(hit), at(loop[(i + 1) % len(loop)])]
                    triangles.append((sum(depth(p) for p in corners), corners, tint))
            for _, corners, tint in sorted(triangles, key=lambda t: t[0]):
                picture.path([project(p) for p in corners], tint, 1, blend("#ffffff", tint, 0.32), close=True, opacity="0.82")
            draw_loops(picture, project, depth, loops, colours, at, True)
            for loop in loops:
                hub = tuple(sum(at(hit)[c] for hit in loop) / len(loop) for c in range(3))
                picture.dot(project(hub), 5, "#ffffff", INK, 1.5)
        draw_cube(picture, project, depth, False)
        for loop in loops:
            for hit in loop:
                picture.dot(project(at(hit)), 4.2, INK)
        for k in range(8):
            if k != far:
                picture.dot(project(corner(k)), 8, HIGH if k in high else LOW)
        picture.text((152 + n * 298, 28), title, 15, bold=True)
    picture.legend(334, ((HIGH, "High"), (LOW, "Low"), (INK, "hits"), ("#ffffff", "articulation points: the mean of a loop")))
    picture.write()


# --- (e) the six tunnel configurations --------------------------------------------------------------------------------------------------------

SHAPES = (("4", {3}, {4}, {0, 1, 2, 5, 6, 7}), ("6", {3}, {0, 4}, {1, 2, 5, 6, 7}), ("12.1", {1, 2, 3}, {4}, {0, 5, 6, 7}),
          ("10.1", {2, 3}, {4, 5}, {0, 1, 6, 7}), ("13.5", {3}, {0, 5, 6}, {1, 2, 7}), ("7.4", {0, 1, 3, 5}, {6}, {2, 4, 7}))


def tunnel_configurations():
    picture = Picture("tunnel-configurations.svg", 900, 650)
    for n, (case, first, second, ring) in enumerate(SHAPES):
        column, row = n % 3, n // 3
        centre = (152 + column * 298, 164 + row * 308)
        project, depth = camera(-64, 20, centre, 138)
        high = first | second

        def region(k):
            return "a" if k in first else "b" if k in second else "ring" if k in ring else "third"

        loops = loops_of(high, lambda face, highs: region(highs[0]) == region(highs[1]))
        kept, colours = [], []
        for loop in loops:
            upper = next(k for k in loop[0] if k in high)
            lower = next(k for k in loop[0] if k not in high)
            kept.append(loop)
            colours.append(GREY if region(lower) == "third" else HIGH if region(upper) == "a" else OTHER)
        draw_cube(picture, project, depth, True)
        draw_loops(picture, project, depth, kept, colours, middle, False)
        draw_cube(picture, project, depth, False)
        for loop in kept:
            for hit in loop:
                picture.dot(project(middle(hit)), 3.4, INK, "#ffffff", 1)
        tint = {"a": HIGH, "b": OTHER, "ring": LOW, "third": "#ffffff"}
        for k in range(8):
            p = project(corner(k))
            kind = region(k)
            picture.dot(p, 11, tint[kind], GREY if kind == "third" else "#ffffff")
            picture.text((p[0], p[1] + 4.6), str(k), 12.5, fill=GREY if kind == "third" else "#ffffff", bold=True)
        hits = sum(len(loop) for loop, c in zip(kept, colours) if c != GREY)
        picture.text((centre[0], centre[1] - 138), f"case {case}", 15, bold=True)
        picture.text((centre[0], centre[1] + 132), f"{hits} hits + 2 x {len(ring)} ring corners = {hits + 2 * len(ring)} triangles", 12.5)
    picture.legend(638, ((HIGH, "region A and its loop"), (OTHER, "region B and its loop"), (LOW, "the ring"), ("#ffffff", "another region")))
    picture.write()


# --- (f) one annulus against two disks ------------------------------------------------------------------------------------------------------------

ANNULUS_VALUES = (3.0, 2.9, 2.7, 10.0, 10.0, 3.1, 2.8, 2.95)
ANNULUS_TAU = 4.2


def surface_of_cell(program, interpolant):
    with tempfile.TemporaryDirectory(prefix="isoatlas-figure-") as folder:
        cell, mesh = pathlib.Path(folder, "cell.nrrd"), pathlib.Path(folder, "cell.obj")
        cell.write_text("NRRD0004\ntype: float\ndimension: 3\nsizes: 2 2 2\nencoding: ascii\n\n" + " ".join(map(str, ANNULUS_VALUES)) + "\n")
        subprocess.run([program, "extract", cell, "--tau", str(ANNULUS_TAU), "--interpolant", interpolant, "--boundary", "open", "--style", "compact",
                        "-q", "-o", mesh], check=True)
        points, triangles = [], []
        for line in mesh.read_text().splitlines():
            words = line.split()
            if words[:1] == ["v"]:
                points.append(tuple(map(float, words[1:4])))
            elif words[:1] == ["f"]:
                triangles.append([int(word.split("/")[0]) - 1 for word in words[1:4]])
    return [[points[i] for i in triangle] for triangle in triangles]


def is_covered(point, triangles, project, depth):
    """Does a triangle lie in front of a point?"""
    x, y = project(point)
    for triangle in triangles:
        (x0, y0), (x1, y1), (x2, y2) = (project(p) for p in triangle)
        area = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
        if abs(area) < 1e-9:
            continue
        v = ((x - x0) * (y2 - y0) - (x2 - x0) * (y - y0)) / area
        w = ((x1 - x0) * (y - y0) - (x - x0) * (y1 - y0)) / area
        d0, d1, d2 = (depth(p) for p in triangle)
        if min(v, w, 1 - v - w) > 0.005 and d0 + v * (d1 - d0) + w * (d2 - d0) > depth(point) + 0.01:
            return True
    return False


def annulus(program):
    picture = Picture("annulus.svg", 860, 420)
    light = (0.25, -0.62, 0.74)
    for n, (interpolant, title) in enumerate((("faces", "faces only: two disks"), ("trilinear", "with the body point: one annulus"))):
        triangles = surface_of_cell(program, interpolant)
        centre = (215 + n * 430, 214)
        project, depth = camera(-50, 16, centre, 212)
        draw_cube(picture, project, depth, True)
        far = far_corner(depth)

        def draw_corner(k, project=project, centre=centre):
            p = project(corner(k))
            picture.dot(p, 9, HIGH if ANNULUS_VALUES[k] >= ANNULUS_TAU else LOW)
            picture.text((p[0], p[1] + (24 if p[1] > centre[1] else -15)), f"{ANNULUS_VALUES[k]:g}", 12.5, halo=True)

        draw_corner(far)
        for triangle in sorted(triangles, key=lambda t: sum(depth(p) for p in t)):
            u = [triangle[1][c] - triangle[0][c] for c in range(3)]
            v = [triangle[2][c] - triangle[0][c] for c in range(3)]
            normal = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
            length = math.sqrt(sum(x * x for x in normal))
            shade = sum(normal[c] * light[c] for c in range(3)) / length
            origin = (0.5, 0.5, 0.5)
            from_low = depth(tuple(normal[c] + origin[c] for c in range(3))) > 0
            base = "#4f86bf" if from_low else "#e08a45"
            tint = blend(base, "#ffffff", 0.08 + 0.55 * (shade + 1) / 2 if from_low else 0.25 + 0.3 * (1 - shade) / 2)
            picture.path([project(p) for p in triangle], "#f4f6f8", 0.9, tint, close=True)
        segments = {}
        for triangle in triangles:
            for i in range(3):
                ends = tuple(sorted((triangle[i], triangle[(i + 1) % 3])))
                segments[ends] = segments.get(ends, 0) + 1
        for (p, q), uses in sorted(segments.items()):
            if uses != 1:
                continue
            steps = 40
            hidden = [is_covered(tuple(p[c] + (q[c] - p[c]) * (i + 0.5) / steps for c in range(3)), triangles, project, depth) for i in range(steps)]
            start = 0
            for i in range(1, steps + 1):
                if i < steps and hidden[i] == hidden[start]:
                    continue
                ends = [tuple(p[c] + (q[c] - p[c]) * j / steps for c in range(3)) for j in (start, i)]
                picture.line(project(ends[0]), project(ends[1]), OTHER, 1.4 if hidden[start] else 2.6, "4 4" if hidden[start] else None)
                start = i
        draw_cube(picture, project, depth, False)
        for p in sorted({p for ends, uses in segments.items() if uses == 1 for p in ends}):
            picture.dot(project(p), 4, INK, "#ffffff", 1.2)
        for k in range(8):
            if k != far:
                draw_corner(k)
        picture.text((centre[0], 28), title, 15, bold=True)
    picture.legend(410, ((None, f"isovalue {ANNULUS_TAU:g}"), (HIGH, "side of the Highs"), (LOW, "side of the Lows"), (OTHER, "the two loops: the same left and right")))
    picture.write()


# --- mirrored copies --------------------------------------------------------------------------------------------------------------------------------

SIDE = 32


def shifted(values, step):
    """The volume seen from a neighbour; it goes on at its other side."""
    return [values[(x + step[0]) % SIDE + SIDE * ((y + step[1]) % SIDE + SIDE * ((z + step[2]) % SIDE))]
            for z in range(SIDE) for y in range(SIDE) for x in range(SIDE)]


def summed(values, steps):
    return [sum(samples) for samples in zip(*(shifted(values, step) for step in steps))]


def turned(values, order, mirror):
    """A copy with its axes in another order, then mirrored along the axes with a 1 in the mask."""
    stride = [SIDE ** axis for axis in order]
    along = [[stride[i] * (SIDE - 1 - k if mirror >> i & 1 else k) for k in range(SIDE)] for i in range(3)]
    return [values[x + y + z] for z in along[2] for y in along[1] for x in along[0]]


def objects_of_tetrahedra(values, isovalues):
    """Numbers of objects when each cell is cut into six tetrahedra around its diagonal (1,1,1): each voxel has 14 neighbours."""
    width = SIDE + 2
    ahead = [x + width * (y + width * z) for x in (0, 1) for y in (0, 1) for z in (0, 1) if x or y or z]
    around = ahead + [-step for step in ahead]
    place = [x + width * (y + width * z) for z in range(1, SIDE + 1) for y in range(1, SIDE + 1) for x in range(1, SIDE + 1)]
    falling = sorted(range(len(values)), key=lambda i: -values[i])
    root, counts, count, done = {}, [], 0, 0
    for tau in reversed(isovalues):
        while done < len(falling) and values[falling[done]] >= tau:
            here = place[falling[done]]
            root[here] = here
            met = set()
            for step in around:
                there = here + step
                if there not in root:
                    continue
                while root[there] != there:
                    root[there] = root[root[there]]
                    there = root[there]
                met.add(there)
            for there in met:
                root[there] = here
            count += 1 - len(met)
            done += 1
        counts.append(count)
    return counts[::-1]


def changes_of(program, values):
    """The lives (tau_low, tau_high] of all objects, and everything that does not name a place: levels and events, sorted."""
    named = ("id", "event", "parent", "children", "x", "y", "z")
    lives, changes = [], []
    with tempfile.TemporaryDirectory(prefix="isoatlas-figure-") as folder:
        volume, table = pathlib.Path(folder, "volume.nrrd"), pathlib.Path(folder, "tree.csv")
        volume.write_text(f"NRRD0004\ntype: ushort\ndimension: 3\nsizes: {SIDE} {SIDE} {SIDE}\nencoding: ascii\n\n" + " ".join(map(str, values)) + "\n")
        for detail in ("levels", "events"):
            subprocess.run([program, "tree", volume, "--detail", detail, "--interpolant", "trilinear", "-q", "-o", table], check=True,
                           stdout=subprocess.DEVNULL)
            with table.open(newline="") as lines:
                rows = list(csv.DictReader(lines))
            changes.append(sorted(tuple(words for name, words in row.items() if name not in named) for row in rows))
            if detail == "events":
                lives = [(float(row["tau_low"] or "-inf"), float(row["tau_high"])) for row in rows]
    return lives, changes


def objects_alive(lives, isovalues):
    appear, vanish = sorted(high for _, high in lives), sorted(low for low, _ in lives)
    return [bisect.bisect_left(vanish, tau) - bisect.bisect_left(appear, tau) for tau in isovalues]


def objects_of_all_copies(program, values, isovalues):
    """Numbers of objects; all 48 mirrored and turned copies must have the same levels and events."""
    lives, expected = changes_of(program, values)
    for order in itertools.permutations(range(3)):
        for mirror in range(8):
            if changes_of(program, turned(values, order, mirror))[1] != expected:
                raise SystemExit(f"mirrors.svg: the copy with axes {order}, mirrored {mirror:03b}, has other levels or events")
    return objects_alive(lives, isovalues)


MIRRORS = ((0, LOW), (1, OTHER), (2, GREEN), (4, "#b23b54"))  # mirrored along no axis, x, y, z: the four diagonals of a cell


def draw_slice(picture, values, left, top, size):
    """The middle slice in eight tints, y upwards."""
    middle_slice = values[SIDE * SIDE * (SIDE // 2):][:SIDE * SIDE]
    low, high = min(middle_slice), max(middle_slice)
    runs = {}
    for y in range(SIDE):
        row, start = middle_slice[SIDE * y:][:SIDE], 0
        for tint, same in itertools.groupby(min(7, 8 * (value - low) // (high - low)) for value in row):
            length = len(list(same))
            runs.setdefault(tint, []).append((start, SIDE - 1 - y, length))
            start += length
    for tint, boxes in sorted(runs.items()):
        data = "".join(f"M{number(left + x * size)} {number(top + y * size)}h{number(length * size)}v{number(size)}h{number(-length * size)}z"
                       for x, y, length in boxes)
        colour = blend("#dfe9f3", "#fae8d6", tint / 3) if tint < 4 else blend("#fae8d6", "#c9611a", (tint - 3) / 4)
        picture.parts.append(f'<path d="{data}" fill="{colour}" shape-rendering="crispEdges"/>')
    picture.path([(left, top), (left + SIDE * size, top), (left + SIDE * size, top + SIDE * size), (left, top + SIDE * size)], PALE, 1, close=True)


def mirrors(program):
    source = random.Random(1)
    noise = [int(256 * source.random()) for _ in range(SIDE ** 3)]
    smooth = summed(noise, list(itertools.product((-1, 0, 1), repeat=3)))
    fibres = summed(smooth, [(t, -t, 0) for t in range(-4, 5)])
    picture = Picture("mirrors.svg", 960, 372)

    project, depth = camera(-68, 27, (108, 186), 118)
    draw_cube(picture, project, depth, True)
    for mirror, tint in MIRRORS:
        picture.line(project(corner(mirror)), project(corner(7 - mirror)), tint, 2.2)
    draw_cube(picture, project, depth, False)
    for k in range(8):
        picture.dot(project(corner(k)), 5.5, GREY)
    picture.text((108, 28), "four diagonals", 15, bold=True)

    width, base, upper, first, last = 300, 300, 66, 20, 100
    for left, title, values, top, step in ((262, "smoothed noise", smooth, 350, 100), (628, "fibres", fibres, 200, 50)):
        low, high = min(values), max(values)
        percents = [first + (last - first) * i / 160 for i in range(161)]
        isovalues = [low + (high - low) * percent / 100 for percent in percents]
        copies = [objects_of_tetrahedra(turned(values, (0, 1, 2), mirror), isovalues) for mirror, _ in MIRRORS]
        exact = objects_of_all_copies(program, values, isovalues)
        largest = max(max(counts) / min(counts) - 1 for counts in zip(*copies) if min(counts) >= 50)

        def at(percent, count, left=left, top=top):
            return (left + width * (percent - first) / (last - first), base - (base - upper) * count / top)

        for count in range(0, top + 1, step):
            picture.line(at(first, count), at(last, count), "#e3e6ea" if count else GREY, 1 if count else 1.2)
            picture.text((left - 8, at(0, count)[1] + 4.5), str(count), 12, "end", GREY)
        for percent in range(first, last + 1, 20):
            picture.line(at(percent, 0), (at(percent, 0)[0], base + 4), GREY, 1.2)
            picture.text((at(percent, 0)[0], base + 19), f"{percent} %", 12, fill=GREY)
        draw_slice(picture, values, left + 8, upper + 6, 3)
        picture.path([at(*point) for point in zip(percents, exact)], HIGH, 3.2)
        for (_, tint), counts in zip(MIRRORS, copies):
            picture.path([at(*point) for point in zip(percents, counts)], tint, 1.3)
        picture.text((left + width / 2, 28), title, 15, bold=True)
        picture.text((left + width / 2, 50), f"tetrahedra: copies differ by up to {100 * largest:.0f} %", 12.5)
        picture.text((left + width / 2, base + 38), "number of objects at isovalues in per cent of the range", 12.5, fill="#5b626c")
    picture.legend(362, ((HIGH, "isoatlas: all 48 copies"), (None, "thin lines: cells cut into tetrahedra around the diagonal of that colour")))
    picture.write()


# --- the example with 14 nodes ----------------------------------------------------------------------------------------------------------------------

KIND = {"max": HIGH, "merge": GREEN, "+": OTHER, "-": OTHER, "split": "#b23b54", "both": "#b23b54", "min": LOW}


def draw_tree(picture, nodes, arcs, spot, marks, arc_notes=()):
    for p, q in arcs:
        picture.line(spot(p), spot(q), INK, 2)
    for (p, q), words, side in arc_notes:
        u, v = spot(p), spot(q)
        place = ((u[0] + v[0]) / 2 + 9 * side, (u[1] + v[1]) / 2 + 4.5)
        picture.text(place, words, 12.5, "start" if side > 0 else "end", OTHER, True, halo=True)
    for name, (_, _, kind) in nodes.items():
        picture.dot(spot(name), 6.5, KIND.get(kind, GREY))
    for name, (words, side) in marks.items():
        p = spot(name)
        picture.text((p[0] + 13 * side, p[1] + 4.5), words, 12.5, "start" if side > 0 else "end", halo=True)


EXAMPLE = {"100": (-150, 0, "max"), "90": (-70, 1, "max"), "80": (70, 2, "max"), "70": (150, 3, "max"), "60": (-110, 4, "merge"), "58": (-110, 5, "+"),
           "56": (-110, 6, "-"), "50": (110, 7, "merge"), "48": (110, 8, "+"), "46": (110, 9, "-"), "40": (110, 10, "merge"), "38": (110, 11, "+"),
           "30": (110, 12, "both"), "20": (110, 14, "min")}
ARCS = [("100", "60"), ("90", "60"), ("60", "58"), ("58", "56"), ("80", "50"), ("70", "50"), ("50", "48"), ("48", "46"), ("56", "40"), ("46", "40"),
        ("40", "38"), ("38", "30"), ("30", "20")]


def example_trees():
    picture = Picture("example-trees.svg", 900, 520)
    words = {"100": "100", "90": "90", "80": "80", "70": "70", "60": "60 merge", "58": "58 genus +", "56": "56 genus -", "50": "50 merge", "48": "48 genus +",
             "46": "46 genus -", "40": "40 merge", "38": "38 genus +", "30": "30 genus - and split", "20": "20 minimum"}
    marks = {name: (text, 1) for name, text in words.items()}
    draw_tree(picture, EXAMPLE, ARCS, lambda name: (190 + EXAMPLE[name][0], 66 + 28 * EXAMPLE[name][1]), marks)
    picture.text((215, 28), "plateaus: 14 events", 15, bold=True)
    smooth = dict(EXAMPLE)
    smooth["30"], smooth["29.5"] = (110, 12, "-"), (110, 13, "split")
    arcs = ARCS[:-1] + [("30", "29.5"), ("29.5", "20")]
    marks = dict(marks, **{"30": ("30.0 genus -", 1), "29.5": ("29.5 split", 1)})
    draw_tree(picture, smooth, arcs, lambda name: (640 + smooth[name][0], 66 + 28 * smooth[name][1]), marks)
    picture.text((640, 28), "distinct values: 15 events", 15, bold=True)
    picture.legend(508, ((HIGH, "maximum"), (GREEN, "merge"), (OTHER, "genus change"), ("#b23b54", "split"), (LOW, "minimum")))
    picture.write()

    picture = Picture("example-genus.svg", 560, 560)
    nodes = {name: place for name, place in EXAMPLE.items()}
    nodes["20"], nodes["EXT"] = (55, 14.3, "min"), (165, 15.3, "ext")
    arcs = ARCS + [("30", "EXT")]
    dchi = {"60": "-1", "58": "-1", "56": "+1", "50": "-1", "48": "-1", "46": "+1", "40": "-1", "38": "-1", "30": "+2", "20": "-1"}
    marks = {name: (f"{name}:  {dchi[name] if name in dchi else '+1'}", 1) for name in EXAMPLE}
    marks["20"] = ("20:  -1", -1)
    marks["EXT"] = ("outside", 1)
    genus = {("58", "56"): 1, ("48", "46"): 1, ("38", "30"): 1}
    notes = [(arc, f"g {genus.get(arc, 0)}", 1 if arc in (("30", "EXT"), ("46", "40")) else -1) for arc in arcs]
    draw_tree(picture, nodes, arcs, lambda name: (265 + 1.15 * nodes[name][0], 66 + 29 * nodes[name][1]), marks, notes)
    picture.text((280, 28), "contour tree", 15, bold=True)
    picture.legend(548, ((None, "at the nodes: value and dchi"), (None, "at the arcs: genus of the contour")))
    picture.write()


# --- which objects matter -----------------------------------------------------------------------------------------------------------------

def axes(picture, left, base, width, upper, title, below):
    picture.line((left, base), (left + width, base), GREY, 1.2)
    picture.line((left, base), (left, upper), GREY, 1.2)
    picture.text((left + width / 2, 28), title, 15, bold=True)
    picture.text((left + width / 2, base + 38), below, 12.5, fill="#5b626c")


def hill(x, centre, height, width):
    return height * math.exp(-((x - centre) / width) ** 2)


def branches():
    """A large body beside a small high peak: which of the two ends where they meet?"""
    picture = Picture("branches.svg", 860, 330)
    xs = [i / 4 for i in range(1441)]
    values = [min(hill(x, 120, 400, 80), 120) + hill(x, 292, 170, 11) + hill(x, 292, 46, 44) for x in xs]
    merge = min(range(700, 1100), key=lambda i: values[i])
    level = values[merge]
    for left, title, ends in ((40, "by height: the body ends", "body"), (470, "by hypervolume: the peak ends", "peak")):
        def at(x, value, left=left):
            return (left + x, 262 - value)

        inside = [i for i in range(len(xs)) if values[i] > level and (i < merge if ends == "body" else i > merge)]
        outline = [at(xs[i], values[i]) for i in inside]
        picture.path([at(xs[inside[0]], level), *outline, at(xs[inside[-1]], level)], HIGH, 1, HIGH_FILL, close=True)
        picture.path([at(x, value) for x, value in zip(xs, values)], INK, 2)
        picture.line(at(0, level), at(360, level), GREY, 1, "4 4")
        picture.text((left + 362, 262 - level - 6), "merge", 12, "end", GREY)
        top = {"body": (120, 120), "peak": (292, max(values))}
        other = "peak" if ends == "body" else "body"
        picture.line(at(*top[ends]), at(top[ends][0], level), HIGH, 3.2)
        picture.line(at(*top[other]), at(top[other][0], 0), LOW, 3.2)
        for name, tint in ((ends, HIGH), (other, LOW)):
            picture.dot(at(*top[name]), 6, tint)
        picture.line((left, 262), (left + 360, 262), GREY, 1.2)
        picture.text((left + 180, 28), title, 15, bold=True)
    picture.legend(312, ((HIGH, "the branch that ends at the merge, and its object"), (LOW, "the main branch")))
    picture.write()


def stable_isovalues():
    """A dense core in a softer body in a background: volume over isovalue, and where it changes least."""
    def value(r):
        return 10 + 90 / (1 + math.exp((r - 30) / 0.9)) + 100 / (1 + math.exp((r - 14) / 0.9)) + 0.12 * (40 - r)

    radii = [i / 200 for i in range(1, 8001)]
    low, high, bins = value(radii[-1]), value(radii[0]), 256
    added, r = [0.0] * bins, radii[0]
    for i, r in enumerate(radii):
        k = min(bins - 1, int((value(r) - low) / (high - low) * bins))
        added[k] += 4 * math.pi * r * r / 200
    volume, total = [0.0] * bins, 0.0
    for k in reversed(range(bins)):
        total += added[k]
        volume[k] = total
    logs = [math.log(max(v, 0.5)) for v in volume]
    weights = [math.exp(-k * k / 8) for k in range(-6, 7)]
    logs = [sum(w * logs[min(bins - 1, max(0, k + j - 6))] for j, w in enumerate(weights)) / sum(weights) for k in range(bins)]
    stability = [-math.log(max(logs[k] - logs[k + 1], 1e-6)) for k in range(bins - 1)]

    picture = Picture("stable-isovalues.svg", 960, 330)
    base, upper, width = 258, 50, 250
    isovalues = [low + (high - low) * k / bins for k in range(bins)]
    peaks = [k for k in range(8, bins - 9) if stability[k] == max(stability[max(0, k - 40):k + 41])]

    def plot(left, xs, ys, x_range, y_range, tint):
        def at(x, y):
            return (left + width * (x - x_range[0]) / (x_range[1] - x_range[0]), base - (base - upper) * (y - y_range[0]) / (y_range[1] - y_range[0]))
        picture.path([at(x, y) for x, y in zip(xs, ys)], tint, 2.2)
        return at

    shades = (HIGH, LOW)
    axes(picture, 40, base, width, upper, "value along a radius", "distance from the centre")
    at = plot(40, radii[::20], [value(x) for x in radii[::20]], (0, 40), (0, high), INK)
    for k, tint in zip(peaks, shades):
        tau = low + (high - low) * (k + 1) / bins
        picture.line(at(0, tau), at(40, tau), tint, 1.2, "4 4")
        picture.text((38 + width, at(0, tau)[1] - 6), f"{tau:.0f}", 12, "end", tint)
    for left, title, ys, rng in ((360, "ln V", logs, (0, max(logs))), (680, "-ln q: high where V is stable", stability, (min(stability), max(stability) + 0.4))):
        axes(picture, left, base, width, upper, title, "isovalue")
        at = plot(left, isovalues, ys, (low, high), rng, INK)
        for k, tint in zip(peaks, shades):
            tau = low + (high - low) * (k + 1) / bins
            picture.line(at(tau, rng[0]), at(tau, rng[1]), tint, 1.2, "4 4")
            picture.text((at(tau, 0)[0], base + 18), f"{tau:.0f}", 12, fill=tint)
    picture.legend(322, ((LOW, "the core alone"), (HIGH, "body and core")))
    picture.write()


def neighbourhoods(samples, side):
    """Pairs (mean, variance around the plane that fits best) of 3^3 samples, by ascending mean: as in src/features/noise_fit.cpp."""
    found = []
    offsets = list(itertools.product((-1, 0, 1), repeat=3))
    for z, y, x in itertools.product(range(1, side - 1, 2), repeat=3):
        values = [samples[x + i + side * (y + j + side * (z + k))] for i, j, k in offsets]
        mean = sum(values) / 27
        along = [sum(o[axis] * value for o, value in zip(offsets, values)) for axis in range(3)]
        rest = sum((value - mean) ** 2 for value in values) - sum(a * a for a in along) / 18
        found.append((mean, max(0.0, rest) / 23))
    return sorted(found)


def groups_of(windows):
    """Groups (mean, sigma, weight); each takes 30 % of what is left and at least 200."""
    groups = []
    while len(windows) >= 200:
        count = len(windows) if len(windows) < 400 else max(200, len(windows) * 3 // 10)
        part, windows = windows[:count], windows[count:]
        groups.append((part[count // 2][0], math.sqrt(sorted(variance for _, variance in part)[count // 5]), count))
    return groups


def line_through(groups):
    """(base, slope) at the lowest group of the best line through two of them: quantile regression at 0.3 of the logarithms."""
    def loss(base, slope):
        above = [(math.log(sigma / (base + slope * (mean - groups[0][0]))), weight) for mean, sigma, weight in groups]
        return sum(weight * (0.3 * a if a > 0 else -0.7 * a) for a, weight in above)

    lines = []
    for (m, s, _), (n, t, _) in itertools.combinations(groups, 2):
        slope = (t - s) / (n - m)
        base = s - slope * (m - groups[0][0])
        if slope > 0 and base > 0:
            lines.append((loss(base, slope), base, slope))
    return min(lines)[1:]


def noise_fit():
    """Boxes of five values with noise that grows: what the fit sees, and what it finds."""
    side, source = 48, random.Random(4)
    samples = []
    for z, y, x in itertools.product(range(side), repeat=3):
        value = 100 * ((x // 12 + y // 12 + z // 12) % 5)
        samples.append(value + (2 + 0.05 * value) * source.gauss(0, 1))
    windows = neighbourhoods(samples, side)
    groups = groups_of(windows)
    base, slope = line_through(groups)
    picture = Picture("noise-fit.svg", 760, 380)
    left, bottom, width, height, top = 70, 300, 640, 250, 60

    def at(value, sigma):
        return (left + width * (value + 20) / 460, bottom - height * min(sigma, top) / top)

    for sigma in range(0, top + 1, 10):
        picture.line((left, at(0, sigma)[1]), (left + width, at(0, sigma)[1]), "#e3e6ea" if sigma else GREY, 1)
        picture.text((left - 8, at(0, sigma)[1] + 4.5), str(sigma), 12, "end", GREY)
    for value in range(0, 401, 100):
        picture.text((at(value, 0)[0], bottom + 19), str(value), 12, fill=GREY)
    dots = (at(mean, math.sqrt(variance)) for mean, variance in windows[::9])
    picture.data("".join(f"M{number(x)} {number(y)}h0" for x, y in dots), PALE, 3.4)
    picture.line(at(-5, 2), at(430, 2 + 0.05 * 430), GREEN, 2, "6 4")
    last = groups[-1][0]
    picture.line(at(groups[0][0], base), at(last, base + slope * (last - groups[0][0])), HIGH, 2.4)
    for mean, sigma, _ in groups:
        picture.dot(at(mean, sigma), 5.5, LOW)
    picture.text((left + width / 2, 28), "standard deviation around a plane, of neighbourhoods of 27 samples", 15, bold=True)
    picture.text((left + width / 2, bottom + 40), "their mean", 12.5, fill="#5b626c")
    picture.legend(368, ((PALE, "neighbourhoods (above 60: edges)"), (LOW, "groups"), (HIGH, "fitted"), (GREEN, "true: 2 + 0.05 value")))
    picture.write()


def most_of_noise(program, side, seed):
    """Of white noise of the standard deviation 1: the largest persistence and hypervolume of all objects but the largest."""
    source = random.Random(1000 * side + seed)
    samples = struct.pack(f"<{side ** 3}f", *(source.gauss(0, 1) for _ in range(side ** 3)))
    with tempfile.TemporaryDirectory() as folder:
        volume, curve = pathlib.Path(folder, "v.nrrd"), pathlib.Path(folder, "c.csv")
        volume.write_bytes(f"NRRD0004\ntype: float\ndimension: 3\nsizes: {side} {side} {side}\nencoding: raw\nendian: little\n\n".encode() + samples)
        subprocess.run([program, "objects", volume, "-q", "--curve", curve], check=True, stdout=subprocess.DEVNULL)
        with curve.open(newline="") as lines:
            rows = [row for row in csv.DictReader(lines) if int(row["kept"]) >= 2]
    return tuple(max(float(row["threshold"]) for row in rows if row["size"] == size) for size in ("persistence", "hypervolume"))


def noise_gate(program):
    sides = (16, 24, 32, 48, 64, 96)
    most = {side: [most_of_noise(program, side, seed) for seed in range(1, 5)] for side in sides}
    picture = Picture("noise-gate.svg", 860, 340)
    base, upper, width = 262, 50, 330
    bound = {side: 1.1 * math.sqrt(2 * math.log(side ** 3)) for side in sides}
    for left, title, top, gate, measured in (
            (60, "largest persistence / sigma", 8, lambda side: bound[side], lambda side, pair: pair[0]),
            (480, "largest hypervolume / (sigma N^2/3)", 4, lambda side: 2, lambda side, pair: pair[1] / side ** 2)):
        def at(side, y, left=left, top=top):
            return (left + width * math.log(side / 14) / math.log(110 / 14), base - (base - upper) * y / top)

        for y in range(top + 1):
            picture.line((left, at(16, y)[1]), (left + width, at(16, y)[1]), "#e3e6ea" if y else GREY, 1)
            picture.text((left - 8, at(16, y)[1] + 4.5), str(y), 12, "end", GREY)
        for side in sides:
            picture.text((at(side, 0)[0], base + 19), f"{side}\u00b3", 12, fill=GREY)
            for pair in most[side]:
                picture.dot(at(side, measured(side, pair)), 4.5, LOW, width=1)
        picture.path([at(side, gate(side)) for side in sides], HIGH, 2.2)
        picture.text((left + width / 2, 28), title, 15, bold=True)
        picture.text((left + width / 2, base + 38), "voxels of a volume of white noise", 12.5, fill="#5b626c")
    picture.legend(330, ((LOW, "four volumes of each size"), (HIGH, "the gate")))
    picture.write()
    persistence, hypervolume = ([pair[i] / (1, side ** 2)[i] for side in sides for pair in most[side]] for i in (0, 1))
    print(f"noise-gate.svg: persistence {min(persistence):.2f} to {max(persistence):.2f} sigma, "
          f"hypervolume {min(hypervolume):.2f} to {max(hypervolume):.2f} sigma N^2/3")


def main(*arguments):
    ambiguous_face()
    trees_2d()
    link_types()
    cell_loops()
    tunnel_configurations()
    example_trees()
    branches()
    stable_isovalues()
    noise_fit()
    if arguments:
        annulus(arguments[0])
        mirrors(arguments[0])
        noise_gate(arguments[0])


if __name__ == "__main__":
    main(*sys.argv[1:])
