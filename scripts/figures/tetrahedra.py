"""The three ways in which a surface divides a tetrahedron."""
import itertools
import math

from svg import Drawing, INK, LOOKED, SOFT

CORNERS = [(0, 0), (118, 34), (176, -52), (84, -150)]  # as they appear; the edge between the first and the third lies behind


def tetrahedra(run):
    del run
    draw = Drawing(690, 250)
    for number, count in enumerate((1, 2, 3)):   # of Lows
        left, top = 34 + 215 * number, 166
        place = [(left + x, top + y) for x, y in CORNERS]
        order = [3, 1, 0, 2]   # v1 on top, v2 in front, v3, v4 behind
        values = {corner: (-0.55 if rank < count else 0.45) for rank, corner in enumerate(order)}
        hits = []
        for a, b in itertools.combinations(range(4), 2):
            if (values[a] < 0) != (values[b] < 0):
                share = values[a] / (values[a] - values[b])
                hits.append(tuple(place[a][i] + share * (place[b][i] - place[a][i]) for i in (0, 1)))
        middle = [sum(hit[i] for hit in hits) / len(hits) for i in (0, 1)]
        hits.sort(key=lambda hit: math.atan2(hit[1] - middle[1], hit[0] - middle[0]))
        draw.line([place[0], place[2]], colour=SOFT, dash="4 3")
        draw.line(hits, colour=LOOKED, fill="#f6d9a8", closed=True, width=1.5)
        if len(hits) == 4:
            draw.line([hits[0], hits[2]], colour=LOOKED, width=1.5)
        for a, b in itertools.combinations(range(4), 2):
            if (a, b) != (0, 2):
                draw.line([place[a], place[b]])
        for rank, corner in enumerate(order):
            x, y = place[corner]
            draw.dot(x, y, 5, fill="#ffffff" if values[corner] < 0 else INK, colour=INK)
            draw.text(x - 10 if corner in (0, 3) else x + 8, y + (18 if corner == 1 else 5), f"v{rank + 1}", anchor="end" if corner in (0, 3) else "start")
    draw.text(34, 240, "white: below the isovalue", anchor="start")
    return draw
