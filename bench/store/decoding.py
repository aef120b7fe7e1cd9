#!/usr/bin/env python3
"""Bricks of stores: samples decoded a second, on one thread, beside copying the same samples.

    decoding.py BENCH_STORE [--volumes smooth-256 ...] [--pairs 15] [--cache FOLDER] [--data FOLDER] [--json FILE]

Processor time, in turns, medians. Bricks are those of a store of the volume; constant ones, which need no decoding, do not count, and of
large volumes every n-th is taken. "Coded": without those that the store keeps as they are, because coding hardly shortens them.
"""
import argparse
import json
import statistics
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from runs import FIELDS, REAL, add_options, chosen, ours, sources

VOLUMES = [*FIELDS, "u8-256", "pet", *REAL]


def per_second(sizes, seconds):
    """GB a second, the median."""
    return sizes / statistics.median(seconds) / 1e9


def record_of(volume, found):
    coded = found["coded_bricks"] > 0
    decoded, copied = per_second(found["sample_bytes"], found["seconds"]), per_second(found["sample_bytes"], found["copy_seconds"])
    return {"volume": volume, "type": found["type"], "bricks": found["bricks"], "coded, %": 100 * found["coded_bricks"] / found["bricks"],
            "bytes / raw": found["packed_bytes"] / found["sample_bytes"], "decoded, GB/s": decoded,
            "coded ones, GB/s": per_second(found["coded_sample_bytes"], found["coded_seconds"]) if coded else "", "copied, GB/s": copied}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_options(parser, VOLUMES, pairs=15)
    arguments = parser.parse_args()
    document = {"pairs": arguments.pairs, "decoding": []}
    for volume in chosen(arguments, VOLUMES):
        found = ours(arguments.program, "decode", volume, *sources(arguments), "--repeats", arguments.pairs)
        document["decoding"].append(record_of(volume, found))
        print(document["decoding"][-1], flush=True)
    if arguments.json:
        Path(arguments.json).write_text(json.dumps(document, indent=1))


if __name__ == "__main__":
    main()
