"""Tests of the Python package: against the command line, brute force, and other packages where they are installed."""
import os
import pathlib
import subprocess

import numpy as np
import pytest

import isoatlas

CLI = os.environ.get("ISOATLAS_CLI", "")
SOURCE = pathlib.Path(os.environ.get("ISOATLAS_SOURCE", pathlib.Path(__file__).resolve().parents[2]))


def smooth(shape, seed=1, passes=2):
    """A random float64 array whose neighbours are alike."""
    array = np.random.default_rng(seed).random(shape)
    for _ in range(passes):
        for axis in range(array.ndim):
            array = (np.roll(array, 1, axis) + 2 * array + np.roll(array, -1, axis)) / 4
    return array


@pytest.fixture(scope="session")
def demo():
    """Two balls joined by a neck, one hollow, and a ring: (z, y, x) uint8 or float."""
    return isoatlas.phantom("demo", 64)


@pytest.fixture
def cli(tmp_path):
    """Runs the command line in a folder of its own; returns what it printed."""
    if not CLI:
        pytest.skip("ISOATLAS_CLI does not name the command line")

    def run(*words):
        done = subprocess.run([CLI, *map(str, words)], cwd=tmp_path, capture_output=True, encoding="utf-8")
        assert done.returncode == 0, done.stderr
        return done.stdout

    return run
