#!/usr/bin/env python3
"""Fails when code has changed much since its table in docs/performance.md was measured: stale_tables.py; stale_tables.py --self-test.

A table is stale when more than MOST commits since its own touch the code that it measures. `make bench` measures all of them again."""
import pathlib
import re
import subprocess
import sys

MOST = 20
ROOT = pathlib.Path(__file__).resolve().parent.parent
ENGINE = "src/field src/critical src/tree src/zones src/analysis src/persistence".split()
SURFACES = "src/field src/levelset src/mesh".split()
STORES = SURFACES + "src/codec src/bricks src/census src/store src/atlas".split()
MEASURED = {
    "engine": ENGINE, "phases": ENGINE, "growth": ENGINE, "extract": SURFACES,
    "store-builds": STORES + ENGINE, "store-surfaces": STORES, "store-objects": STORES,
    "render": ["src/render"], "pages": "src/catalogue src/page src/preview src/render".split(),
}
TABLE = re.compile(r"<!-- ([\w-]+):begin -->\n(.*?)<!-- \1:end -->", re.S)


def commits_of(page):
    """{mark: commit or None}"""
    found = {}
    for mark, text in TABLE.findall(page):
        if mark in MEASURED:
            commit = re.search(r"\bcommit ([0-9a-f]{8,40})\b", text)
            found[mark] = commit and commit[1]
    return found


def newer(commit, paths):
    """How many commits since; None: this clone does not have that commit."""
    done = subprocess.run(["git", "-C", str(ROOT), "rev-list", "--count", f"{commit}..HEAD", "--", *paths], capture_output=True, text=True)
    return int(done.stdout) if done.returncode == 0 else None


def problems(found, count):
    said = [f"the table {mark} says no commit" for mark, commit in found.items() if commit is None]
    for mark, commit in found.items():
        if commit and (number := count(commit, MEASURED[mark])) is not None and number > MOST:
            said.append(f"the table {mark} is of {commit}: {number} commits since then touch what it measures (at most {MOST})")
    return said


def self_test():
    page = ("<!-- engine:begin -->\nA, commit 01234567.\n\n| x |\n<!-- engine:end -->\n<!-- render:begin -->\n| x |\n<!-- render:end -->\n"
            "<!-- other:begin -->\n<!-- other:end -->\n")
    found = commits_of(page)
    assert found == {"engine": "01234567", "render": None}, found
    assert problems(found, lambda *_: 20) == ["the table render says no commit"]
    assert len(problems(found, lambda *_: 21)) == 2
    assert len(problems({"engine": "01234567"}, lambda *_: None)) == 0


def main():
    if sys.argv[1:] == ["--self-test"]:
        self_test()
        return
    found = commits_of((ROOT / "docs/performance.md").read_text())
    missing = sorted(set(MEASURED) - set(found))
    if missing:
        sys.exit(f"docs/performance.md has no table {', '.join(missing)}")
    if any(commit and newer(commit, []) is None for commit in found.values()):
        print("SKIPPED: this clone does not have the commits of the tables")
    if said := problems(found, newer):
        sys.exit("\n".join(said) + "\nNext: make bench, on a quiet machine.")


main()
