"""A drawing as SVG: a few shapes, numbers with one digit, so that the same drawing is the same bytes."""
from xml.sax.saxutils import escape

INK, SOFT, LIGHT, FOUND, LOOKED = "#22252b", "#9aa0aa", "#dfe2e8", "#0b6bb8", "#e9a23b"


def number(value):
    text = f"{value:.1f}"
    return "0" if text in ("0.0", "-0.0") else text.removesuffix(".0")


class Drawing:
    def __init__(self, width, height):
        self.size = (width, height)
        self.parts = []

    def line(self, points, colour=INK, width=1.0, dash="", closed=False, fill="none"):
        path = "M" + "L".join(f"{number(x)},{number(y)}" for x, y in points) + ("Z" if closed else "")
        dashes = f' stroke-dasharray="{dash}"' if dash else ""
        self.parts.append(f'<path d="{path}" fill="{fill}" stroke="{colour}" stroke-width="{number(width)}"{dashes}/>')

    def box(self, x, y, width, height, fill="none", colour=INK, line=1.0):
        self.parts.append(f'<rect x="{number(x)}" y="{number(y)}" width="{number(width)}" height="{number(height)}" fill="{fill}" '
                          f'stroke="{colour}" stroke-width="{number(line)}"/>')

    def dot(self, x, y, radius=2.5, fill=INK, colour="none"):
        self.parts.append(f'<circle cx="{number(x)}" cy="{number(y)}" r="{number(radius)}" fill="{fill}" stroke="{colour}"/>')

    def text(self, x, y, words, size=12, anchor="middle", colour=INK):
        self.parts.append(f'<text x="{number(x)}" y="{number(y)}" font-size="{number(size)}" text-anchor="{anchor}" fill="{colour}">'
                          f'{escape(str(words))}</text>')

    def __str__(self):
        width, height = self.size
        return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}" '
                'font-family="sans-serif">\n'
                f'<rect width="{width}" height="{height}" fill="#ffffff"/>\n' + "\n".join(self.parts) + "\n</svg>\n")
