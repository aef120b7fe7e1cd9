"""OpenVDB against pyopenvdb, the library's own bindings: grids that it writes are read, what is written it reads."""
import resource
import subprocess

import numpy as np
import pytest

import isoatlas
from conftest import CLI

vdb = pytest.importorskip("pyopenvdb")


def grid_of(array, kind=vdb.FloatGrid, name="density", matrix=None, low=(0, 0, 0), background=0):
    grid = kind(background)
    grid.copyFromArray(np.ascontiguousarray(array.transpose(2, 1, 0)), ijk=low)
    grid.name = name
    if matrix is not None:
        grid.transform = vdb.createLinearTransform(matrix)
    return grid


def array_of(path, name, shape):
    grid, out = vdb.read(str(path), name), np.zeros(shape[::-1], "float32")
    grid.copyToArray(out)
    return grid, out.transpose(2, 1, 0)


def built_with_openvdb(folder):
    vdb.write(str(folder / "v.vdb"), grids=[grid_of(np.ones((2, 2, 2), "float32"))])
    try:
        isoatlas.open(folder / "v.vdb")
    except isoatlas.Error as error:
        return "this build has no OpenVDB" not in str(error)
    return True


@pytest.fixture(scope="module", autouse=True)
def needs_openvdb(tmp_path_factory):
    if not built_with_openvdb(tmp_path_factory.mktemp("openvdb")):
        pytest.skip("isoatlas was built without OpenVDB")


@pytest.mark.parametrize("half", [False, True])
def test_float_grids_are_read(half, tmp_path):
    array = np.random.default_rng(1).integers(1, 100, (20, 70, 9)).astype("float32")
    grid = grid_of(array, matrix=[[0, 2, 0, 0], [-3, 0, 0, 0], [0, 0, 0.5, 0], [10, 20, 30, 1]], low=(5, -7, 3))
    grid.saveFloatAsHalf = half
    vdb.write(str(tmp_path / "v.vdb"), grids=[grid])
    atlas = isoatlas.open(tmp_path / "v.vdb")
    assert np.array_equal(atlas.volume, array)
    assert np.allclose(atlas.info["spacing"], (2, 3, 0.5))
    assert np.allclose(np.asarray(atlas.info["direction"]), [[0, -1, 0], [1, 0, 0], [0, 0, 1]])
    assert np.allclose(atlas.info["origin"], (10 + 21, 20 + 10, 30 + 1.5))


def test_background_and_inside_of_level_sets(tmp_path):
    ball = vdb.createLevelSetSphere(radius=12, voxelSize=1, halfWidth=3)
    ball.name = "ball"
    vdb.write(str(tmp_path / "v.vdb"), grids=[ball])
    low, high = ball.evalActiveVoxelBoundingBox()
    shape = tuple(np.subtract(high, low) + 1)
    wanted = np.zeros(shape, "float32")
    ball.copyToArray(wanted, ijk=low)
    atlas = isoatlas.open(tmp_path / "v.vdb")
    assert np.array_equal(atlas.volume, wanted.transpose(2, 1, 0))
    assert atlas.volume.min() == -3 and atlas.volume.max() == 3


def test_several_grids_must_be_chosen(tmp_path):
    one, other = np.full((4, 5, 6), 1, "float32"), np.full((4, 5, 6), 2, "float32")
    other[2, 2, 2] = 3
    mask = vdb.BoolGrid()
    mask.fill((0, 0, 0), (3, 2, 1), True)
    mask.name = "mask"
    vdb.write(str(tmp_path / "v.vdb"), grids=[grid_of(one, name="one"), grid_of(other, name="other"), mask])
    with pytest.raises(isoatlas.Error, match="grids|datasets"):
        isoatlas.open(tmp_path / "v.vdb")
    assert np.array_equal(isoatlas.open(f"{tmp_path}/v.vdb:/other").volume, other)
    assert isoatlas.open(f"{tmp_path}/v.vdb:/mask").volume.shape == (2, 3, 4)


@pytest.mark.parametrize("dtype", ["uint8", "int8", "uint16", "int16", "float32"])
def test_what_is_written_is_read_by_openvdb(dtype, tmp_path, cli):
    array = np.zeros((11, 9, 20), dtype)
    array[2:9, 2:7, 3:18] = np.random.default_rng(2).integers(1, 100, (7, 5, 15))
    isoatlas.open(array, spacing=(0.5, 2, 3), origin=(1, 2, 3), unit="mm").save(tmp_path / "v.vdb")
    grid, out = array_of(tmp_path / "v.vdb", "density", array.shape)
    assert np.array_equal(out, array.astype("float32"))
    assert grid.background == 0 and grid.activeVoxelCount() == np.count_nonzero(array)
    assert np.allclose(grid.transform.indexToWorld((0, 0, 0)), (1, 2, 3)) and np.allclose(grid.transform.voxelSize(), (3, 2, 0.5))
    again = isoatlas.open(tmp_path / "v.vdb")
    assert np.array_equal(again.volume, array[2:9, 2:7, 3:18]) and again.info["unit"] == "mm"
    first = (tmp_path / "v.vdb").read_bytes()
    isoatlas.open(array, spacing=(0.5, 2, 3), origin=(1, 2, 3), unit="mm").save(tmp_path / "v.vdb")
    assert (tmp_path / "v.vdb").read_bytes() == first


@pytest.mark.parametrize("dtype", ["int32", "uint32", "float64"])
def test_wide_samples_come_back(dtype, tmp_path):
    array = np.random.default_rng(3).integers(1, 2**31 - 1, (9, 10, 11)).astype(dtype)
    isoatlas.open(array).save(tmp_path / "v.vdb")
    assert np.array_equal(isoatlas.open(tmp_path / "v.vdb").volume, array)


def test_labels(tmp_path, cli):
    cli("phantom", "demo", "--size", "32", "-o", "v.nrrd")
    cli("label", "v.nrrd", "--tau", "120", "-o", "labels.vdb")
    cli("label", "v.nrrd", "--tau", "120", "-o", "labels.nrrd")
    cli("convert", "labels.nrrd", "-o", "labels.npy")
    wanted = np.load(tmp_path / "labels.npy")
    places = np.argwhere(wanted)
    box = tuple(slice(low, high + 1) for low, high in zip(places.min(0), places.max(0)))
    cli("convert", "labels.vdb:/labels", "-o", "back.npy")  # pyopenvdb has no int32
    assert np.array_equal(np.load(tmp_path / "back.npy"), wanted[box])


def outcome(path, memory=4 << 30):
    limit = lambda: resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
    return subprocess.run([CLI, "convert", path, "-o", str(path) + ".npy"], capture_output=True, text=True, timeout=60, preexec_fn=limit)


@pytest.mark.skipif(not CLI, reason="ISOATLAS_CLI does not name the command line")
def test_truncated_files_are_refused(tmp_path):
    array = np.random.default_rng(4).random((10, 10, 10)).astype("float32")
    vdb.write(str(tmp_path / "v.vdb"), grids=[grid_of(array)])
    whole = (tmp_path / "v.vdb").read_bytes()
    for size in range(8, len(whole) - 1, max(len(whole) // 40, 1)):
        (tmp_path / "w.vdb").write_bytes(whole[:size])
        done = outcome(tmp_path / "w.vdb")
        assert done.returncode in (3, 5) and done.stderr.count("\n") == 1, (size, done.returncode, done.stderr)


@pytest.mark.skipif(not CLI, reason="ISOATLAS_CLI does not name the command line")
def test_forged_sizes_take_no_memory(tmp_path):
    array = np.random.default_rng(6).random((10, 10, 10)).astype("float32")
    grid = grid_of(array)
    grid["note"] = "a text"
    vdb.write(str(tmp_path / "v.vdb"), grids=[grid], metadata={"creator": "a test"})
    whole = (tmp_path / "v.vdb").read_bytes()
    assert outcome(tmp_path / "v.vdb", 1 << 30).returncode == 0
    lengths = [place for text in (b"creator", b"a test", b"density", b"Tree_float_5_4_3", b"note", b"a text", b"class")
               for place in range(len(whole)) if whole.startswith(len(text).to_bytes(4, "little") + text, place)]
    blosc = [place for place in range(len(whole) - 24) if whole[place + 4:place + 8] == bytes(4) and whole[place + 8] == 2 and
             whole[place:place + 4] == whole[place + 20:place + 24] != bytes(4)]
    entries, grids = 57, whole.index(b"density") - 8  # numbers of entries of the metadata, of grids
    assert len(lengths) >= 7 and len(blosc) >= 2
    for place, size in [*[(place, 4) for place in [*lengths, entries, grids]], *[(place, 8) for place in blosc], *[(place + 20, 4) for place in blosc]]:
        for forged in (2**31 - 1, 2**30, 2**(8 * size) - 1):
            (tmp_path / "w.vdb").write_bytes(whole[:place] + forged.to_bytes(size, "little") + whole[place + size:])
            done = outcome(tmp_path / "w.vdb", 1 << 30)
            assert done.returncode == 3 and done.stderr.count("\n") == 1 and "memory" not in done.stderr, (place, forged, done.stderr)


def test_one_grid_is_read_of_many(tmp_path):
    grids = [grid_of(np.full((4, 5, 6), number, "float32"), name=f"g{number}") for number in range(1, 4)]
    twin = grids[1].copy()  # shares its tree
    twin.name, twin.transform = "twin", vdb.createLinearTransform(voxelSize=2)
    vectors = vdb.Vec3SGrid()
    vectors.fill((0, 0, 0), (3, 3, 3), (1, 2, 3))
    vectors.name = "vectors"
    vdb.write(str(tmp_path / "v.vdb"), grids=[vectors, *grids, twin])
    assert all((isoatlas.open(f"{tmp_path}/v.vdb:/g{number}").volume == number).all() for number in range(1, 4))
    atlas = isoatlas.open(f"{tmp_path}/v.vdb:/twin")
    assert (atlas.volume == 2).all() and atlas.volume.shape == (4, 5, 6) and np.allclose(atlas.info["spacing"], 2)
    with pytest.raises(isoatlas.Error, match="vec3s"):
        isoatlas.open(f"{tmp_path}/v.vdb:/vectors")


@pytest.mark.skipif(not CLI, reason="ISOATLAS_CLI does not name the command line")
def test_damaged_bytes_never_end_the_program(tmp_path):
    array = np.random.default_rng(5).random((6, 7, 5)).astype("float32")
    vdb.write(str(tmp_path / "v.vdb"), grids=[grid_of(array)])
    whole = (tmp_path / "v.vdb").read_bytes()
    for place in [*range(8, 600, 24), *range(600, len(whole), len(whole) // 20)]:
        (tmp_path / "w.vdb").write_bytes(whole[:place] + bytes([whole[place] ^ 255]) + whole[place + 1:])
        done = outcome(tmp_path / "w.vdb")
        assert done.returncode in (0, 2, 3, 4, 5), (place, done.returncode, done.stderr)
