"""The reference is current, examples run, types are right, docstrings say what they must."""
import doctest
import importlib.util
import inspect
import os
import pathlib
import subprocess
import sys

import pytest

import isoatlas
from conftest import SOURCE

EXAMPLES = sorted((SOURCE / "python" / "examples").glob("*.py"))
DATA = SOURCE.parent / "shared" / "data"
GALLERY = {"rock": "berea/berea.nrrd", "bones": "headsq/headsq.nrrd", "cells": "nuclei/nuclei.nrrd", "density": "emd3001/emd3001.nrrd",
           "simulation": "heptane/heptane.nrrd"}
ENVIRONMENT = dict(os.environ, PYTHONPATH=os.pathsep.join(sys.path))


def test_the_reference_is_what_the_docstrings_say():
    done = subprocess.run([sys.executable, SOURCE / "scripts" / "python_reference.py", "--check"], capture_output=True, text=True,
                          env=ENVIRONMENT)
    assert done.returncode == 0, done.stderr


def test_the_notebook_runs_and_prints_what_it_shows():
    """The lines of README.md, executed."""
    for package in ("nbclient", "ipykernel", "networkx"):
        if importlib.util.find_spec(package) is None:
            pytest.skip(f"{package} is not installed")
    done = subprocess.run([sys.executable, SOURCE / "scripts" / "python_notebook.py", "--check"], capture_output=True, text=True,
                          env=ENVIRONMENT)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_examples_run(example, tmp_path):
    assert len(example.read_text().splitlines()) <= 25
    needed = [line.split()[1] for line in example.read_text().splitlines() if line.startswith("import ")]
    for package in needed:
        if importlib.util.find_spec(package.split(".")[0]) is None:
            pytest.skip(f"{package} is not installed")
    done = subprocess.run([sys.executable, example], cwd=tmp_path, capture_output=True, text=True, env=ENVIRONMENT)
    assert done.returncode == 0 and done.stdout, done.stderr


@pytest.mark.parametrize("name", GALLERY)
def test_tasks_of_the_gallery_run(name, tmp_path):
    script = SOURCE / "python" / "gallery" / f"{name}.py"
    assert len(script.read_text().splitlines()) <= 25
    if not DATA.exists():
        pytest.skip("../shared/data is not there")
    words = [sys.executable, script, DATA / GALLERY[name], "picture.webp"]
    done = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, env=ENVIRONMENT)
    assert done.returncode == 0 and done.stdout, done.stderr
    assert (tmp_path / "picture.webp").stat().st_size > 5000
    page = (SOURCE / "docs" / "python-gallery.md").read_text()
    assert f"```python\n{script.read_text()}```" in page and f"(images/python/{name}.webp)" in page
    assert f"```\n{done.stdout}```" in page, done.stdout


def test_docstrings_have_what_they_must():
    for name in isoatlas.__all__:
        what = getattr(isoatlas, name)
        assert what.__doc__, name
        for member_name, member in vars(what).items() if inspect.isclass(what) else []:
            function = member.fget if isinstance(member, property) else member
            if not member_name.startswith("_") and inspect.isfunction(function):
                documented = function.__doc__ or member_name in ("points", "triangles", "segments", "normals", "object_ids", "contour_ids",
                                                                 "tau", "closed", "space", "unit", "interpolant", "polarity")
                assert documented, f"{name}.{member_name}"
    assert "(z, y, x)" in isoatlas.open.__doc__.splitlines()[0] and "(x, y, z)" in isoatlas.open.__doc__.splitlines()[0]
    assert not doctest.testmod(sys.modules["isoatlas._functions"]).failed


def test_the_package_and_its_examples_are_typed():
    """The examples import the package, so that both are checked."""
    if importlib.util.find_spec("mypy") is None:
        pytest.skip("python3-mypy is not installed")
    package = pathlib.Path(isoatlas.__file__).parent
    command = [sys.executable, "-m", "mypy", "--strict", "--ignore-missing-imports", "--cache-dir",
               os.environ.get("ISOATLAS_MYPY_CACHE", os.devnull)]
    gallery = sorted((SOURCE / "python" / "gallery").glob("*.py"))
    done = subprocess.run([*command, *EXAMPLES, *gallery], capture_output=True, text=True, env=dict(ENVIRONMENT, MYPYPATH=str(package.parent)))
    assert done.returncode == 0, done.stdout
