#!/usr/bin/env python3
"""What a benchmark ran on, as its JSON document and the head of its table say it.

    machine.py FILE.json...   adds the member "machine" to what a benchmark has just written
"""
import datetime
import json
import os
import platform
import subprocess
import sys
from pathlib import Path

WIDE = {"avx512f", "avx512bw", "avx512dq", "avx512vl", "avx512_vbmi", "avx512_vbmi2"}  # src/base/target_clones.h


def of_processor(name):
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        if line.split(":")[0].strip() == name:
            return line.split(":", 1)[1].strip()
    return ""


def vectors():
    flags = set(of_processor("flags").split())
    widest = "AVX-512" if WIDE <= flags else "AVX2" if {"avx2", "fma"} <= flags else "no AVX2"
    asked = os.environ.get("ISOATLAS_SIMD")
    return f"{widest}, ISOATLAS_SIMD={asked}" if asked else widest


def machine():
    commit = subprocess.run(["git", "rev-parse", "--short=8", "HEAD"], capture_output=True, text=True).stdout.strip()
    return {"processor": of_processor("model name") or platform.machine(), "vectors": vectors(), "processors": os.cpu_count(),
            "date": datetime.date.today().isoformat(), "commit": commit}


def in_words(found):
    """The line above a table; stale_tables.py reads its commit."""
    return "{processor}, {vectors}, {processors} processors, {date}, commit {commit}.".format(**found)


def main():
    for name in sys.argv[1:]:
        path = Path(name)
        document = json.loads(path.read_text())
        document["machine"] = machine()
        path.write_text(json.dumps(document, indent=1) + "\n")


if __name__ == "__main__":
    main()
