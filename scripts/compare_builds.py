#!/usr/bin/env python3
"""Do two isoatlas programs write the same bytes? python3 scripts/compare_builds.py OLD NEW [--data FOLDER] [--quick] [--keep FOLDER]

Both run on ten volumes of FOLDER (../shared/data beside the checkout; phantoms where it is not there): surfaces, labels, trees, stores,
tables of objects, spectra, tunnels, pages, pictures, with various options. Exit code 0 when all outputs are the same, 1 with a list of
differences.

Names that changed between versions are normalised, and nothing else: version strings, the JSON members, schemas and values of SCHEMAS and
VALUES, the CSV columns of COLUMNS, the options of OPTIONS and COMMANDS. Stores are compared byte by byte. Sentences for people are not
compared: messages, tables on the terminal, the member `detail` of checks, names of the commands of a page, legends of pictures.
--quick: the first two volumes. --keep: the outputs stay in FOLDER/old and FOLDER/new."""
import argparse
import concurrent.futures
import gzip
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

DATA = pathlib.Path(__file__).resolve().parent.parent.parent / "shared" / "data"
# file of the data, options that read it
VOLUMES = [
    ("fuel/fuel.nrrd", []), ("sthelens2d/sthelens2d.nrrd", []), ("nuclei/nuclei.nrrd", []), ("neghip/neghip.nrrd", []),
    ("dens40/dens40.nrrd", []), ("emd3001/emd3001.nrrd", []), ("functional4d/functional4d.nrrd", ["--time-step", "3"]),
    ("hydrogen/hydrogen.mha", []), ("carotid/carotid.nrrd", []), ("bolt/bolt.nrrd", []),
]
PHANTOMS = [
    ["demo", "--size", "40"], ["figure-plateau"], ["figure-smooth"], ["torus-chain"], ["nested-shells", "--size", "40"], ["marschner-lobb"],
    ["gyroid", "--size", "32"], ["checkerboard"], ["random-field", "--size", "40"], ["noise", "--size", "20"],
]

# What 0.2.0 renamed (CHANGES.md). member -> values before -> now
VALUES = {"reason": {"steady": "stable"}, "side": {"bright": "object", "dark": "cavity"}}
# schema before -> schema now, members before -> now, and those of the document itself
SCHEMAS = {
    "objects/1": ("objects/2", {"dark_branches": "cavity_branches", "dark": "cavities"}, {}),
    "dark-objects/1": ("cavities/1", {}, {}),
    "info/1": ("info/2", {"least": "min", "most": "max"}, {}),
    "spectrum/1": ("spectrum/2", {"essential": "significant", "least": "min", "most": "max"}, {}),
    "page/2": ("page/3", {"essential": "significant", "standingOut": "significant", "standsOut": "significant", "least": "min", "most": "max", "bright": "objects",
                          "dark": "cavities"}, {"objects": "found"}),
}
COLUMNS = {**{f"essential_{what}": f"significant_{what}" for what in ("objects", "contours", "tunnels", "cavities")},
           "voxels_least": "min_voxels", "voxels_most": "max_voxels", "steady": "stable"}
COMMANDS = {b" --dark": b" --cavities", b" -o dark-": b" -o cavity-"}  # in the commands that a page shows
OPTIONS = {("objects", "--cavities"): "--dark", ("label", "--cavities"): "--dark"}  # verb, option now -> option before

SURFACES = [   # output, options; T1, T2, T3: isovalues at 15, 40 and 70 percent of the range; BEST: the first object of the table
    ("1.ply", "VOLUME --tau T1"), ("2.stl", "VOLUME --tau T2 --style full"), ("3.glb", "VOLUME --tau T2 --shell outer"),
    ("4.obj", "VOLUME --tau T1 --boundary open"), ("5.vtp", "VOLUME --tau T3 --interpolant faces"), ("6.ply", "VOLUME --best --threads 1"),
    ("7.ply", "VOLUME --tau T3 --tunnel-height 2%"), ("8.vtp", "VOLUME --object BEST"), ("9.ply", "plain.atlas --tau T1 --threads 3"),
    ("10.glb", "filtered.atlas --tau T2"), ("11.ply", "faces.atlas --tau T3 --style full --boundary open"), ("12.ply", "low.atlas --object BEST"),
    ("13.obj", "VOLUME --tau T1 --shell inner"),
]
STORES = [("plain.atlas", ""), ("filtered.atlas", "--gaussian SIGMA"), ("faces.atlas", "--interpolant faces --threads 1"),
          ("low.atlas", "--tunnel-height 3% --threads 3"), ("small.atlas", "--memory LEAST")]
OTHERS = [   # verb, output or None, arguments
    ("atlas", "1.html", "VOLUME --top 3"), ("label", "1.nrrd", "VOLUME --tau T1"), ("label", "2.nii.gz", "VOLUME --zones"),
    ("label", "3.tif", "VOLUME --tau T2 --cavities"),
    ("label", "4.nii", "VOLUME --zones --keep 5"), ("label", "5.nrrd", "plain.atlas --tau T3"),
    ("label", "6.nrrd", "VOLUME --zones --interpolant faces"),
    ("tree", "1.json", "VOLUME"), ("tree", "2.graphml", "VOLUME"), ("tree", "3.vtu", "VOLUME"), ("tree", "4.csv", "VOLUME --detail elements"),
    ("tree", "5.json", "VOLUME --detail levels --interpolant faces"), ("tree", "6.json", "VOLUME --detail contours --threads 1"),
    ("tree", "7.vtu", "plain.atlas"), ("tree", "8.json", "VOLUME --keep 5"), ("tree", "9.graphml", "low.atlas --persistence 5%"),
    ("objects", None, "VOLUME"), ("objects", None, "VOLUME --cavities"), ("objects", None, "VOLUME --both --all"),
    ("objects", None, "VOLUME --tau T1"), ("objects", None, "VOLUME --persistence 5%"), ("objects", None, "plain.atlas --both --keep 3"),
    ("objects", None, "filtered.atlas"), ("objects", None, "faces.atlas --tau T2"), ("objects", "1.csv", "VOLUME --curve OUTPUT"),
    ("objects", "2.json", "VOLUME --both --curve OUTPUT"),
    ("spectrum", "1.csv", "VOLUME --samples 4"), ("spectrum", "2.json", "plain.atlas --samples 4"), ("spectrum", None, "VOLUME --keep 4 --samples 0"),
    ("handles", None, "VOLUME"), ("handles", None, "VOLUME --exact --persistence 10%"), ("info", None, "VOLUME"),
    ("info", None, "plain.atlas --tau T2"),
    ("table131", None, "VOLUME"), ("dump", None, "plain.atlas"), ("dump", None, "filtered.atlas contents"), ("dump", None, "plain.atlas brick 0"),
    ("convert", "1.nrrd", "VOLUME --gaussian SIGMA"), ("convert", "2.npy", "plain.atlas"), ("verify", None, "1.ply"),
    ("verify", None, "plain.atlas --levels 2 --seed 3"), ("render", "1.png", "VOLUME --size 96x96 --samples 1"),
    ("render", "2.png", "plain.atlas --tau T1 --volume --plain --size 64x64 --samples 1"),
]
KINDS = {"extract": "surfaces", "label": "labels", "tree": "trees", "build": "stores", "objects": "object tables"}


def run(program, folder, arguments):
    """Exit code and standard output, as bytes."""
    done = subprocess.run([program, *arguments], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=1800, check=False)
    if done.returncode < 0 or done.returncode == 1:
        sys.exit(f"{program} {' '.join(arguments)}: exit code {done.returncode}\n{done.stderr.decode()}")
    return done.returncode, done.stdout


def ask(program, folder, *arguments):
    code, text = run(program, folder, [*arguments, "--json", "--quiet"])
    if code != 0:
        sys.exit(f"{program} {' '.join(arguments)}: exit code {code}\n{text.decode()}")
    return json.loads(text)


def renamed(value, members):
    """A document with the member names and values of today, in the same order."""
    if isinstance(value, list):
        return [renamed(item, members) for item in value]
    if not isinstance(value, dict):
        return value
    found = {}
    for name, inner in value.items():
        if isinstance(inner, str):
            inner = VALUES.get(name, {}).get(inner, inner)
        found[members.get(name, name)] = renamed(inner, members)
    return found


def without_sentences(value):
    if isinstance(value, list):
        return [without_sentences(item) for item in value]
    if not isinstance(value, dict):
        return value
    dropped = "detail" if "holds" in value else "name" if "line" in value else None
    return {name: without_sentences(inner) for name, inner in value.items() if name != dropped}


def normalised_json(text, version):
    document = json.loads(text)
    if document.get("version") == version:
        document["version"] = "VERSION"
    schema, members, own = SCHEMAS.get(document.get("schema", "").removeprefix("isoatlas/"), (None, {}, {}))
    if schema:
        document["schema"] = "isoatlas/" + schema
        document = {own.get(name, name): value for name, value in renamed(document, members).items()}
    return json.dumps(without_sentences(document), indent=1).encode()


def normalised(name, content, version):
    """The content of an output with the names of today, and without the version of the program."""
    if name.endswith(".atlas"):
        return content
    if name.endswith(".json"):
        return normalised_json(content, version)
    if name.endswith(".html"):   # its data; the program of the page is another one
        for before, now in COMMANDS.items():
            content = content.replace(before, now)
        return normalised_json(re.search(rb'<script[^>]*id="atlas-data"[^>]*>(.*?)</script>', content, re.DOTALL)[1], version)
    if name.endswith(".gz"):
        content = gzip.decompress(content)
    content = content.replace(f"isoatlas {version}".encode(), b"isoatlas VERSION")
    if name.endswith(".csv"):
        content = re.sub(rb"[a-z_]+", lambda word: COLUMNS.get(word[0].decode(), word[0].decode()).encode(), content)
    if name.endswith(".vtu"):   # a document of its own schema inside
        content = content.replace(f'"{version}"'.encode(), b'"VERSION"')
    return content


def first_difference(old, new):
    """Where two contents differ, for people."""
    place = next((i for i, (a, b) in enumerate(zip(old, new)) if a != b), min(len(old), len(new)))
    parts = " | ".join(repr(text[max(0, place - 30):place + 50]) for text in (old, new))
    return f"{len(old)} and {len(new)} bytes, from byte {place}: {parts}"


class Build:
    """A program with the folder of its outputs."""

    def __init__(self, program, folder, is_old):
        self.program, self.folder, self.is_old = str(pathlib.Path(program).resolve()), folder, is_old
        folder.mkdir(parents=True)
        self.version = run(self.program, folder, ["--version"])[1].decode().split()[1]

    def output(self, verb, arguments, output):
        """(exit code, content of the output or of standard output, normalised)"""
        if self.is_old and self.version.startswith("0.1."):
            arguments = [OPTIONS.get((verb, argument), argument) for argument in arguments]
        if output:
            to = ["-o", output]
            if "OUTPUT" in arguments:
                to, arguments = [], [output if argument == "OUTPUT" else argument for argument in arguments]
            code, _ = run(self.program, self.folder, [verb, *arguments, *to, "--quiet"])
            path = self.folder / output
            content = path.read_bytes() if code == 0 else b""
        else:
            code, content = run(self.program, self.folder, [verb, *arguments, "--json", "--quiet"])
            output = "x.json"
            content = content if code in (0, 7) else b""
        return code, normalised(output, content, self.version) if content else b""


def commands(words, options):
    """(verb, output, arguments) of every output of a volume; stores first, the others use them."""
    def filled(text):
        first, *rest = text.split() or [""]
        return [words.get(word, word) for word in [first, *rest] if word]
    for name, text in STORES:
        yield "build", name, filled("VOLUME " + text) + options
    for verb, name, text in [("extract", *surface) for surface in SURFACES] + OTHERS:
        arguments = filled(text)
        yield verb, name, arguments + (options if text.startswith("VOLUME") else [])


def compare(path, options, builds, report):
    """Compares all outputs for a volume; report: kind -> [same, refused by both], differences."""
    old = builds[0]
    described = ask(old.program, old.folder, "info", path, *options)
    low, high = described["values"]["low"], described["values"]["high"]
    words = {"VOLUME": path, "SIGMA": repr(0.8 * min(described["volume"]["spacing"]))}
    words |= {f"T{i}": repr(low + part * (high - low)) for i, part in ((1, 0.15), (2, 0.4), (3, 0.7))}
    words["BEST"] = "BEST"

    def output_of(build, verb, arguments, name):
        first = ask(build.program, build.folder, "objects", path, *options)["objects"][0] if "BEST" in arguments else {}
        best = str(first.get("number", first.get("id")))   # until 0.2 an object was called by its voxel
        return build.output(verb, [best if word == "BEST" else word for word in arguments], name)

    smallest = ask(old.program, old.folder, "build", path, "-o", "x.atlas", "--dry-run", *options)["estimate"]
    words["LEAST"] = f"{(smallest.get('memory_least', smallest.get('min_memory')) >> 20) + 1}M"
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        for verb, output, arguments in commands(words, options):
            name = output and (output if output.endswith(".atlas") or verb == "extract" else f"{verb}{output}")
            (code, content), (new_code, new_content) = pool.map(lambda build: output_of(build, verb, arguments, name), builds)
            counts = report["counts"].setdefault(KINDS.get(verb, "others"), [0, 0])
            command = " ".join([verb, *arguments, *(["-o", name] if name else ["--json"])])
            if code != new_code:
                report["differences"].append(f"{command}: exit codes {code} and {new_code}")
            elif content != new_content:
                report["differences"].append(f"{command}: {first_difference(content, new_content)}")
            else:
                counts[0 if content else 1] += 1


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("old")
    parser.add_argument("new")
    parser.add_argument("--data", type=pathlib.Path, default=DATA)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--keep", type=pathlib.Path)
    arguments = parser.parse_args()
    report = {"counts": {}, "differences": []}
    with tempfile.TemporaryDirectory(prefix="isoatlas-compare-") as scratch:
        folder = arguments.keep or pathlib.Path(scratch)
        volumes = [(arguments.data / name, options) for name, options in VOLUMES if (arguments.data / name).is_file()]
        phantoms = PHANTOMS[:len(VOLUMES) - len(volumes)]
        names = [path.name for path, _ in volumes] + [f"phantom {words[0]}" for words in phantoms]
        print(f"{len(volumes)} volumes of {arguments.data}, {len(phantoms)} phantoms: {', '.join(names)}", flush=True)
        for number in range(2 if arguments.quick else len(names)):
            builds = [Build(program, folder / side / str(number), side == "old")
                      for program, side in ((arguments.old, "old"), (arguments.new, "new"))]
            for build in builds:   # each has the volume in its folder, so that paths are the same
                if number < len(volumes):
                    path, options = volumes[number]
                    os.symlink(path.resolve(), build.folder / path.name)
                else:
                    path, options = pathlib.Path("phantom.nrrd"), []
                    run(build.program, build.folder, ["phantom", *phantoms[number - len(volumes)], "-o", path.name, "--quiet"])
            before = len(report["differences"])
            compare(path.name, options, builds, report)
            print(f"{names[number]}: {len(report['differences']) - before} differences", flush=True)
            for difference in report["differences"][before:]:
                print("  " + difference, flush=True)
    print("same: " + ", ".join(f"{same} {kind}" + (f" ({refused} refused by both)" if refused else "")
                               for kind, (same, refused) in report["counts"].items()))
    print(f"{len(report['differences'])} differences between {builds[0].version} and {builds[1].version}")
    return 1 if report["differences"] else 0


if __name__ == "__main__":
    sys.exit(main())
