#!/usr/bin/env python3
"""Builds the library once per mutant of mutants.txt and demands that mutant_probe notices.

Only the translation units that see the changed file are compiled again (-O1, from an overlay that comes first in the include path);
everything else comes from the library that is already built."""
import argparse
import concurrent.futures
import json
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))
from includes import included, reached, tree_files, users  # noqa: E402

# What the probe runs: rooms, and files of others.
ROOMS = ("base", "geometry", "field", "critical", "tree", "zones", "analysis", "features", "persistence", "levelset", "mesh", "octree_front",
         "level_of_detail", "formats")
FILES = ("server/request_head.cpp", "atlas/build_fingerprint.cpp", "bricks/brick_classes.cpp", "bricks/region_growing.cpp")


def parse(path):
    """[{mutant, file, old, new}] of mutants.txt; anything unexpected is an error."""
    mutants = []
    for number, line in enumerate(path.read_text().splitlines(), 1):
        if not line.strip() or line.startswith("#"):
            continue
        key, _, text = line.partition(" ")
        if key == "mutant":
            mutants.append({})
        if key not in ("mutant", "file", "old", "new") or not mutants or key in mutants[-1]:
            sys.exit(f"{path}:{number}: unexpected line: {line}")
        mutants[-1][key] = text.strip()
    for mutant in mutants:
        if len(mutant) != 4:
            sys.exit(f"{path}: incomplete mutant {mutant}")
    return mutants


def mutated(source, mutant):
    pattern = r"\s+".join(re.escape(word) for word in mutant["old"].split())
    text, count = re.subn(pattern, lambda _: mutant["new"], source)
    if count != 1:
        raise RuntimeError(f"'old' occurs {count} times in src/{mutant['file']}: keep mutants.txt in step with the code")
    return text


def units_of(graph, name):
    """Translation units of the rooms that include src/name, directly or not."""
    files = [file.removeprefix("src/") for file in reached(graph, [f"src/{name}"])]
    return sorted(file for file in files if file.endswith(".cpp") and (file.split("/")[0] in ROOMS or file in FILES))


def commands_of(build):
    """{source: its entry of compile_commands.json}; of sources that are compiled together (ISOATLAS_UNITY): that of all of them."""
    found = {}
    for entry in json.loads((build / "compile_commands.json").read_text()):
        found[entry["file"]] = entry
        if "/Unity/" in entry["file"]:
            found |= {source: entry for source in re.findall(r'#include "([^"]+)"', pathlib.Path(entry["file"]).read_text())}
    return found


def to_compile(commands, src, overlay, units):
    """[(entry, source)]: what has these units, from the overlay where that has it; a source of several units is written anew."""
    found = {}
    for unit in units:
        entry = commands[str(src / unit)]
        if "/Unity/" not in entry["file"]:
            found[unit] = (entry, overlay / unit if (overlay / unit).exists() else src / unit)
        elif entry["file"] not in found:
            text = pathlib.Path(entry["file"]).read_text()
            for file in overlay.rglob("*.cpp"):
                text = text.replace(f'"{src / file.relative_to(overlay)}"', f'"{file}"')
            source = overlay.parent / pathlib.Path(entry["file"]).name
            source.write_text(text)
            found[entry["file"]] = (entry, source)
    return list(found.values())


def compile_command(entry, overlay, source, output):
    words = shlex.split(entry["command"])
    kept, skip = [], False
    for word in words[1:]:
        if skip or word in ("-o", "-MF", "-MT", "-MQ", "-c"):
            skip = not skip and word != "-c"
            continue
        if word in ("-MD", "-MMD") or re.fullmatch(r"-O\w|-g\w*", word) or word == entry["file"] or word.endswith((".cpp", ".cxx", ".o")):
            continue
        kept.append(word)
    compiler = words[0]
    if compiler.endswith("ccache"):
        kept.insert(0, kept.pop(0))
    return [compiler, *kept[:1], f"-I{overlay}", *kept[1:], "-O1", "-w", "-c", str(source), "-o", str(output)], entry["directory"]


def link_command(build):
    """(words before -o, words after its file) by which the probe itself is linked: whatever libraries it needs are in them."""
    done = subprocess.run(["ninja", "-t", "commands", "-s", "tests/mutants/mutant_probe"], cwd=build, capture_output=True, text=True, check=True)
    words = [word for word in shlex.split(done.stdout) if word not in (":", "&&")]
    at = words.index("-o")
    return words[:at], words[at + 2:]


def check(arguments, commands, mutant):
    name = mutant["mutant"].split(":")[0]
    src = arguments.source / "src"
    with tempfile.TemporaryDirectory(prefix="mutant_") as folder:
        overlay = pathlib.Path(folder) / "src"
        target = overlay / mutant["file"]
        target.parent.mkdir(parents=True)
        target.write_text(mutated((src / mutant["file"]).read_text(), mutant))
        objects, units = [], units_of(arguments.users, mutant["file"])
        if not units:
            return name, "NOT COMPILED", f"no file of ROOMS or FILES sees src/{mutant['file']}"
        for entry, source in to_compile(commands, src, overlay, units):
            objects.append(pathlib.Path(folder) / f"{len(objects)}.o")
            command, directory = compile_command(entry, overlay, source, objects[-1])
            done = subprocess.run(command, cwd=directory, capture_output=True, text=True)
            if done.returncode != 0:
                return name, "DOES NOT COMPILE", done.stderr[:2000]
        probe = pathlib.Path(folder) / "probe"
        before, after = arguments.link
        done = subprocess.run([str(word) for word in (*before, *objects, "-o", probe, *after)], cwd=arguments.build, capture_output=True, text=True)
        if done.returncode != 0:
            return name, "DOES NOT LINK", done.stderr[:2000]
        try:
            done = subprocess.run([probe], capture_output=True, text=True, timeout=300)
        except subprocess.TimeoutExpired:
            return name, "caught", "does not end"
        if done.returncode == 0:
            return name, "SURVIVED", mutant["mutant"]
        return name, "caught", (done.stdout + done.stderr).splitlines()[0] if done.stdout + done.stderr else f"exit {done.returncode}"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--source", type=pathlib.Path, required=True)
    parser.add_argument("--build", type=pathlib.Path, required=True, help="folder of build.ninja and compile_commands.json")
    parser.add_argument("--only", help="names that contain this")
    arguments = parser.parse_args()
    arguments.link = link_command(arguments.build)
    arguments.users = users(included(tree_files(arguments.source, ["src"])))
    commands = commands_of(arguments.build)
    mutants = [m for m in parse(arguments.source / "tests/mutants/mutants.txt") if not arguments.only or arguments.only in m["mutant"]]
    bad = 0
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        jobs = [pool.submit(check, arguments, commands, mutant) for mutant in mutants]
        for mutant, job in zip(mutants, jobs):
            try:
                name, verdict, detail = job.result()
            except RuntimeError as error:
                name, verdict, detail = mutant["mutant"].split(":")[0], "STALE", str(error)
            bad += verdict != "caught"
            print(f"{verdict:10} {name}: {detail}", flush=True)
    print(f"{len(mutants) - bad} of {len(mutants)} mutants caught")
    return 1 if bad or len(mutants) == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
