#!/usr/bin/env python3
"""clang-tidy over src and apps, the warnings of clang included: scripts/lint.py [--most] [BUILD_FOLDER], which has the compile commands;
without, build/lint is configured for it. Nothing needs to be built. --most: without the checks of SLOW, which take a third of the time.

Most of the time goes into the headers of the standard library, so the files of a folder are read together, as ISOATLAS_UNITY compiles
them: no two of them have a name in both unnamed namespaces."""
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

ROOT = pathlib.Path(__file__).resolve().parent.parent
TIDY = "clang-tidy-19"
# Warnings of clang are findings too. Not: what g++ alone knows, get_temporary_buffer in std::stable_sort of libstdc++ 12, and enumerations
# of Boost's headers (below OpenVDB).
WARNINGS = ["-Wno-unknown-warning-option", "-Wno-ignored-optimization-argument", "-Wno-deprecated-declarations",
            "-Wno-enum-constexpr-conversion"]

SLOW = ["performance-unnecessary-value-param"]  # reads the bodies of all functions of all headers
MOST = "--most" in sys.argv


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


def lint(options, files):
    """The findings in these files, as text."""
    without = ",".join(f"-{name}" for name in ["bugprone-suspicious-include", *(SLOW if MOST else [])])
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


def main():
    folders = [word for word in sys.argv[1:] if word != "--most"]
    build = pathlib.Path(folders[0]) if folders else configured()
    commands = json.loads((build / "compile_commands.json").read_text())
    units = list(groups(commands))
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        findings = [text for text in pool.map(lambda unit: lint(*unit), units) if text]
    print("".join(findings), end="")
    print(f"lint: {sum(len(files) for _, files in units)} files, {'findings above' if findings else 'no finding'}")
    if findings:
        sys.exit("lint: the findings are above; each must be mended (or, with a reason, marked NOLINT)")


if __name__ == "__main__":
    main()
