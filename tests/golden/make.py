"""Makes the golden stores of the present version, with what they answer: ISOATLAS_CLI=build/dev/bin/isoatlas python3 tests/golden/make.py VERSION

They go to tests/golden/VERSION, the version of the format (docs/format.md). Do this once, when a version is final; never again: files of
a version that somebody may have are what these files stand for.
"""
import pathlib
import random
import subprocess
import sys
import tempfile
import json

from answers import CLI, answers

GEOMETRY = ("space: right-anterior-superior\nspace directions: (0.5,0,0) (0,-0.75,0) (0,0.25,1.5)\nspace origin: (-10,20,30.5)\n"
            'space units: "mm" "mm" "mm"\n')


def field(size, seed, bumps=12):
    """Some round bumps and a hollow one, 0 to 1; x fastest."""
    draw = random.Random(seed)
    centres = [[draw.uniform(2, n - 3) if n > 1 else 0 for n in size] + [draw.uniform(0.5, 2)] for _ in range(bumps)]
    values = []
    for z in range(size[2]):
        for y in range(size[1]):
            for x in range(size[0]):
                squares = [(x - c[0]) ** 2 + (y - c[1]) ** 2 + (z - c[2]) ** 2 for c in centres]
                value = sum(1 / (1 + s / c[3]) for s, c in zip(squares, centres)) - 0.8 / (1 + squares[0] / 2)
                values.append(value + draw.uniform(-0.05, 0.05))
    low, high = min(values), max(values)
    return [(value - low) / (high - low) for value in values]


def noise(size, seed):
    draw = random.Random(seed)
    return [draw.random() for _ in range(size[0] * size[1] * size[2])]


def nrrd(path, kind, size, values, more=""):
    dims = size if size[2] > 1 else size[:2]
    head = f"NRRD0004\ntype: {kind}\ndimension: {len(dims)}\nsizes: {' '.join(map(str, dims))}\n{more}encoding: ascii\n\n"
    path.write_text(head + "\n".join(map(str, values)) + "\n")


VOLUMES = {   # name: type, size, values, lines of the header, options of the build
    "uint8_objects": ("uint8", (13, 12, 14), lambda size: [round(255 * v) for v in field(size, 1)], "", []),
    "float32_filtered": ("float", (9, 10, 8), lambda size: [round(v, 4) for v in noise(size, 2)], GEOMETRY, ["--gaussian", "0.4"]),
    "uint16_noise_faces": ("uint16", (12, 11, 12), lambda size: [int(3000 * v) for v in noise(size, 3)], "", ["--interpolant", "faces"]),
    "int16_tunnels": ("int16", (9, 8, 10), lambda size: [round(400 * v) - 200 for v in noise(size, 4)], "", ["--tunnel-height", "3%"]),
    "int16_both": ("int16", (13, 11, 12), lambda size: [round(900 * v) - 300 for v in field(size, 6)], GEOMETRY, ["--polarity", "both"]),
    "uint16_raw": ("uint16", (17, 16, 9), lambda size: [int(65535 * v) for v in noise(size, 7)], "", []),
    "flat": ("uint8", (20, 15, 1), lambda size: [round(99 * v) for v in field(size, 5)], "", []),
}
FIRST_OF = {"int16_both": 4, "uint16_raw": 5}   # the others are stores of every version


def main(version):
    folder = pathlib.Path(__file__).parent / version
    folder.mkdir()
    with tempfile.TemporaryDirectory() as scratch:
        for name, (kind, size, values, more, options) in VOLUMES.items():
            if FIRST_OF.get(name, 1) > int(version):
                continue
            volume, store = pathlib.Path(scratch) / f"{name}.nrrd", folder / f"{name}.atlas"
            nrrd(volume, kind, size, values(size), more)
            subprocess.run([CLI, "build", volume, "-o", store, *options, "--quiet"], check=True, stdout=subprocess.DEVNULL)
            store.with_suffix(".json").write_text(json.dumps(answers(store), indent=1) + "\n")


if __name__ == "__main__":
    main(sys.argv[1])
