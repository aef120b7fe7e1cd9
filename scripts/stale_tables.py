#!/usr/bin/env python3
"""Fails when code has changed much since its table in docs/performance.md was measured: stale_tables.py; stale_tables.py --self-test.

A table is stale when more than MOST commits since its own touch the code that it measures. It must have a row for every kind of volume;
that there is one processor alone is only said. `make bench` measures the tables of this processor again; stale ones of another are
measured there, or deleted."""
import pathlib
import re
import subprocess
import sys

MOST = 20
ROOT = pathlib.Path(__file__).resolve().parent.parent
ENGINE = "src/field src/critical src/tree src/zones src/analysis src/persistence".split()
SURFACES = "src/field src/levelset src/mesh".split()
STORES = SURFACES + "src/codec src/bricks src/census src/store src/atlas".split()
BUILDS = STORES + ENGINE + ["src/features"]
PICTURES, PAGES = ["src/render"], "src/features src/catalogue src/page src/preview src/render".split()
MEASURED = {
    "engine": ENGINE, "phases": ENGINE, "scale-analysis": ENGINE, "extract": SURFACES, "scale-extract": SURFACES,
    "store-builds": BUILDS, "store-phases": BUILDS, "store-surfaces": STORES, "store-objects": STORES, "scale-stores": BUILDS, "store-decoding": ["src/codec"], "fronts": STORES + ["src/octree_front"],
    "simplify": SURFACES + ["src/level_of_detail"],
    "render": PICTURES, "scale-render": PICTURES, "pages": PAGES, "scale-pages": PAGES,
    "formats": ["src/formats/volume", "src/formats/zarr", "src/formats/common"], "python-surfaces": ["python"], "python-facts": ["python"],
    "methods": ["src/methods/search", "src/methods/disk"],
}
ROWS = {  # of the tables that list volumes
    "smooth": "smooth-", "noisy": "noisy-", "white": "white-", "CT": "bonsai", "MR": "seg3d_mr", "EM": "emd3001", "labels": "frog_labels",
}
LISTS = "engine phases extract store-builds store-phases store-decoding store-surfaces store-objects render pages python-surfaces".split()
TABLE = re.compile(r"<!-- ([\w-]+):begin -->\n(.*?)<!-- \1:end -->", re.S)


def commits_of(page):
    """{mark: the commits of its tables, one for each processor}"""
    return {mark: re.findall(r"^\S.*, commit ([0-9a-f]{8,40})\.$", text, re.M) for mark, text in TABLE.findall(page) if mark in MEASURED}


def newer(commit, paths):
    """How many commits since; None: this clone does not have that commit."""
    done = subprocess.run(["git", "-C", str(ROOT), "rev-list", "--count", f"{commit}..HEAD", "--", *paths], capture_output=True, text=True)
    return int(done.stdout) if done.returncode == 0 else None


def problems(found, count):
    said = [f"the table {mark} says no commit" for mark, commits in found.items() if not commits]
    for mark, commits in found.items():
        for commit in commits:
            if (number := count(commit, MEASURED[mark])) is not None and number > MOST:
                said.append(f"the table {mark} is of {commit}: {number} commits since then touch what it measures (at most {MOST})")
    return said


def without_rows(page):
    """Kinds of volumes that a table does not have."""
    said = []
    for mark, text in TABLE.findall(page):
        lacks = [kind for kind, name in ROWS.items() if mark in LISTS and f"\n| {name}" not in text]
        if lacks:
            said.append(f"the table {mark} has no row of: {', '.join(lacks)}")
    return said


def self_test():
    page = ("<!-- engine:begin -->\nA, commit 01234567.\n\n| x |\n\nB, commit 89abcdef.\n\n| y |\n<!-- engine:end -->\n"
            "<!-- render:begin -->\n| x |\n<!-- render:end -->\n<!-- pages:begin -->\n<!-- pages:end -->\n"
            "<!-- other:begin -->\n<!-- other:end -->\n")
    found = commits_of(page)
    assert found == {"engine": ["01234567", "89abcdef"], "render": [], "pages": []}, found
    without = ["the table render says no commit", "the table pages says no commit"]
    assert problems(found, lambda *_: 20) == without
    assert len(problems(found, lambda *_: 21)) == 4
    assert problems(found, lambda commit, _: 21 if commit == "89abcdef" else 0)[2].startswith("the table engine is of 89abcdef")
    assert problems(found, lambda *_: None) == without
    page = "<!-- render:begin -->\n| x |" + "".join(f"\n| {name}" for name in ROWS.values()) + "\n<!-- render:end -->\n"
    assert without_rows(page) == []
    assert without_rows(page.replace("emd3001", "x")) == ["the table render has no row of: EM"]


def main():
    if sys.argv[1:] == ["--self-test"]:
        self_test()
        return
    page = (ROOT / "docs/performance.md").read_text()
    found = commits_of(page)
    missing = sorted(set(MEASURED) - set(found))
    if missing:
        sys.exit(f"docs/performance.md has no table {', '.join(missing)}")
    if any(newer(commit, []) is None for commits in found.values() for commit in commits):
        print("SKIPPED: this clone does not have the commits of the tables")
    if single := [mark for mark, commits in found.items() if len(commits) == 1]:
        print(f"note: measured on one processor: {', '.join(single)}")
    if said := problems(found, newer) + without_rows(page):
        sys.exit("\n".join(said) + "\nNext: make bench, on a quiet machine; a table of another processor can be deleted.")


main()
