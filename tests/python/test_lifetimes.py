"""Who owns what, threads, interrupts, memory, pickles."""
import copy
import gc
import os
import pathlib
import pickle
import resource
import subprocess
import sys
import textwrap
import threading
import time
import weakref

import numpy as np
import pytest

import isoatlas
from conftest import smooth

ROUNDS = int(os.environ.get("ISOATLAS_ROUNDS", "120"))


def test_arrays_outlive_their_atlas():
    array = smooth((20, 21, 22))
    level = float(np.median(array))
    atlas = isoatlas.open(array)
    mesh, labels, tree = atlas.surface(level), atlas.labels(level), atlas.tree
    points, values = mesh.points, tree.value
    expected = points.copy(), labels.copy(), values.copy()
    atlas.close()
    del atlas, mesh, tree, array
    gc.collect()
    _ = [np.ones(1000) for _ in range(1000)]  # whatever was freed is overwritten
    for kept, before in zip((points, labels, values), expected):
        assert np.array_equal(kept, before)


def test_an_atlas_keeps_its_array_and_lets_it_go():
    class Array(np.ndarray):
        """Of which there are weak references."""

    array = smooth((8, 9, 10)).view(Array)
    seen = weakref.ref(array)
    atlas = isoatlas.open(array)
    samples = atlas.volume
    del array
    gc.collect()
    assert seen() is not None or np.isfinite(samples).all()
    before = samples.copy()
    del atlas
    gc.collect()
    assert np.array_equal(samples, before)
    del samples
    gc.collect()
    assert seen() is None


def test_views_are_not_copies():
    mesh = isoatlas.open(smooth((8, 9, 10))).surface(0.5)
    assert np.shares_memory(mesh.points, mesh.points) and np.shares_memory(mesh.triangles, mesh.triangles)
    assert mesh.points.dtype == np.float64 and mesh.triangles.dtype == np.int64 and mesh.normals.dtype == np.float32


def resident():
    return int(pathlib.Path("/proc/self/statm").read_text().split()[1]) * resource.getpagesize()


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="there is no /proc")
def test_rounds_of_opening_and_extracting_do_not_grow():
    array = np.float32(smooth((16, 16, 16)))
    level = float(np.median(array))

    def round_trip():
        atlas = isoatlas.open(array)
        mesh, labels = atlas.surface(level), atlas.labels(level)
        pairs, table = atlas.persistence(), atlas.objects
        with pytest.raises(isoatlas.NotFoundError):
            atlas.surface(2.0)
        return len(mesh.points) + labels.size + len(pairs) + len(table)

    for _ in range(ROUNDS // 3):
        round_trip()
    gc.collect()
    before = resident()
    for _ in range(ROUNDS):
        round_trip()
    gc.collect()
    assert resident() - before < 4e6 + 200 * ROUNDS


def test_eight_threads_at_once():
    array = np.float32(smooth((24, 25, 26)))
    level = float(np.median(array))
    shared = isoatlas.open(array)
    alone = isoatlas.open(array)
    expected = alone.surface(level).points, alone.labels(level), alone.tree.value, [one.id for one in alone.objects]
    wrong = []

    def work(own):
        atlas = isoatlas.open(array) if own else shared
        for _ in range(3):
            got = atlas.surface(level).points, atlas.labels(level), atlas.tree.value, [one.id for one in atlas.find_objects()]
            if not all(np.array_equal(a, b) for a, b in zip(got, expected)):
                wrong.append(own)

    threads = [threading.Thread(target=work, args=(i % 2,)) for i in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


def test_the_interpreter_runs_meanwhile():
    array = np.float32(smooth((60, 60, 60), passes=0))
    ticks, done = [], threading.Event()

    def count():
        while not done.is_set():
            ticks.append(None)
            time.sleep(0)

    thread = threading.Thread(target=count)
    thread.start()
    isoatlas.open(array).tree
    done.set()
    thread.join()
    assert len(ticks) > 20


LONG = {
    "objects": "atlas.objects",
    "tree": "atlas.tree",
    "cavities": "atlas.cavities",
    "zones": "atlas.zones()",
    "persistence": "atlas.persistence(1)",
    "verify": "atlas.verify(levels=100)",
    "spectrum": "atlas.spectrum(1000)",
    "labels": "[atlas.labels(level) for level in levels]",
    "surface": "[atlas.surface(level) for level in levels]",
    "build": "isoatlas.build(array, path)",
}


@pytest.mark.parametrize("call", LONG)
def test_control_c_stops_every_long_call(call, tmp_path):
    """As a child, so that nothing else is interrupted: it says when it is in the call, and how long the interrupt took."""
    program = textwrap.dedent(f"""
        import os, signal, sys, threading, time
        import numpy as np, isoatlas
        array = np.random.default_rng(1).random((150, 150, 150), dtype=np.float32)
        atlas, levels, path = isoatlas.open(array), np.linspace(0.2, 0.8, 1000), sys.argv[1]
        sent = []
        def interrupt():
            time.sleep(0.7)
            sent.append(time.perf_counter())
            os.kill(os.getpid(), signal.SIGINT)
        threading.Thread(target=interrupt, daemon=True).start()
        try:
            {LONG[call]}
        except KeyboardInterrupt:
            print(time.perf_counter() - sent[0])
        else:
            print("finished")
    """)
    done = subprocess.run([sys.executable, "-c", program, tmp_path / "v.atlas"], capture_output=True, text=True,
                          env=dict(os.environ, PYTHONPATH=os.pathsep.join(sys.path)))
    assert done.returncode == 0, done.stderr
    assert done.stdout.strip() != "finished", "the call was too short to be interrupted"
    assert float(done.stdout) < 2  # a tenth of a second, on a machine that does nothing else
    assert not (tmp_path / "v.atlas").exists()


def test_a_build_waits_for_the_interrupted_one(tmp_path):
    """Which may still hold the store for a moment."""
    program = textwrap.dedent("""
        import os, signal, sys, threading, time
        import numpy as np, isoatlas
        array, path = np.random.default_rng(1).random((120, 120, 120), dtype=np.float32), sys.argv[1]
        interrupts = 0
        for _ in range(5):
            begun = threading.Event()
            def interrupt():
                begun.wait()
                os.kill(os.getpid(), signal.SIGINT)
            thread = threading.Thread(target=interrupt, daemon=True)
            thread.start()
            try:
                isoatlas.build(array, path, restart=True, progress=lambda phase, part: begun.set())
                thread.join()
            except KeyboardInterrupt:
                interrupts += 1
        isoatlas.build(array[:20, :20, :20], path, restart=True)
        print(interrupts, isoatlas.open(path).shape)
    """)
    done = subprocess.run([sys.executable, "-c", program, tmp_path / "v.atlas"], capture_output=True, text=True,
                          env=dict(os.environ, PYTHONPATH=os.pathsep.join(sys.path)))
    assert done.returncode == 0, done.stderr
    assert done.stdout == "5 (20, 20, 20)\n"


def test_progress_comes_through_and_may_raise():
    array = np.float32(smooth((40, 40, 40), passes=0))
    seen = []
    isoatlas.open(array).labels(progress=lambda phase, part: seen.append((phase, part)))
    isoatlas.open(array).find_objects(progress=lambda phase, part: seen.append((phase, part)))
    assert seen and all(isinstance(phase, str) and 0 <= part <= 1 for phase, part in seen)

    def stop(phase, part):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        isoatlas.open(array).find_objects(progress=stop)


def test_a_reader_that_raises_stops_a_build(tmp_path):
    class Broken:
        shape, dtype, ndim = (9, 9, 9), np.dtype("f4"), 3

        def __getitem__(self, index):
            raise OSError("the disk is gone")

    with pytest.raises(OSError, match="the disk is gone"):
        isoatlas.build(Broken(), tmp_path / "v.atlas")
    assert not (tmp_path / "v.atlas").exists()

    class Wrong(Broken):
        def __getitem__(self, index):
            return np.zeros((1, 2, 3), np.float32)

    with pytest.raises(isoatlas.InputError, match="slices"):
        isoatlas.build(Wrong(), tmp_path / "v.atlas")


def test_pickle_and_copy(tmp_path):
    array = smooth((8, 9, 10))
    isoatlas.build(array, tmp_path / "v.atlas", spacing=2)
    isoatlas.write(tmp_path / "v.nrrd", array, spacing=2)
    for source in array, tmp_path / "v.atlas", tmp_path / "v.nrrd":
        atlas = isoatlas.open(source, **({"spacing": 2} if source is array else {}))
        assert copy.copy(atlas).objects[0].id == atlas.objects[0].id
        pickled = pickle.dumps(atlas)
        assert source is array or len(pickled) < 2000
        back = pickle.loads(pickled)
        assert np.array_equal(back.volume, array) and back.spacing == (2, 2, 2)
        mesh = atlas.surface(0.5)
        for other in pickle.loads(pickle.dumps(mesh)), copy.copy(mesh), copy.deepcopy(mesh):
            assert np.array_equal(other.points, mesh.points) and np.array_equal(other.triangles, mesh.triangles)
            assert np.array_equal(other.normals, mesh.normals) and other.tau == mesh.tau and repr(other) == repr(mesh)


def test_a_temporary_store_ends_with_its_atlas():
    atlas = isoatlas.open(smooth((12, 13, 14)), memory="200M")
    path = pathlib.Path(atlas.info["path"])
    assert atlas.is_store and path.exists() and len(atlas.objects)
    atlas.close()
    assert not path.exists()


def test_the_import_is_light():
    program = "import sys, isoatlas; print(isoatlas._core.__file__); print(any('embree' in line for line in open('/proc/self/maps')))"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True,
                          env=dict(os.environ, PYTHONPATH=os.pathsep.join(sys.path)))
    assert done.stdout.splitlines()[1] == "False"
