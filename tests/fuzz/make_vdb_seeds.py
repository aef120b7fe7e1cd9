#!/usr/bin/env python3
"""Writes the seeds of the OpenVDB target into tests/fuzz/corpus/openvdb, without OpenVDB (the files are committed; this says how they were made)."""
import pathlib
import struct
import zlib

CORPUS = pathlib.Path(__file__).parent / "corpus" / "openvdb"
ZIP, ACTIVE, BLOSC = 1, 2, 4
SIZES = {"float": "<f", "double": "<d", "int32": "<i", "int64": "<q", "bool": "<?", "vec3s": "<3f"}
MAPS = {"ScaleTranslateMap": struct.pack("<18d", 1, 2, 3, *[2.0] * 3, *[2.0] * 3, *[0.5] * 3, *[0.25] * 3, *[0.25] * 3),
        "AffineMap": struct.pack("<16d", 0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 0.5, 0, 10, 20, 30, 1), "TranslationMap": struct.pack("<3d", 1, 2, 3),
        "NonlinearFrustumMap": struct.pack("<8d", *range(8)) + struct.pack("<I", 9) + b"AffineMap" + struct.pack("<16d", *(i % 5 == 0 for i in range(16)))}


def text(value):
    return struct.pack("<I", len(value)) + value.encode()


def metadata(**entries):
    packed = b""
    for name, value in entries.items():
        kind, data = ("bool", struct.pack("<?", value)) if isinstance(value, bool) else ("string", value.encode())
        packed += text(name) + text(kind) + struct.pack("<I", len(data)) + data
    return struct.pack("<I", len(entries)) + packed


def mask(size, bits):
    return sum(1 << bit for bit in bits).to_bytes(size // 8, "little")


class Grid:
    """A tree of two voxels in a leaf of each origin, and of tiles of the root: {origin: (value, active)}."""
    def __init__(self, kind="float", flags=ACTIVE, half=False, leaves=((0, 0, 0),), tiles=None, version=224, name="density", parent="", linear="ScaleTranslateMap", **entries):
        self.kind, self.flags, self.half, self.leaves, self.tiles = kind, flags, half, leaves, tiles or {}
        self.version, self.name, self.parent, self.linear, self.entries = version, name, parent, linear, entries

    def value(self, number, half=False):
        count = 3 if self.kind == "vec3s" else 1
        return struct.pack(f"<{count}e" if half else SIZES[self.kind], *[number] * count)

    def chunk(self, data):
        if self.flags & (BLOSC | ZIP) == 0:
            return data
        if self.flags & BLOSC:  # as it is, in the frame of blosc
            packed = struct.pack("<4B3I", 2, 1, 0x02 | 0x20, 4, len(data), max(len(data), 1), len(data) + 16) + data
        else:
            packed = zlib.compress(data)
        return struct.pack("<q", len(packed)) + packed if self.flags & BLOSC or len(packed) < len(data) else struct.pack("<q", -len(data)) + data

    def values(self, count, bits, form=0):
        """`form`: of the values that are not active, 0 to 6."""
        if self.version < 222:
            return self.chunk(self.value(5) * count)
        stored = len(bits) if self.flags & ACTIVE and form != 6 else count
        data = struct.pack("<b", form) + self.value(7) * {2: 1, 4: 1, 5: 2}.get(form, 0) + (mask(count, [1, 3]) if form in (3, 4, 5) else b"")
        packed = b"".join(self.value(number % 2 if self.kind == "bool" else number % 100, self.half) for number in range(1, stored + 1))
        return data + (b"" if self.half and stored == 0 else self.chunk(packed))

    def tree(self):
        roots = {}
        for leaf in sorted(self.leaves):
            roots.setdefault(tuple(x >> 12 << 12 for x in leaf), []).append(leaf)
        out = struct.pack("<i", 1) + self.value(0) + struct.pack("<II", len(self.tiles), len(roots))
        for origin, (number, active) in self.tiles.items():
            out += struct.pack("<3i", *origin) + self.value(number) + struct.pack("<?", active)
        place = lambda point, bits, below: (point[0] >> below & 2**bits - 1) << 2 * bits | (point[1] >> below & 2**bits - 1) << bits | point[2] >> below & 2**bits - 1
        voxels = [9, 77]
        for origin, leaves in roots.items():
            upper = sorted({place(leaf, 5, 7) for leaf in leaves})
            old = self.version < 222
            out += struct.pack("<3i", *origin) + mask(32768, upper) + bytes(4096) + self.values(32768 - (len(upper) if old else 0), [])
            for one in upper:
                lower = sorted(place(leaf, 4, 3) for leaf in leaves if place(leaf, 5, 7) == one)
                out += mask(4096, lower) + bytes(512) + self.values(4096 - (len(lower) if old else 0), []) + mask(512, voxels) * len(lower)
        for origin, leaves in sorted(roots.items()):
            for leaf in sorted(leaves, key=lambda leaf: (place(leaf, 5, 7), place(leaf, 4, 3))):
                out += mask(512, voxels)
                if self.kind == "bool":
                    out += struct.pack("<3i", *leaf) + mask(512, voxels)
                else:
                    out += (struct.pack("<3ib", *leaf, 1) if self.version < 222 else b"") + self.values(512, voxels, self.entries.get("form", 0))
        return out

    def packed(self, offset):
        head = text(self.name) + text(f"Tree_{self.kind}_5_4_3" + ("_HalfFloat" if self.half else "")) + text(self.parent)
        entries = {key: value for key, value in self.entries.items() if key != "form"}
        if self.half:
            entries["is_saved_as_half_float"] = True
        body = (struct.pack("<I", self.flags) if self.version >= 222 else b"") + metadata(name=self.name.split("\x1e")[0], **entries) + text(self.linear) + MAPS[self.linear]
        tree = b"" if self.parent else self.tree()
        begin = offset + len(head) + 24
        places = struct.pack("<3q", begin, begin + len(body), begin + len(body) + len(tree)) if offset else bytes(24)
        return head + places + body + tree


def vdb(*grids, version=224, offsets=True, **entries):
    out = b" BDV" + bytes(4) + struct.pack("<3I?", version, 10, 0, offsets) + (b"\1" if version < 222 else b"") + b"01234567-89ab-cdef-0123-456789abcdef"
    out += metadata(**entries) + struct.pack("<i", len(grids))
    for grid in grids:
        grid.version = version
        out += grid.packed(len(out) if offsets else 0)
    return out


def seeds():
    tile = {(0, 0, 0): (1, True), (-4096, 4096, 0): (3, False)}
    yield "tiles", vdb(Grid(leaves=(), tiles=tile, unit="mm", **{"class": "fog volume"}), creator="seed")
    yield "empty", vdb(Grid(leaves=()))
    yield "stream", vdb(Grid("double", leaves=(), tiles=tile), Grid("int64", leaves=(), tiles=tile, name="other", linear="AffineMap"), offsets=False)
    yield "instance", vdb(Grid(leaves=(), tiles=tile), Grid(name="again", parent="density", linear="TranslationMap"))
    yield "frustum", vdb(Grid(leaves=(), tiles=tile, linear="NonlinearFrustumMap"))
    yield "same", vdb(Grid(leaves=(), tiles=tile, name="a\x1e0"), Grid(leaves=(), tiles=tile, name="a\x1e1"))
    yield "leaf", vdb(Grid(**{"class": "level set"}))
    yield "two", vdb(Grid("int32", leaves=((-8, 0, 0), (16, 8, 128)), form=5))
    yield "zip", vdb(Grid("double", ZIP, form=6))
    yield "blosc", vdb(Grid("int64", BLOSC | ACTIVE, form=4))
    yield "half", vdb(Grid(half=True, form=2))
    yield "bool", vdb(Grid("bool", ZIP | ACTIVE, leaves=((0, 0, 8), (0, 0, 0))))
    yield "vectors", vdb(Grid("vec3s", name="v"), Grid(leaves=(), tiles=tile), offsets=False)
    yield "old", vdb(Grid(flags=ZIP), version=221)


def main():
    CORPUS.mkdir(parents=True, exist_ok=True)
    for name, content in seeds():
        (CORPUS / name).write_bytes(content)


if __name__ == "__main__":
    main()
