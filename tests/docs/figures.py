"""The figures of docs/methods.md are those that `make figures` makes.

    figures.py check ROOT ISOATLAS   prints one line per finding, exits 1 when there is one
    figures.py self-test             breaks a small page in many ways and fails when one of them is not found

Every figure that scripts/figures makes is shown once, lies in docs/images/methods, and nothing else does; one whose name has a number of
the dissertation has it in its caption, and the page names the command. Drawings are made again and are the same bytes. Pictures are not:
how they are written depends on the version of a library.
"""
import pathlib
import re
import subprocess
import sys
import tempfile

PYTHON = "/usr/bin/python3"   # the one that Debian's packages are for
FIGURE = re.compile(r"^!\[[^\]]+\]\(images/methods/([\w-]+\.\w+)\)\n((?:.+\n)*)", re.M)
MOST_BYTES = 1_000_000


def findings(text, made, sizes):
    """text: of the page. made: names of the figures. sizes: bytes of the files beside the page, by name."""
    shown = FIGURE.findall(text)
    names = [name for name, _ in shown]
    for name in sorted(set(names) | set(made) | set(sizes)):
        for is_there, missing in ((names.count(name) == 1, f"the page shows it {names.count(name)} times"),
                                  (name in made, "scripts/figures does not make it"), (name in sizes, "there is no such file")):
            if not is_there:
                yield f"{name}: {missing}"
    for name, caption in shown:
        number = re.match(r"figure-(\d+)-(\d+)\.", name)
        if not caption or (number and not caption.startswith(f"Figure {number[1]}.{number[2]}: ")):
            yield f"{name}: its caption does not say what it is"
    if "`make figures`" not in text:
        yield "the page does not name make figures"
    if sum(sizes.values()) > MOST_BYTES:
        yield f"all figures together have {sum(sizes.values())} bytes"


def check(root, program):
    root = pathlib.Path(root)
    folder = root / "docs/images/methods"
    script = [PYTHON, "-B", root / "scripts/figures"]
    made = subprocess.run([*script, "--list"], capture_output=True, text=True, check=True).stdout.split()
    found = list(findings((root / "docs/methods.md").read_text(), made, {file.name: file.stat().st_size for file in folder.iterdir()}))
    if not re.search(r"^figures:.*\n\t.*scripts/figures .*docs/images/methods$", (root / "Makefile").read_text(), re.M):
        found.append("make figures does not make them")
    with tempfile.TemporaryDirectory(prefix="isoatlas-figures-") as again:
        subprocess.run([*script, "--drawings", program, again], check=True, capture_output=True)
        drawings = sorted(pathlib.Path(again).iterdir())
        found += [f"{file.name}: make figures makes another one" for file in drawings
                  if not (folder / file.name).exists() or file.read_bytes() != (folder / file.name).read_bytes()]
    print("\n".join(found) or f"{len(made)} figures, {len(drawings)} of them made again")
    return bool(found) or not drawings


def self_test():
    page = "`make figures`\n\n![A tree](images/methods/figure-3-8.svg)\nFigure 3.8: a tree.\n\n![A cell](images/methods/cell.webp)\nA cell.\n"
    made, sizes = ["figure-3-8.svg", "cell.webp"], {"figure-3-8.svg": 10, "cell.webp": 20}
    if list(findings(page, made, sizes)):
        raise SystemExit("a good page has findings")
    bad = [(page.replace("make", "do"), made, sizes), (page.replace("3.8:", "3.9:"), made, sizes), (page.replace("\nA cell.", ""), made, sizes),
           (page, made[:1], sizes), (page, made, {"cell.webp": 20}), (page, made + ["more.svg"], {**sizes, "more.svg": 1}),
           (page, made, {**sizes, "old.svg": 1}), (page + page, made, sizes), (page, made, {**sizes, "cell.webp": MOST_BYTES})]
    for case in bad:
        if not list(findings(*case)):
            raise SystemExit(f"nothing noticed in {case}")


if __name__ == "__main__":
    sys.exit(self_test() if sys.argv[1] == "self-test" else check(*sys.argv[2:]))
