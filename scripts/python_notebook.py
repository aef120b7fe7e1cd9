#!/usr/bin/env python3
"""Writes python/isoatlas.ipynb, the lines of README.md as a notebook, with what they print: scripts/python_notebook.py [--check]

The package must be importable: PYTHONPATH=build/dev/python. Needs python3-nbclient and python3-ipykernel (Debian packages). --check: runs
the notebook, says whether its lines and what they print are current, and writes nothing. Pictures are not compared."""
import json
import os
import pathlib
import re
import sys
import tempfile

import nbformat
from nbclient import NotebookClient

ROOT = pathlib.Path(__file__).resolve().parent.parent
NOTEBOOK = ROOT / "python" / "isoatlas.ipynb"
BEFORE = """import isoatlas
isoatlas.write("scan.nii.gz", isoatlas.phantom("demo"), spacing=(0.5, 0.5, 0.5), unit="mm")"""
# The line of README.md after which a cell of its own shows something, and that cell.
SHOWN = {
    "view.selected": "view.selected, view.tau",
    "mesh = ": "mesh",
    "labels = ": "import numpy\nnumpy.bincount(labels.ravel())",
    "graph, pairs = ": "print(graph)\npairs",
    "b0, b1, b2 = ": "b0, b1, b2",
    "points, triangles": "points.shape, triangles.shape",
}


def lines_of_readme():
    text = (ROOT / "README.md").read_text()
    block = re.search(r"## In Python\n+```python\n(.*?)```", text, re.S)[1]
    return [re.sub(r" {2,}#.*", "", line) for line in block.splitlines()]


def notebook():
    cells = [nbformat.v4.new_markdown_cell("# isoatlas\n\nThe lines of the README, on a generated volume: two balls and a neck, a shell, a ring. "
                                           "`atlas.view()` shows the navigator here."),
             nbformat.v4.new_code_cell(BEFORE)]
    for line in lines_of_readme():
        if line == "import isoatlas":
            continue
        cells.append(nbformat.v4.new_code_cell(line))
        cells += [nbformat.v4.new_code_cell(shown) for begin, shown in SHOWN.items() if line.startswith(begin)]
    for i, cell in enumerate(cells):
        cell["id"] = f"cell-{i}"
    return nbformat.v4.new_notebook(cells=cells, metadata={"kernelspec": {"name": "python3", "display_name": "Python 3", "language": "python"},
                                                           "language_info": {"name": "python"}})


def run(book):
    """In a folder of its own, with this interpreter."""
    with tempfile.TemporaryDirectory() as folder:
        kernel = pathlib.Path(folder) / "kernels" / "python3"
        kernel.mkdir(parents=True)
        words = [sys.executable, "-m", "ipykernel_launcher", "-f", "{connection_file}"]
        (kernel / "kernel.json").write_text(json.dumps({"argv": words, "display_name": "Python 3", "language": "python"}))
        os.environ["PYDEVD_DISABLE_FILE_VALIDATION"] = "1"
        os.environ["JUPYTER_PATH"] = os.environ["JUPYTER_DATA_DIR"] = folder
        NotebookClient(book, timeout=300, kernel_name="python3", record_timing=False, resources={"metadata": {"path": folder}}).execute()
    return book


def said(book):
    """Sources and outputs, without pictures."""
    cells = [(cell.source, json.dumps(cell.get("outputs", []), sort_keys=True)) for cell in book.cells]
    return [(source, re.sub(r"data:image/png;base64,[\w+/=]*", "", outputs)) for source, outputs in cells]


def main():
    made = run(notebook())
    if "--check" not in sys.argv:
        nbformat.write(made, NOTEBOOK)
        return
    if said(made) != said(nbformat.read(NOTEBOOK, 4)):
        sys.exit(f"{NOTEBOOK.relative_to(ROOT)} is not current: run scripts/python_notebook.py")


if __name__ == "__main__":
    main()
