"""HTML of atlases and tables for notebooks: it loads nothing, and is readable in a static export."""
from __future__ import annotations

import base64
import html
import math
import struct
import zlib
from typing import TYPE_CHECKING, Any, Sequence

import numpy as np

from . import _names

if TYPE_CHECKING:
    from ._atlas import Atlas
    from ._objects import Object

PICTURES = 12  #: lines with a picture
SIDE = 96  #: pixels


def png(rgba: Any) -> bytes:
    """An array (height, width, 4) of uint8 as a PNG file."""
    height, width = rgba.shape[:2]
    rows = np.zeros((height, 1 + 4 * width), np.uint8)
    rows[:, 1:] = rgba.reshape(height, -1)

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows.tobytes(), 6)) + chunk(b"IEND", b"")


def _picture(one: Object, atlas: Atlas) -> str:
    """An <img> of the object; empty where nothing can be drawn."""
    if atlas.ndim != 3:
        return ""
    try:
        data = base64.b64encode(png(one.picture(size=2 * SIDE, samples=2))).decode()
    except Exception:  # a table without pictures is better than none
        return ""
    return f'<img width="{SIDE}" height="{SIDE}" alt="{one.reference}" src="data:image/png;base64,{data}">'


def _range_bar(one: Object, low: float, high: float) -> str:
    """Where in the range of the samples the object is on its own, and its best isovalue."""
    span = (high - low) or 1
    begin = 0.0 if math.isinf(one.merges) else 100 * (one.merges - low) / span
    end, best = 100 * (one.appears - low) / span, 100 * (one.best_tau - low) / span
    left, width = min(begin, end), abs(end - begin)
    return (f'<svg width="120" height="14" viewBox="0 0 100 10" preserveAspectRatio="none"><rect width="100" height="10" fill="#eee"/>'
            f'<rect x="{left:.1f}" width="{width:.1f}" height="10" fill="#9bc"/><rect x="{best - 0.8:.1f}" width="1.6" height="10" '
            f'fill="#c40"/></svg>')


def table(objects: Sequence[Object], atlas: Atlas, pictures: int = PICTURES) -> str:
    low, high = atlas.range
    unit = atlas.info["measure_unit"]
    is_counted = unit == "voxels"  # no unit of length: the size is the number of samples
    heads = ["", "#", "best tau", "range of values", "voxels", *([] if is_counted else [html.escape(unit)]), "tunnels", "cavities", "why"]
    rows, names = [], _names.names_of_lines(atlas)
    for i, one in enumerate(objects):
        note = html.escape(", ".join(filter(None, (one.why or one.reason, one.note))))
        title = html.escape(" ".join(filter(None, (one.reference, names.get(_names.key_of(one))))))
        cells = [_picture(one, atlas) if i < pictures else "", title, f"{one.best_tau:g}", _range_bar(one, low, high),
                 f"{one.voxels:,}", *([] if is_counted else [f"{one.measure:,.4g}"]), str(one.tunnels or "-"), str(one.cavities or "-"), note]
        rows.append("<tr>" + "".join(f"<td>{cell}</td>" for cell in cells) + "</tr>")
    head = "".join(f"<th>{cell}</th>" for cell in heads)
    return f'<table class="isoatlas"><thead><tr>{head}</tr></thead><tbody>{"".join(rows)}</tbody></table>'


def _histogram(atlas: Atlas) -> str:
    """Of the samples in memory; empty for a store, whose samples are not read for this."""
    if atlas.is_store:
        return ""
    counts, _ = np.histogram(atlas.volume, bins=100)
    heights = np.log1p(counts) / max(1.0, math.log1p(int(counts.max())))
    bars = "".join(f'<rect x="{i}" y="{30 * (1 - h):.2f}" width="1" height="{30 * h:.2f}"/>' for i, h in enumerate(heights))
    return f'<svg width="400" height="60" viewBox="0 0 100 30" preserveAspectRatio="none" fill="#678">{bars}</svg>'


def atlas(one: Atlas) -> str:
    return f"<div><p><code>{html.escape(repr(one))}</code></p>{_histogram(one)}{table(one.objects, one)}</div>"
