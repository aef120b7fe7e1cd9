"""VTKHDF files, read by h5py as the specification says (VTK documentation, "VTKHDF file format", 2.0: PolyData and Temporal data)."""
import json
import subprocess
import sys

import numpy as np
import pytest

import isoatlas
from conftest import smooth

h5py = pytest.importorskip("h5py", reason="h5py (package python3-h5py) is not installed")

KINDS = ("Vertices", "Lines", "Polygons", "Strips")
TAUS = (90.0, 120.5, 200.0)


def text(array):
    return [one.decode("utf-8") if isinstance(one, bytes) else one for one in array]


def check_structure(root):
    """What must hold of every file; returns the number of parts: one for each step."""
    assert list(root.attrs["Version"]) == [2, 0]
    kind = root.attrs.get_id("Type")
    assert kind.get_type().get_class() == h5py.h5t.STRING and not kind.get_type().is_variable_str()   # fixed ASCII is what VTK reads
    assert kind.get_type().get_cset() == h5py.h5t.CSET_ASCII and root.attrs["Type"] == b"PolyData"
    points = root["NumberOfPoints"][:]
    assert root["Points"].shape == (points.sum(), 3) and root["Points"].dtype in (np.float32, np.float64)
    for name in KINDS:
        cells, ids, group = root[name]["NumberOfCells"][:], root[name]["NumberOfConnectivityIds"][:], root[name]
        assert len(cells) == len(ids) == len(points)
        assert group["Offsets"].shape == (cells.sum() + len(points),) and group["Connectivity"].shape == (ids.sum(),)
        assert all(group[array].dtype == np.int64 for array in group)
    for name, array in root["PointData"].items():
        assert len(array) == points.sum(), name
    for one in root["FieldData"].values():
        assert one.ndim == 1
        if h5py.check_string_dtype(one.dtype):   # VTK reads variable ASCII, and HDF5 converts no other text into it
            assert h5py.check_string_dtype(one.dtype) == ("ascii", None)
    if "Steps" in root:
        check_steps(root, len(points))
    else:
        assert len(points) == 1
    return len(points)


def check_steps(root, count):
    steps = root["Steps"]
    assert steps.attrs["NSteps"] == count and np.ndim(steps.attrs["NSteps"]) == 0
    assert steps["Values"].dtype == np.float64 and (np.diff(steps["Values"][:]) > 0).all()
    assert list(steps["PartOffsets"]) == list(range(count)) and list(steps["NumberOfParts"]) == [1] * count
    begins = np.concatenate([[0], np.cumsum(root["NumberOfPoints"][:])[:-1]])
    assert (steps["PointOffsets"][:] == begins).all()
    for offsets, counts in (("CellOffsets", "NumberOfCells"), ("ConnectivityIdOffsets", "NumberOfConnectivityIds")):
        assert steps[offsets].shape == (count, len(KINDS))
        for k, name in enumerate(KINDS):
            assert (steps[offsets][:, k] == np.concatenate([[0], np.cumsum(root[name][counts][:])[:-1]])).all()
    assert set(steps["PointDataOffsets"]) == set(root["PointData"])
    assert all((one[:] == begins).all() for one in steps["PointDataOffsets"].values())
    for name, array in root["FieldData"].items():
        if not h5py.check_string_dtype(array.dtype):
            assert steps["FieldDataSizes"][name].shape == (count, 2) and (steps["FieldDataSizes"][name][:] == 1).all()
            assert (steps["FieldDataOffsets"][name][:] < len(array)).all()


def part_of(root, i):
    """Part i by the offsets of its step, or all of a file without steps: points, cells by kind, arrays of points."""
    points, steps = root["NumberOfPoints"][i], root.get("Steps")
    first = steps["PointOffsets"][i] if steps else 0
    cells = {}
    for k, name in enumerate(KINDS):
        group, count, ids = root[name], root[name]["NumberOfCells"][i], root[name]["NumberOfConnectivityIds"][i]
        begin = steps["CellOffsets"][i, k] + steps["PartOffsets"][i] if steps else 0   # each part before has one offset more than cells
        offsets = group["Offsets"][begin:begin + count + 1]
        assert offsets[0] == 0 and offsets[-1] == ids
        assert len(set(np.diff(offsets))) <= 1
        at = steps["ConnectivityIdOffsets"][i, k] if steps else 0
        connectivity = group["Connectivity"][at:at + ids]
        assert ids == 0 or (connectivity.min() >= 0 and connectivity.max() < points)
        cells[name] = connectivity.reshape(count, -1) if count else connectivity.reshape(0, 0)
    data = {name: array[(steps["PointDataOffsets"][name][i] if steps else 0):][:points] for name, array in root["PointData"].items()}
    return root["Points"][first:first + points], cells, data


def assert_is(part, mesh, vtp):
    """A part is this mesh, and what its .vtp has."""
    points, cells, data = part
    read = isoatlas.read_mesh(vtp) if len(mesh.triangles) else mesh
    assert len(points) == len(read.points) > 0
    if points.dtype == np.float64 and len(mesh.triangles) and not (points == read.points).all():   # .vtp has float32 where it may
        assert (points.astype(np.float32) == read.points).all()
    elif points.dtype == np.float64:
        assert (points == read.points).all()
    else:
        assert (points.astype(np.float64) == read.points).all()
    wanted = read.triangles if len(mesh.triangles) else mesh.segments
    assert (cells["Polygons" if len(mesh.triangles) else "Lines"] == wanted).all()
    assert not len(cells["Vertices"]) and not len(cells["Strips"])
    assert (data["ObjectId"] == mesh.object_ids).all() and (data["ContourId"] == mesh.contour_ids).all()
    assert data["Normals"].dtype == np.float32
    if mesh.space in ("unknown", "LPS"):
        assert (data["Normals"] == mesh.normals).all()
    else:
        assert (np.abs(data["Normals"]) == np.abs(mesh.normals)).all()


@pytest.fixture
def demo_file(tmp_path):
    isoatlas.write(tmp_path / "v.nrrd", isoatlas.phantom("demo", 40), spacing=(0.5, 0.25, 1), unit="mm", space="RAS")
    return tmp_path / "v.nrrd"


def test_one_surface(cli, demo_file, tmp_path):
    atlas = isoatlas.open(demo_file)
    for word in ("vtkhdf", "vtp"):
        cli("extract", "v.nrrd", "--tau", TAUS[0], "-o", f"s.{word}")
    atlas.surface(TAUS[0]).save(tmp_path / "python.vtkhdf")
    assert (tmp_path / "s.vtkhdf").read_bytes() == (tmp_path / "python.vtkhdf").read_bytes()
    with h5py.File(tmp_path / "s.vtkhdf") as file:
        root = file["VTKHDF"]
        assert check_structure(root) == 1 and "Steps" not in root
        assert_is(part_of(root, 0), atlas.surface(TAUS[0]), tmp_path / "s.vtp")
        field = root["FieldData"]
        assert list(field["Tau"]) == [TAUS[0]] and list(field["TunnelHeight"]) == [0]
        assert [text(field[name]) for name in ("Space", "SPACE", "Unit", "Interpolant")] == [["LPS"], ["LPS"], ["mm"], ["trilinear"]]
        assert root["PointData"].attrs["Normals"] == b"Normals" and root["PointData"].attrs["Scalars"] == b"ObjectId"


def test_an_evolution(cli, demo_file, tmp_path):
    told = json.loads(cli("animate", "v.nrrd", "--from", TAUS[2], "--to", TAUS[0], "--steps", 5, "-o", "e.vtkhdf", "--json"))
    atlas = isoatlas.open(demo_file)
    with h5py.File(tmp_path / "e.vtkhdf") as file:
        root = file["VTKHDF"]
        assert check_structure(root) == 5
        taus = list(root["Steps"]["Values"])
        assert taus == [step["tau"] for step in told["steps"]] == list(root["FieldData"]["Tau"])
        assert (taus[0], taus[-1]) == (TAUS[0], TAUS[2])
        assert list(root["Steps"]["FieldDataOffsets"]["Tau"]) == list(range(5))
        for i, tau in enumerate(taus):
            cli("extract", "v.nrrd", "--tau", repr(tau), "-o", "s.vtp")
            part = part_of(root, i)
            assert_is(part, atlas.surface(tau), tmp_path / "s.vtp")
            assert len(part[1]["Polygons"]) == told["steps"][i]["triangles"] and len(part[0]) == told["steps"][i]["points"]
        assert root["Points"].maxshape == (None, 3) and root["Points"].chunks is not None
    atlas.save_evolution(tmp_path / "python.vtkhdf", reversed(taus + taus[:2]))
    assert (tmp_path / "python.vtkhdf").read_bytes() == (tmp_path / "e.vtkhdf").read_bytes()


def test_many_chunks(tmp_path):
    """Noise: every array fills several chunks, and the last of each is not full."""
    array = np.float32(smooth((30, 31, 32), seed=3, passes=0))
    atlas = isoatlas.open(array)
    taus = [0.3, 0.5, 0.7]
    atlas.save_evolution(tmp_path / "e.vtkhdf", taus)
    with h5py.File(tmp_path / "e.vtkhdf") as file:
        assert check_structure(file["VTKHDF"]) == 3
        assert file["VTKHDF"]["Points"].id.get_num_chunks() > 3
        for i, tau in enumerate(taus):
            atlas.surface(tau).save(tmp_path / "s.vtp")
            assert_is(part_of(file["VTKHDF"], i), atlas.surface(tau), tmp_path / "s.vtp")


def test_many_steps(tmp_path):
    """More steps than a chunk of what has one row for each."""
    atlas = isoatlas.open(np.float32(smooth((6, 6, 6), seed=5)))
    low, high = float(atlas.volume.min()), float(atlas.volume.max())
    taus = np.linspace(low, high, 302)[1:-1]
    atlas.save_evolution(tmp_path / "e.vtkhdf", taus)
    with h5py.File(tmp_path / "e.vtkhdf") as file:
        assert check_structure(file["VTKHDF"]) == 300
        for i in (0, 127, 128, 299):
            atlas.surface(taus[i]).save(tmp_path / "s.vtp")
            assert_is(part_of(file["VTKHDF"], i), atlas.surface(taus[i]), tmp_path / "s.vtp")


def test_curves(cli, tmp_path):
    isoatlas.write(tmp_path / "v.nrrd", np.uint8(255 * smooth((40, 50), seed=4)))
    atlas = isoatlas.open(tmp_path / "v.nrrd")
    cli("animate", "v.nrrd", "--from", 120, "--to", 130, "--steps", 3, "-o", "e.vtkhdf")
    with h5py.File(tmp_path / "e.vtkhdf") as file:
        assert check_structure(file["VTKHDF"]) == 3
        for i, tau in enumerate((120, 125, 130)):
            assert_is(part_of(file["VTKHDF"], i), atlas.surface(tau), None)


def test_several_objects(cli, tmp_path):
    isoatlas.write(tmp_path / "v.nrrd", isoatlas.phantom("demo", 40), unit="µm")
    for word in ("vtkhdf", "vtp"):
        told = json.loads(cli("extract", "v.nrrd", "--top", 3, "-o", f"s.{word}", "--json"))
    with h5py.File(tmp_path / "s.vtkhdf") as file:
        root = file["VTKHDF"]
        assert check_structure(root) == 1
        points, cells, data = part_of(root, 0)
        read = isoatlas.read_mesh(tmp_path / "s.vtp")
        assert (points == read.points).all() and (cells["Polygons"] == read.triangles).all()
        assert (data["Object"] == read.object_ids).all() and data["Colour"].shape == (len(points), 3)
        assert list(root["FieldData"]["Tau"]) == [one["tau"] for one in told["surfaces"]]
        assert text(root["FieldData"]["ObjectName"])[0].startswith("object 1") and text(root["FieldData"]["Unit"]) == ["µm"]


def test_the_same_bytes_for_any_number_of_threads(cli, demo_file, tmp_path):
    made = []
    for i, threads in enumerate((1, 4, 4)):
        cli("animate", "v.nrrd", "--from", 90, "--to", 200, "--steps", 4, "--threads", threads, "-o", f"{i}.vtkhdf")
        cli("extract", "v.nrrd", "--tau", 90, "--threads", threads, "-o", f"s{i}.vtkhdf")
        made.append(((tmp_path / f"{i}.vtkhdf").read_bytes(), (tmp_path / f"s{i}.vtkhdf").read_bytes()))
    assert made[0] == made[1] == made[2]


def test_of_a_store(cli, demo_file, tmp_path):
    cli("build", "v.nrrd", "-o", "v.atlas")
    for name in ("v.nrrd", "v.atlas"):
        cli("animate", name, "--from", 90, "--to", 200, "--steps", 3, "-o", name[2:] + ".vtkhdf")
    assert (tmp_path / "nrrd.vtkhdf").read_bytes() == (tmp_path / "atlas.vtkhdf").read_bytes()


def test_refusals(demo_file, tmp_path):
    atlas = isoatlas.open(demo_file)
    with pytest.raises(isoatlas.InputError):
        atlas.save_evolution(tmp_path / "e.vtp", TAUS)
    with pytest.raises(isoatlas.InputError):
        atlas.save_evolution(tmp_path / "e.vtkhdf", [])
    with pytest.raises(isoatlas.NotFoundError):
        atlas.save_evolution(tmp_path / "e.vtkhdf", [100, 1e6])
    with pytest.raises(isoatlas.ResourceError):
        atlas.save_evolution(tmp_path / "no" / "e.vtkhdf", TAUS)
    atlas.surface(100).save(tmp_path / "s.vtkhdf")
    with pytest.raises(isoatlas.UnsupportedError):
        isoatlas.verify(tmp_path / "s.vtkhdf")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["s.vtkhdf", "v.nrrd"]


def test_progress_and_interruption(demo_file, tmp_path):
    parts = []
    atlas = isoatlas.open(demo_file)
    atlas.save_evolution(tmp_path / "e.vtkhdf", TAUS, progress=lambda phase, part: parts.append(part))
    assert parts == sorted(parts) and parts and parts[-1] <= 1
    (tmp_path / "e.vtkhdf").unlink()

    def stop(phase, part):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        atlas.save_evolution(tmp_path / "e.vtkhdf", TAUS, progress=stop)
    assert not (tmp_path / "e.vtkhdf").exists()


def test_a_full_disk_is_one_error(demo_file, tmp_path):
    """HDF5 neither prints nor crashes where the system takes no more bytes."""
    program = (f"import resource, isoatlas\natlas = isoatlas.open({str(demo_file)!r})\natlas.surface(100)\n"
               "import signal; signal.signal(signal.SIGXFSZ, signal.SIG_IGN)\n"
               "resource.setrlimit(resource.RLIMIT_FSIZE, (20000, 20000))\n"
               f"for write in (lambda p: atlas.save_evolution(p, [100, 150]), atlas.surface(100).save):\n"
               f"    try:\n        write({str(tmp_path / 'x.vtkhdf')!r})\n    except isoatlas.ResourceError as error:\n"
               "        print('refused', 'x.vtkhdf' in str(error))\n")
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert (done.returncode, done.stdout, done.stderr) == (0, "refused True\nrefused True\n", "")
    assert [path.name for path in tmp_path.iterdir()] == ["v.nrrd"]
