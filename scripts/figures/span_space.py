"""Cells as points (lowest sample, highest sample), and how methods cut that plane."""
from fields import active, cells_of, phantom
from svg import Drawing, FOUND, INK, LIGHT, LOOKED, SOFT

LEFT, TOP, SIDE = 54, 20, 400


class SpanSpace:
    """216 cells of a smooth field; the isovalue is the mean of the ends of its range."""

    def __init__(self, run):
        low, high = cells_of(phantom(run, "random-field", 32)[12:19, 12:19, 12:19])
        self.low, self.high = low.ravel(), high.ravel()
        self.first, self.last = self.low.min(), self.high.max()
        self.tau = (self.first + self.last) / 2
        self.drawing = Drawing(LEFT + SIDE + 20, TOP + SIDE + 66)

    def x(self, value):
        return LEFT + SIDE * (value - self.first) / (self.last - self.first)

    def y(self, value):
        return TOP + SIDE * (self.last - value) / (self.last - self.first)

    def vertical(self, value, **style):
        self.drawing.line([(self.x(value), self.y(value)), (self.x(value), TOP)], **style)

    def horizontal(self, value, **style):
        self.drawing.line([(LEFT, self.y(value)), (self.x(value), self.y(value))], **style)

    def frame(self):
        draw = self.drawing
        draw.line([(LEFT, TOP), (LEFT, TOP + SIDE), (LEFT + SIDE, TOP + SIDE)])
        draw.line([(LEFT, TOP + SIDE), (LEFT + SIDE, TOP)])
        draw.text(LEFT + SIDE, TOP + SIDE + 16, "lowest sample", anchor="end")
        draw.text(LEFT - 6, TOP + 10, "highest", anchor="end")
        draw.text(LEFT - 6, TOP + 24, "sample", anchor="end")
        self.vertical(self.tau, dash="5 3", width=1.5)
        self.horizontal(self.tau, dash="5 3", width=1.5)
        draw.text(self.x(self.tau) + 6, self.y(self.tau) + 14, "isovalue", anchor="start")

    def points(self, looked_at, name):
        """Dots, and below them how many are of each kind. looked_at: a mask."""
        found = active(self.low, self.high, self.tau)
        for low, high, is_active, is_looked_at in zip(self.low, self.high, found, looked_at | found):
            self.drawing.dot(self.x(low), self.y(high), fill=FOUND if is_active else LOOKED if is_looked_at else SOFT)
        counts = [(FOUND, f"{found.sum()} active"), (LOOKED, f"{(looked_at & ~found).sum()} {name}"),
                  (SOFT, f"{(~looked_at & ~found).sum()} others")]
        for i, (colour, words) in enumerate(counts):
            if not words.startswith("0 ") or colour != LOOKED:
                self.drawing.dot(LEFT + 8 + 150 * i, TOP + SIDE + 42, 4, fill=colour)
                self.drawing.text(LEFT + 18 + 150 * i, TOP + SIDE + 46, words, anchor="start")


def span_filter(run):
    buckets = 8
    space = SpanSpace(run)
    lows = sorted(space.low)
    begins = [lows[b * len(lows) // buckets] for b in range(buckets)]

    def bucket(values):
        return sum((values >= begin).astype(int) for begin in begins[1:])
    at = sum(space.tau >= begin for begin in begins[1:])
    for begin in begins[1:]:
        space.vertical(begin, colour=SOFT)
        space.horizontal(begin, colour=SOFT)
    space.points((bucket(space.low) <= at) & (at <= bucket(space.high)), "looked at in vain")
    space.frame()
    return space.drawing


def active_list(run):
    space = SpanSpace(run)
    delta = (space.high - space.low).max()
    left, right = space.x(max(space.first, space.tau - delta)), space.x(space.tau)
    space.drawing.line([(left, space.y(max(space.first, space.tau - delta))), (left, TOP), (right, TOP), (right, space.y(space.tau))],
                       colour=LIGHT, fill=LIGHT, closed=True)
    widest = (space.high - space.low).argmax()
    space.drawing.line([(space.x(space.low[widest]), space.y(space.high[widest])), (space.x(space.low[widest]), space.y(space.low[widest]))],
                       colour=LOOKED, width=2)
    space.drawing.text(space.x(space.low[widest]) + 5, space.y(space.low[widest]) - 24, "Delta", anchor="start")
    space.points((space.low < space.tau) & (space.low >= space.tau - delta), "taken out again")
    space.frame()
    return space.drawing


def kd_tree(run):
    levels = 5
    space = SpanSpace(run)

    def cut(places, by_low, box, level):
        """box: lowest and highest x, then y, in values."""
        if level == levels or len(places) < 3:
            return
        key = space.low if by_low else space.high
        places = sorted(places, key=lambda i: (key[i], i))
        middle = places[len(places) // 2]
        value = key[middle]
        width = 2.2 - 0.4 * level
        left, right, bottom, top = box
        if by_low:
            space.drawing.line([(space.x(value), space.y(max(bottom, value))), (space.x(value), space.y(top))], width=width)
            boxes = (left, value, bottom, top), (value, right, bottom, top)
        else:
            space.drawing.line([(space.x(left), space.y(value)), (space.x(min(right, value)), space.y(value))], width=width)
            boxes = (left, right, bottom, value), (left, right, value, top)
        cut(places[:len(places) // 2], not by_low, boxes[0], level + 1)
        cut(places[len(places) // 2 + 1:], not by_low, boxes[1], level + 1)
    space.points(active(space.low, space.high, space.tau), "")
    cut(range(len(space.low)), True, (space.first, space.last, space.first, space.last), 0)
    space.frame()
    return space.drawing
