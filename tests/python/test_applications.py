"""ParaView and 3D Slicer: the plugin in ParaView itself where it is installed, the module with a stub of Slicer."""
import importlib.util
import json
import os
import shutil
import subprocess
import sys
import types

import numpy as np
import pytest

import isoatlas
from conftest import CLI, SOURCE

# Debian's ParaView 5.11 loads no plugin of Python 3.11, which has no getargspec any more.
PROBE = '''
import inspect, json, sys
inspect.getargspec = getattr(inspect, "getargspec", inspect.getfullargspec)
from paraview import servermanager, simple
simple.LoadPlugin(sys.argv[1], ns=globals())
path, kind = sys.argv[2], sys.argv[3]
options = json.loads(sys.argv[4])
source = isoatlasvolume(FileName=path) if kind == "volume" else isoatlasobjects(**options) if kind == "objects" else isoatlastree(**options)
if kind != "volume":
    source.FileName = path
source.UpdatePipeline()
data = servermanager.Fetch(source)
cells = data.GetCellData()
said = {"class": data.GetClassName(), "points": data.GetNumberOfPoints(), "cells": data.GetNumberOfCells(),
        "arrays": {cells.GetArrayName(i): sorted({cells.GetArray(i).GetTuple1(k) for k in range(cells.GetNumberOfTuples())})
                   for i in range(cells.GetNumberOfArrays())}}
if kind == "volume":
    said["dims"] = data.GetDimensions()
    said["sum"] = sum(data.GetPointData().GetArray(0).GetTuple1(i) for i in range(data.GetNumberOfPoints()))
print("SAID " + json.dumps(said))
'''


@pytest.fixture
def store(demo, tmp_path):
    path = tmp_path / "demo.atlas"
    isoatlas.build(demo[::2, ::2, ::2], path)
    return path


@pytest.fixture(scope="session")
def paraview_missing(tmp_path_factory):
    """Why ParaView cannot be tested here, empty where it can: Debian's python3-vtk9 removes ParaView's modules and leaves its programs."""
    if shutil.which("pvbatch") is None:
        return "paraview is not installed"
    script = tmp_path_factory.mktemp("paraview") / "probe.py"
    script.write_text("import paraview\n")
    clean = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    done = subprocess.run(["pvbatch", "--force-offscreen-rendering", script], capture_output=True, text=True, env=clean)
    return "" if done.returncode == 0 and "Error" not in done.stderr else "pvbatch is installed, python3-paraview is not"


@pytest.fixture
def paraview(tmp_path, paraview_missing):
    if paraview_missing:
        pytest.skip(paraview_missing)
    (tmp_path / "probe.py").write_text(PROBE)

    def run(path, kind, **options):
        plugin = SOURCE / "python" / "paraview" / "isoatlas_paraview.py"
        words = ["pvbatch", "--force-offscreen-rendering", tmp_path / "probe.py", plugin, path, kind, json.dumps(options)]
        clean = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
        done = subprocess.run([str(word) for word in words], capture_output=True, text=True, env={**clean, "ISOATLAS_PROGRAM": CLI})
        found = [line for line in done.stdout.splitlines() if line.startswith("SAID ")]
        assert found, done.stdout + done.stderr
        return json.loads(found[0][5:]), done.stdout + done.stderr

    return run


def test_paraview_reads_a_store_as_an_image(paraview, store):
    said, _ = paraview(store, "volume")
    volume = isoatlas.open(store).volume
    assert said["class"] == "vtkImageData" and said["dims"] == list(volume.shape[::-1])
    assert said["sum"] == float(volume.sum(dtype=np.float64))


def test_paraview_shows_objects_with_their_isovalue_and_genus(paraview, store):
    atlas = isoatlas.open(store)
    said, _ = paraview(store, "objects", Objects="1 2")
    first, second = atlas.objects[:2]
    assert said["class"] == "vtkPolyData" and said["cells"] == len(first.surface()) + len(second.surface())
    assert said["arrays"]["Number"] == [1, 2] and said["arrays"]["Isovalue"] == sorted({first.best_tau, second.best_tau})
    assert said["arrays"]["Genus"] == sorted({first.tunnels, second.tunnels})
    single, _ = paraview(store, "objects", Objects="2")
    assert single["arrays"]["Id"] == [second.id] and single["cells"] == len(second.surface())


def test_paraview_shows_the_tree(paraview, store):
    said, _ = paraview(store, "tree")
    events = len(isoatlas.open(store).tree)
    assert said["class"] == "vtkUnstructuredGrid" and (said["points"], said["cells"]) == (events, events - 1)


def test_paraview_is_told_what_is_wrong(paraview, tmp_path):
    said, printed = paraview(tmp_path / "missing.nrrd", "objects")
    assert said["cells"] == 0 and "missing.nrrd" in printed


@pytest.fixture
def slicer(monkeypatch, tmp_path):
    """The module of Slicer with a stub of what it calls."""
    if not CLI:
        pytest.skip("ISOATLAS_CLI does not name the command line")
    made = {}

    class Node:
        def __init__(self, array):
            self.array, self.calls = array, []

        def GetName(self):
            return "scan"

        def __getattr__(self, name):
            return lambda *words: self.calls.append((name, words))

    def save(node, path, options):
        isoatlas.open(node.array).save(path)
        return True

    def load(path, options):
        made["array"], made["info"] = isoatlas.read(path)
        made["header"] = open(path, "rb").read(20000).split(b"\n\n")[0].decode()
        made["name"] = options["name"]
        return Node(made["array"])

    stub = types.ModuleType("slicer")
    stub.util = types.SimpleNamespace(saveNode=save, loadSegmentation=load, startupEnvironment=lambda: dict(os.environ))
    base = types.ModuleType("slicer.ScriptedLoadableModule")
    for name in ("ScriptedLoadableModule", "ScriptedLoadableModuleLogic", "ScriptedLoadableModuleWidget"):
        setattr(base, name, type(name, (), {}))
    monkeypatch.setitem(sys.modules, "slicer", stub)
    monkeypatch.setitem(sys.modules, "slicer.ScriptedLoadableModule", base)
    spec = importlib.util.spec_from_file_location("Isoatlas", SOURCE / "python" / "slicer" / "Isoatlas.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.IsoatlasLogic(), Node, made


def test_slicer_gets_a_segment_for_each_object(slicer, demo):
    logic, node, made = slicer
    found, said = logic.segment(node(demo), top=3, program=CLI)
    np.testing.assert_array_equal(made["array"], isoatlas.open(demo).labels(keep=3))
    assert "Segment0_Name:=" in made["header"] and "isoatlas.isovalue:" in made["header"] and made["name"] == "scan objects"
    assert len(said["segments"]) == 3 and [call[0] for call in found.calls][-1] == "CreateClosedSurfaceRepresentation"


def test_slicer_is_told_what_is_wrong(slicer, demo):
    logic, node, _ = slicer
    for volume, options, words in ((None, {}, "no volume"), (node(demo), {"polarity": "middle"}, "polarity"),
                                   (node(demo), {"program": "/bin/false"}, "ended with 1")):
        with pytest.raises(RuntimeError, match=words):
            logic.segment(volume, **{"program": CLI, **options})
