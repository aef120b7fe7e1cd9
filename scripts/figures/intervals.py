"""Trees of intervals: 13 cells of a row, and 8 for a file."""
from fields import cells_of, phantom
from svg import Drawing, FOUND, INK, LIGHT, SOFT


def row(run, y, count):
    """Lowest and highest sample of the cells between samples of a row of a smooth field, and all samples, ascending."""
    samples = phantom(run, "random-field", 16)[5, y, :count + 1]
    low, high = cells_of(samples)
    return list(zip(low, high)), sorted(set(samples))


def names(cells):
    return " ".join(f"{cell}" for cell in cells)


def interval_tree(run):
    cells, values = row(run, 9, 13)
    place = {value: 40 + 56 * i for i, value in enumerate(values)}
    draw = Drawing(40 + 56 * len(values), 520)
    nodes = []

    def add(first, last, members, depth, parent):
        """Nodes over values[first:last]; the one in the middle takes the cells that contain its value."""
        if first >= last:
            return
        middle = (first + last) // 2
        value = values[middle]
        here = (place[value], 30 + 74 * depth)
        if parent:
            draw.line([parent, here], colour=SOFT)
        nodes.append((here, [i for i in members if cells[i][0] <= value <= cells[i][1]]))
        add(first, middle, [i for i in members if cells[i][1] < value], depth + 1, here)
        add(middle + 1, last, [i for i in members if cells[i][0] > value], depth + 1, here)
    add(0, len(values), range(len(cells)), 0, None)
    for value in values:
        draw.line([(place[value], 316), (place[value], 332 + 13 * len(cells))], colour=LIGHT)
    for (x, y), own in nodes:
        draw.dot(x, y, 6, fill=INK if own else "#ffffff", colour=INK)
        if own:
            by_low, by_high = sorted(own, key=lambda i: cells[i][0]), sorted(own, key=lambda i: -cells[i][1])
            draw.text(x, y + 20, names(by_low), 11, colour=FOUND)
            draw.text(x, y + 33, names(by_high), 11)
    for i, (low, high) in enumerate(cells):
        y = 330 + 13 * i
        draw.line([(place[low], y), (place[high], y)], width=2.5)
        draw.text(place[low] - 8, y + 4, i, 11, anchor="end")
    draw.text(40, 515, "value, by rank: a cell of the row from its lowest to its highest sample", anchor="start")
    return draw


def file_tree(run):
    slabs = 5
    cells, values = row(run, 10, 8)
    draw = Drawing(640, 470)

    def x(value):
        return 20 + 600 * (values.index(value) + 0.5) / len(values)

    def slab(value):
        return slabs * values.index(value) // len(values)
    for i in range(slabs + 1):
        begin = 20 + 600 * -(-len(values) * i // slabs) / len(values)
        end = 20 + 600 * -(-len(values) * (i + 1) // slabs) / len(values)
        draw.line([(begin, 24), (begin, 190)], colour=SOFT)
        if i < slabs:
            draw.text((begin + end) / 2, 16, f"slab {i}")
    for i, (low, high) in enumerate(cells):
        y = 40 + 18 * i
        draw.line([(x(low), y), (x(high), y)], colour=FOUND if slab(low) == slab(high) else INK, width=2.5)
        draw.text(x(low) - 6 if x(low) > 40 else x(high) + 6, y + 4, f"I{i}", 11, anchor="end" if x(low) > 40 else "start")
    own = [i for i, (low, high) in enumerate(cells) if slab(low) != slab(high)]

    def listed(cells_here):
        return " ".join(f"I{i}" for i in cells_here) or "-"
    draw.box(20, 206, 600, 122)
    draw.text(30, 224, "root", anchor="start")
    for s in range(slabs):
        middle = 80 + 120 * s
        draw.text(middle, 246, f"left({s}): " + listed(sorted((i for i in own if slab(cells[i][0]) == s), key=lambda i: cells[i][0])), 11)
        draw.text(middle, 264, f"right({s}): " + listed(sorted((i for i in own if slab(cells[i][1]) == s), key=lambda i: -cells[i][1])), 11)
    spans = {}
    for i in own:
        first, last = slab(cells[i][0]) + 1, slab(cells[i][1]) - 1
        if first <= last:
            spans.setdefault((first, last), []).append(i)
    for row_number, ((first, last), members) in enumerate(sorted(spans.items())):
        draw.text(80 + 120 * (row_number % slabs), 290 + 18 * (row_number // slabs), f"multi({first}, {last}): {listed(members)}", 11)
    for s in range(slabs):
        inside = [i for i, (low, high) in enumerate(cells) if slab(low) == slab(high) == s]
        draw.line([(80 + 120 * s, 328), (80 + 120 * s, 372)], colour=SOFT)
        draw.box(30 + 120 * s, 372, 100, 40, fill="#ffffff" if not inside else "#e6f0f9")
        draw.text(80 + 120 * s, 396, f"child {s}: {listed(inside)}", 11, colour=FOUND if inside else SOFT)
    draw.text(20, 446, "blue: cells within one slab, which go to a child; all others are in lists of the root", anchor="start")
    return draw
