"""Does --memory hold? Builds stores of volumes of all kinds (kinds.py), sizes and budgets, and looks at the peak of resident memory.

    make memory        # sizes 64, 96, 128; budgets 80, 112, 160 MiB; writes build/bench/memory.json and docs/memory.md

A cell holds when the peak is at most the budget + 10 %, or the build is refused (exit code 5) before it begins and holds with the budget
that the refusal names.
"""
import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

import kinds

MIB = 1 << 20
ROOM = 1.1


def run(command):
    """Exit code, output, peak resident memory in bytes and processor seconds of a program."""
    with tempfile.TemporaryFile("w+") as output, tempfile.TemporaryFile("w+") as errors:
        child = subprocess.Popen(list(map(str, command)), stdout=output, stderr=errors)
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        output.seek(0), errors.seek(0)
        return child.returncode, output.read(), errors.read(), usage.ru_maxrss * 1024, usage.ru_utime + usage.ru_stime


def named_budget(message):
    """MiB that a refusal asks for."""
    found = re.search(r"(\d+) MiB or more", message)
    return int(found.group(1)) if found else None


class Matrix:
    def __init__(self, cli, folder, say=lambda text: None):
        self.cli, self.folder, self.say = cli, pathlib.Path(folder), say

    def build(self, volume, kind, budget):
        store = self.folder / "store.atlas"
        store.unlink(missing_ok=True)
        options = kinds.OPTIONS.get(kind, [])
        return run([self.cli, "build", volume, "-o", store, "--memory", f"{budget}M", "--json", *options])

    def cell(self, volume, kind, n, budget):
        """What happens to a volume with a budget in MiB."""
        code, _, errors, peak, seconds = self.build(volume, kind, budget)
        result = {"kind": kind, "size": n, "budget": budget, "code": code, "peak": round(peak / MIB, 1), "seconds": round(seconds, 2)}
        used = budget
        if code == 5 and named_budget(errors):
            used = result["named"] = named_budget(errors)
            result["refused_peak"] = result["peak"]
            code, _, errors, peak, seconds = self.build(volume, kind, used)
            result |= {"peak": round(peak / MIB, 1), "seconds": round(seconds, 2)}
        result["holds"] = code == 0 and peak <= ROOM * used * MIB
        if code != 0:
            result["error"] = errors.strip()
        self.say(f"{'holds' if result['holds'] else 'FAILS'}  {kind:34} {n:4} {budget:5} MiB  peak {result['peak']:7}"
                 f"{'  named ' + str(used) if used != budget else ''}  {result['seconds']} s {result.get('error', '')}")
        return result

    def volume(self, kind, n, budgets):
        path = kinds.write(kind, n, self.folder)
        cells = [self.cell(path, kind, n, budget) for budget in budgets]
        path.unlink()
        return cells


def processor():
    for line in open("/proc/cpuinfo"):
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return "unknown"


def write_page(page, report):
    """The table of a page, between its two marks."""
    columns = sorted({(cell["size"], cell["budget"]) for cell in report["cells"]})
    text = f"{report['processor']}, {report['processors']} processors, {report['date']}.\n\n"
    text += "| volume | " + " | ".join(f"{n}³, {budget}" for n, budget in columns) + " |\n|---" + "|---" * len(columns) + "|\n"
    for kind in dict.fromkeys(cell["kind"] for cell in report["cells"]):
        found = {(cell["size"], cell["budget"]): cell for cell in report["cells"] if cell["kind"] == kind}

        def shown(column):
            cell = found.get(column)
            if not cell:
                return ""
            named = f" (asked for {cell['named']})" if "named" in cell else ""
            return f"{cell['peak']:.0f}{named}" + ("" if cell["holds"] else " **over**" if cell["code"] == 0 else " **failed**")

        text += f"| {kind} | " + " | ".join(shown(column) for column in columns) + " |\n"
    begin, end = "<!-- memory:begin -->\n", "<!-- memory:end -->"
    old = page.read_text()
    page.write_text(old[:old.index(begin) + len(begin)] + text + old[old.index(end):])


def main():
    numbers = lambda text: [int(word) for word in text.split(",")]
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cli")
    parser.add_argument("--sizes", type=numbers, default=[64, 96, 128])
    parser.add_argument("--budgets", type=numbers, default=[80, 112, 160], help="MiB")
    parser.add_argument("--kinds", default="", help="those whose name has this in it")
    parser.add_argument("--folder", default=None, help="for volumes and stores")
    parser.add_argument("-o", dest="output", help="JSON")
    parser.add_argument("--page", help="whose table is written")
    chosen = parser.parse_args()
    cells = []
    with tempfile.TemporaryDirectory(prefix="isoatlas-memory-", dir=chosen.folder) as folder:
        matrix = Matrix(chosen.cli, folder, lambda text: print(text, flush=True))
        for kind in [name for name in kinds.KINDS if chosen.kinds in name]:
            for n in chosen.sizes:
                cells += matrix.volume(kind, n, chosen.budgets)
    failed = [cell for cell in cells if not cell["holds"]]
    print(f"{len(cells)} cells, {len(failed)} fail")
    report = {"processor": processor(), "processors": os.cpu_count(), "date": time.strftime("%Y-%m-%d"), "cells": cells}
    if chosen.page:
        write_page(pathlib.Path(chosen.page), report)
    if chosen.output:
        pathlib.Path(chosen.output).write_text(json.dumps(report, indent=1) + "\n")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
