#!/usr/bin/env python3
"""Prints how many headers of this repository the files of each room include: python3 scripts/include_depth.py [COMMIT] [ROOM<=DEPTH ...]

For each room of src/: files, mean and largest number of headers that a file includes, directly or through others, and the depth: the longest
chain of includes. With COMMIT, of that commit instead of the working tree. With ROOM<=DEPTH, fails when the room is deeper."""
import sys
from pathlib import Path

from includes import commit_files, included, tree_files


def chains(graph):
    """path -> (all headers that it includes, length of the longest chain). The includes have no circle, and are not deep."""
    known = {}

    def visit(path):
        if path not in known:
            below = [visit(next_path) for next_path in graph[path]]
            headers = set(graph[path]).union(*(headers for headers, _ in below))
            known[path] = headers, 1 + max((length for _, length in below), default=-1)
        return known[path]
    for path in graph:
        visit(path)
    return known


def rooms(files):
    """room -> (files, mean number of headers, largest number, longest chain)."""
    of_room = {}
    for path, (headers, chain) in chains(included(files)).items():
        if path.startswith("src/"):
            of_room.setdefault(path[4:].rsplit("/", 1)[0], []).append((len(headers), chain))
    return {room: (len(numbers), sum(n for n, _ in numbers) / len(numbers), max(n for n, _ in numbers), max(c for _, c in numbers))
            for room, numbers in sorted(of_room.items())}


def main(arguments):
    root = Path(__file__).resolve().parent.parent
    limits = dict(argument.split("<=") for argument in arguments if "<=" in argument)
    commits = [argument for argument in arguments if "<=" not in argument]
    found = rooms(commit_files(root, commits[0]) if commits else tree_files(root))
    print(f"{'room':16} {'files':>5} {'mean':>6} {'max':>4} {'depth':>5}")
    for room, (count, mean, largest, depth) in found.items():
        print(f"{room:16} {count:5} {mean:6.1f} {largest:4} {depth:5}")
    wrong = [f"{room}: deeper than {limit}, or not a room" for room, limit in limits.items() if room not in found or found[room][3] > int(limit)]
    print("\n".join(wrong), end="\n" if wrong else "")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
