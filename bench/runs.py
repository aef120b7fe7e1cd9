"""Runs of our benchmark programs, and the volumes and threads that all of them measure."""
import json
import os
import statistics
import subprocess
import sys

FIELDS = ["smooth-256", "noisy-256", "white-256"]
REAL = ["bonsai", "engine", "headsq", "seg3d_mr", "emd3001", "frog_labels"]  # CT three times, MR, electron microscopy, labels
PHANTOM = {"smooth": ["random-field"], "noisy": ["random-field", "--noise", "0.02"], "white": ["noise"]}  # as bench/common/volumes.cpp


def ours(program, *arguments):
    """What a benchmark program prints, as JSON."""
    done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stderr)
    return json.loads(done.stdout)


def sources(arguments):
    """The options of a benchmark program that say where volumes are."""
    return ["--cache", arguments.cache] + (["--data", arguments.data] if arguments.data else [])


def thread_counts():
    return sorted({1, 2, len(os.sched_getaffinity(0))})


def times_faster(own, theirs):
    """Their time in ours, median over the pairs."""
    return statistics.median(b / a for a, b in zip(own, theirs))


def add_options(parser, volumes, pairs):
    """The options that the comparisons share."""
    parser.add_argument("program")
    parser.add_argument("--volumes", nargs="+", help=f"default: {' '.join(volumes)}; the real ones where --data is given")
    parser.add_argument("--data", help="folder with NAME/NAME.nrrd")
    parser.add_argument("--pairs", type=int, default=pairs, help="runs of both, in turns")
    parser.add_argument("--cache", default="build/bench/volumes", help="folder for samples and stores")
    parser.add_argument("--json")


def chosen(arguments, volumes):
    """The names of the volumes to measure; the folder of the cache is there."""
    os.makedirs(arguments.cache, exist_ok=True)
    arguments.program = os.path.abspath(arguments.program)
    return arguments.volumes or [name for name in volumes if arguments.data or is_field(name)]


def is_field(name):
    return name.split("-")[0] in PHANTOM


def file_of(name, isoatlas, arguments):
    """The file of a volume, for the command line; fields are made."""
    if not is_field(name):
        return os.path.abspath(os.path.join(arguments.data, name, name + ".nrrd"))
    path = os.path.abspath(os.path.join(arguments.cache, name + ".nrrd"))
    if not os.path.exists(path):
        kind, size = name.split("-")
        subprocess.run([isoatlas, "phantom", *PHANTOM[kind], "--size", size, "--seed", "1", "-o", path, "--quiet"], check=True,
                       stdout=subprocess.DEVNULL)
    return path
