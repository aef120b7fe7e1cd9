#!/usr/bin/env python3
"""clang-tidy over src and apps, the warnings of clang included: scripts/lint.py [--most] [--since REVISION] [BUILD_FOLDER], which has the
compile commands; without, build/lint is configured for it. Nothing needs to be built. --most: without the checks of SLOW, which take a third
of the time. --since: only what differs from that revision and what includes that; everything where git does not know the revision.

Most of the time goes into the headers of the standard library, so the files of a folder are read together, as ISOATLAS_UNITY compiles
them: no two of them have a name in both unnamed namespaces."""
import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

from includes import changed_since, included, reached, tree_files

ROOT = pathlib.Path(__file__).resolve().parent.parent
TIDY = "clang-tidy-19"
# Warnings of clang are findings too. Not: what g++ alone knows, get_temporary_buffer in std::stable_sort of libstdc++ 12, and enumerations
# of Boost's headers (below OpenVDB).
WARNINGS = ["-Wno-unknown-warning-option", "-Wno-ignored-optimization-argument", "-Wno-deprecated-declarations",
            "-Wno-enum-constexpr-conversion"]

SLOW = ["performance-unnecessary-value-param"]  # reads the bodies of all functions of all headers
CHECKS = ".clang-tidy"


def groups(commands):
    """(options, files) of files of a folder that are compiled alike, the largest group first."""
    found = collections.defaultdict(set)
    for entry in commands:
        file = pathlib.Path(entry["file"])
        if not file.is_relative_to(ROOT / "src") and not file.is_relative_to(ROOT / "apps"):
            continue
        command = re.sub(r"(-Winvalid-pch )?-include \S+cmake_pch\.hxx", "", entry["command"])  # each file includes what it uses
        words = [word for word in shlex.split(command) if not word.endswith("ccache")][1:]
        output = words.index("-o")
        del words[output:output + 2]
        options = tuple(word for word in words if word not in ("-c", str(file)) and not re.match(r"-[Og]", word))
        found[file.parent, options].add(file)
    for (_, options), files in sorted(found.items(), key=lambda group: -len(group[1])):
        yield options, sorted(files)


def units_to_lint(units, revision):
    changed = changed_since(ROOT, revision) if revision else None
    if changed is None or CHECKS in changed:
        return units
    graph = included(tree_files(ROOT, ["src", "include", "apps"]))
    return [(options, files) for options, files in units
            if reached(graph, [file.relative_to(ROOT).as_posix() for file in files]) & changed]


def lint(options, files, left_out):
    """The findings in these files, as text. left_out: names of checks."""
    without = ",".join(f"-{name}" for name in ["bugprone-suspicious-include", *left_out])
    with tempfile.NamedTemporaryFile("w", suffix=".cpp") as unit:
        unit.writelines(f'#include "{file}"\n' for file in files)
        unit.flush()
        done = subprocess.run([TIDY, "--quiet", f"--config-file={ROOT / '.clang-tidy'}", f"--checks={without}", unit.name,
                               "--", *options, *WARNINGS], capture_output=True, text=True)
    if done.returncode == 0:
        return ""
    return done.stdout or done.stderr


def configured():
    """A build folder with the compile command of every file by itself."""
    build = ROOT / "build" / "lint"
    done = subprocess.run(["cmake", "--preset", "dev", "-B", build, "-DISOATLAS_UNITY=OFF"], cwd=ROOT, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{done.stdout}{done.stderr}lint: configuring failed; the message of cmake is above")
    return build


def count(units):
    return sum(len(files) for _, files in units)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--most", action="store_true")
    parser.add_argument("--since", metavar="REVISION")
    parser.add_argument("build", type=pathlib.Path, nargs="?")
    arguments = parser.parse_args()
    commands = json.loads(((arguments.build or configured()) / "compile_commands.json").read_text())
    all_units = list(groups(commands))
    units = units_to_lint(all_units, arguments.since)
    left_out = SLOW if arguments.most else []
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        findings = [text for text in pool.map(lambda unit: lint(*unit, left_out), units) if text]
    print("".join(findings), end="")
    of_all = f" of {count(all_units)}" if len(units) < len(all_units) else ""
    print(f"lint: {count(units)}{of_all} files, {'findings above' if findings else 'no finding'}")
    if findings:
        sys.exit("lint: the findings are above; each must be mended (or, with a reason, marked NOLINT)")


if __name__ == "__main__":
    main()
