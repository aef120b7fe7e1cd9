#!/usr/bin/env python3
"""What a benchmark ran on, as its JSON document and the head of its table say it.

    machine.py FILE.json...   adds the member "machine" to what a benchmark has just written
    machine.py --vectors      the widest vectors of this processor that programs use, whatever ISOATLAS_SIMD says
"""
import datetime
import json
import os
import platform
import re
import subprocess
import sys
from pathlib import Path

# Of kHasAvx512 in src/base/target_clones.h, as Linux spells them: not all have an underscore.
WIDE = {"avx512f", "avx512bw", "avx512dq", "avx512vl", "avx512vbmi", "avx512_vbmi2"}


def of_processor(name):
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        if line.split(":")[0].strip() == name:
            return line.split(":", 1)[1].strip()
    return ""


def widest():
    flags = set(of_processor("flags").split())
    return "AVX-512" if WIDE <= flags else "AVX2" if {"avx2", "fma"} <= flags else "no AVX2"


def vectors():
    asked = os.environ.get("ISOATLAS_SIMD")
    return f"{widest()}, ISOATLAS_SIMD={asked}" if asked else widest()


HEAD = re.compile(r"^(?P<processor>.*), (?P<widest>AVX-512|AVX2|no AVX2)(, ISOATLAS_SIMD=(?P<asked>\w+))?, (?P<count>\d+) processors, [\d-]+, "
                  r"commit [0-9a-f]{8,40}\.$", re.M)


def kind(head):
    """The vectors that were used, of the line above a table."""
    found = HEAD.match(head)
    if found["asked"] == "avx2" and found["widest"] == "AVX-512":
        return "AVX2"
    return "no AVX2" if found["asked"] == "scalar" else found["widest"]


def processor(head):
    """(its name, how many of them)"""
    found = HEAD.match(head)
    return found["processor"], int(found["count"])


def machine():
    commit = subprocess.run(["git", "rev-parse", "--short=8", "HEAD"], capture_output=True, text=True).stdout.strip()
    return {"processor": of_processor("model name") or platform.machine(), "vectors": vectors(), "processors": len(os.sched_getaffinity(0)),
            "date": datetime.date.today().isoformat(), "commit": commit}


def in_words(found):
    """The line above a table; stale_tables.py reads its commit."""
    return "{processor}, {vectors}, {processors} processors, {date}, commit {commit}.".format(**found)


def main():
    if sys.argv[1:] == ["--vectors"]:
        print(widest())
        return
    for name in sys.argv[1:]:
        path = Path(name)
        document = json.loads(path.read_text())
        document["machine"] = machine()
        path.write_text(json.dumps(document, indent=1) + "\n")


if __name__ == "__main__":
    main()
