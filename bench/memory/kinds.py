"""Volumes of all kinds for measuring memory: few values and many, dense and empty, thick and thin, every sample type and encoding.

write(kind, n, folder) makes about n^3 samples of a kind, the same bytes every time. Standard library only.
"""
import array
import base64
import gzip
import math
import pathlib
import random
import struct
import zlib

TYPES = {"B": "uint8", "H": "uint16", "I": "uint32", "i": "int32", "f": "float", "d": "double"}


def nrrd(path, code, size, data, encoding="raw", extra=""):
    header = (f"NRRD0004\ntype: {TYPES[code]}\ndimension: {len(size)}\nsizes: {' '.join(map(str, size))}\n"
              f"encoding: {encoding}\nendian: little\n{extra}\n")
    path.write_bytes(header.encode() + (gzip.compress(data, 1) if encoding == "gzip" else data))
    return path


def noise(count, values, seed=1):
    """Bytes 0 .. values-1, all about as frequent."""
    return random.Random(seed).randbytes(count).translate(bytes(i % values for i in range(256)))


def float_noise(count, seed=2):
    """float32 in [1, 2), 23 random bits each."""
    word, chunk = 4, 1 << 16
    chance, parts = random.Random(seed), []
    for first in range(0, count, chunk):
        size = word * min(chunk, count - first)
        bits = int.from_bytes(chance.randbytes(size), "little")
        mask, one = (int.from_bytes(struct.pack("<I", w) * (size // word), "little") for w in (0x007FFFFF, 0x3F800000))
        parts.append((bits & mask | one).to_bytes(size, "little"))
    return b"".join(parts)


def rows(n, row):
    """The bytes of row(y, z) one behind the other."""
    return b"".join(row(y, z) for z in range(n) for y in range(n))


def periodic(n, period, at):
    """uint8 samples at(x, y, z) that repeat along y and z."""
    kept = {}

    def row(y, z):
        key = (y % period, z % period)
        if key not in kept:
            kept[key] = bytes(at(x, *key) for x in range(n))
        return kept[key]

    return rows(n, row)


def boxes(n):
    """A label volume: boxes of irregular sizes, every fourth of them background."""
    chance = random.Random(3)
    kept = {}

    def row(y, z):
        key = (y // 5, z // 6)
        if key not in kept:
            line = bytearray()
            while len(line) < n:
                line += bytes([chance.choice([0, chance.randrange(1, 200), chance.randrange(1, 200), chance.randrange(1, 200)])]) * chance.randrange(2, 9)
            kept[key] = bytes(line[:n])
        return kept[key]

    return rows(n, row)


def computed(n, code, at):
    """Samples at(x, y, z) with coordinates in 0 .. 1."""
    line = [i / n for i in range(n)]
    return rows(n, lambda y, z: array.array(code, [at(x, line[y], line[z]) for x in line]).tobytes())


def shells(x, y, z):
    return int(40 * ((x - .5) ** 2 + (y - .5) ** 2 + (z - .5) ** 2) ** .5) % 2 * 200


def balls(n):
    """Balls of half a period around shifted grid points: sphere packing."""
    return lambda x, y, z: min(255, int(400 * ((x * n / 8 % 1 - .5) ** 2 + ((y * n / 8 + int(x * n / 8) / 2) % 1 - .5) ** 2 + (z * n / 8 % 1 - .5) ** 2)))


def spiral(x, y, z):
    return 100 + 100 * math.cos(6 * math.atan2(y - .5, x - .5) + 60 * math.hypot(x - .5, y - .5) + 20 * z)


def gyroid(n):
    k = 2 * math.pi * n / 12
    wave = {i / n: (math.sin(k * i / n), math.cos(k * i / n)) for i in range(n)}
    return lambda x, y, z: wave[x][0] * wave[y][1] + wave[y][0] * wave[z][1] + wave[z][0] * wave[x][1]


def speckles(n):
    """Plateaus with specks: steps of 32 voxels, one voxel in 16 raised."""
    raised = noise(n ** 3, 16, 5)
    return bytes(8 * (i % n // 32 + i // (n * n) // 32) + (1 if raised[i] == 0 else 0) for i in range(n ** 3))


def vti(path, n, data, name, compressed):
    """One zlib block that holds everything, or none, in an appended section."""
    if compressed:
        packed = zlib.compress(data, 1)
        body = struct.pack("<4Q", 1, len(data), 0, len(packed)) + packed
        word = ' compressor="vtkZLibDataCompressor"'
    else:
        body, word = struct.pack("<Q", len(data)) + data, ""
    extent = f"0 {n - 1} 0 {n - 1} 0 {n - 1}"
    text = (f'<?xml version="1.0"?>\n<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian" header_type="UInt64"{word}>\n'
            f'<ImageData WholeExtent="{extent}" Origin="0 0 0" Spacing="1 1 1"><Piece Extent="{extent}">\n'
            f'<PointData Scalars="s"><DataArray type="{name}" Name="s" format="appended" offset="0"/></PointData></Piece></ImageData>\n'
            '<AppendedData encoding="raw">_')
    path.write_bytes(text.encode() + body + b"</AppendedData></VTKFile>")
    return path


def tiff(path, n, data, packed):
    """A stack of 8-bit images, each one strip; deflate or none."""
    out, place, folders = bytearray(b"II*\0\0\0\0\0"), [], []
    for z in range(n):
        strip = data[z * n * n:(z + 1) * n * n]
        place.append(len(out))
        out += zlib.compress(strip, 1) if packed else strip
        folders.append(len(out) - place[-1])
    following = 4
    for z in range(n):
        out += b"\0" * (len(out) % 2)
        struct.pack_into("<I", out, following, len(out))
        tags = [(256, 3, n), (257, 3, n), (258, 3, 8), (259, 3, 8 if packed else 1), (262, 3, 1), (273, 4, place[z]), (277, 3, 1),
                (278, 4, n), (279, 4, folders[z]), (339, 3, 1)]
        out += struct.pack("<H", len(tags)) + b"".join(struct.pack("<HHII", tag, kind, 1, value) for tag, kind, value in tags)
        following = len(out)
        out += b"\0\0\0\0"
    path.write_bytes(out)
    return path


def flat(n):
    """Sides of an image with about n^3 pixels."""
    side = int(n ** 1.5)
    return side, side


def checker(x, y, z):
    return (x + y + z) % 2


KINDS = {
    "constant": lambda n, p: nrrd(p, "B", (n,) * 3, bytes([7]) * n ** 3),
    "ramp": lambda n, p: nrrd(p, "H", (n,) * 3, rows(n, lambda y, z: array.array("H", range(y + z, y + z + n)).tobytes())),
    "noise of 2": lambda n, p: nrrd(p, "B", (n,) * 3, noise(n ** 3, 2)),
    "noise of 4": lambda n, p: nrrd(p, "B", (n,) * 3, noise(n ** 3, 4)),
    "noise of 256": lambda n, p: nrrd(p, "B", (n,) * 3, noise(n ** 3, 256)),
    "noise float32": lambda n, p: nrrd(p, "f", (n,) * 3, float_noise(n ** 3)),
    "noise uint32": lambda n, p: nrrd(p, "I", (n,) * 3, random.Random(4).randbytes(4 * n ** 3)),
    "noise int32 of 3": lambda n, p: nrrd(p, "i", (n,) * 3, array.array("i", list(noise(n ** 3, 3))).tobytes()),
    "noise float64": lambda n, p: nrrd(p, "d", (n,) * 3, array.array("d", array.array("f", float_noise(n ** 3))).tobytes()),
    "checkerboard": lambda n, p: nrrd(p, "B", (n,) * 3, periodic(n, 2, checker)),
    "columns": lambda n, p: nrrd(p, "B", (n,) * 3, periodic(n, 2, lambda x, y, z: (x + y) % 2)),
    "checkerboard of 2": lambda n, p: nrrd(p, "B", (n,) * 3, periodic(n, 4, lambda x, y, z: checker(x // 2, y // 2, z // 2))),
    "checkerboard of 3": lambda n, p: nrrd(p, "B", (n,) * 3, periodic(n, 6, lambda x, y, z: checker(x // 3, y // 3, z // 3))),
    "checkerboard float64": lambda n, p: nrrd(p, "d", (n,) * 3, array.array("d", list(periodic(n, 2, checker))).tobytes()),
    "labels": lambda n, p: nrrd(p, "B", (n,) * 3, boxes(n)),
    "shells": lambda n, p: nrrd(p, "B", (n,) * 3, computed(n, "B", shells)),
    "plateaus with specks": lambda n, p: nrrd(p, "B", (n,) * 3, speckles(n)),
    "stripes": lambda n, p: nrrd(p, "B", (n,) * 3, periodic(n, 2, lambda x, y, z: x % 2 * 9)),
    "sheets": lambda n, p: nrrd(p, "B", (n,) * 3, periodic(n, 4, lambda x, y, z: 5 if z == 0 else 3 if y == 0 else 0)),
    "balls": lambda n, p: nrrd(p, "B", (n,) * 3, computed(n, "B", balls(n))),
    "spiral": lambda n, p: nrrd(p, "f", (n,) * 3, computed(n, "f", spiral)),
    "gyroid": lambda n, p: nrrd(p, "f", (n,) * 3, computed(n, "f", gyroid(n))),
    "image of noise": lambda n, p: nrrd(p, "B", flat(n), noise(flat(n)[0] ** 2, 256)),
    "image of one value": lambda n, p: nrrd(p, "B", flat(n), bytes([1]) * flat(n)[0] ** 2),
    "thin slab of noise": lambda n, p: nrrd(p, "B", (3, flat(n)[0], flat(n)[0] // 3), noise(3 * flat(n)[0] * (flat(n)[0] // 3), 4)),
    "noise with NaN": lambda n, p: nrrd(p, "f", (n,) * 3, struct.pack("<f", math.nan).join([float_noise(n ** 3 - n * n)[i:i + 4 * n * n - 4] for i in range(0, 4 * (n ** 3 - n * n), 4 * n * n - 4)])[:4 * n ** 3].ljust(4 * n ** 3, b"\0")),
    "gzip, noise of 2": lambda n, p: nrrd(p, "B", (n,) * 3, noise(n ** 3, 2), "gzip"),
    "VTI, one zlib block": lambda n, p: vti(p.with_suffix(".vti"), n, float_noise(n ** 3), "Float32", True),
    "VTI, one block of a checkerboard": lambda n, p: vti(p.with_suffix(".vti"), n, periodic(n, 2, checker), "UInt8", True),
    "TIFF, a deflated strip each": lambda n, p: tiff(p.with_suffix(".tif"), n, noise(n ** 3, 4), True),
}
OPTIONS = {"noise with NaN": ["--missing", "below"]}


def write(kind, n, folder):
    """Returns the path of the file."""
    name = "".join(c if c.isalnum() else "_" for c in kind)
    return KINDS[kind](n, pathlib.Path(folder) / f"{name}_{n}.nrrd")
