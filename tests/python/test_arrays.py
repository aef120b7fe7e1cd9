"""Arrays of any type, order and shape mean the same volume."""
import itertools

import numpy as np
import pytest

import isoatlas
from conftest import smooth

TYPES = ["u1", "i1", "u2", "i2", "u4", "i4", "f4", "f8"]
SHAPES = {"3d": (9, 10, 11), "2d": (12, 13), "one slice": (1, 12, 13)}


def of_type(array, dtype):
    return np.rint(100 * array).astype(dtype) if dtype[0] in "ui" else np.float32(array).astype(dtype)


def in_order(array, order, tmp_path):
    """The same values in another layout."""
    if order == "C":
        return np.ascontiguousarray(array)
    if order == "F":
        return np.asfortranarray(array)
    if order == "strided":
        wide = np.zeros([2 * n for n in array.shape], array.dtype)
        view = wide[tuple(slice(None, None, 2) for _ in array.shape)]
        view[...] = array
        return view
    if order == "negative":
        return np.ascontiguousarray(array[..., ::-1])[..., ::-1]
    if order == "read-only":
        fixed = array.copy()
        fixed.setflags(write=False)
        return fixed
    if order == "unaligned":
        room = np.zeros(array.nbytes + 1, np.uint8)
        view = room[1:].view(array.dtype).reshape(array.shape) if array.dtype.itemsize == 1 else np.ndarray(array.shape, array.dtype, room, 1)
        view[...] = array
        return view
    path = tmp_path / "samples.bin"
    array.tofile(path)
    return np.memmap(path, array.dtype, "r", shape=array.shape)


def surface_of(array, level, **options):
    mesh = isoatlas.open(array, **options).surface(level)
    return mesh.points.copy(), (mesh.triangles if len(mesh.triangles) else mesh.segments).copy()


CASES = [(dtype, endian, order, shape) for dtype, endian, order, shape in itertools.product(
    TYPES, "<>", ["C", "F", "strided", "negative", "read-only", "unaligned", "memmap"], SHAPES) if not (dtype[1] == "1" and endian == ">")]


@pytest.mark.parametrize("dtype,endian,order,shape", CASES)
def test_every_layout_is_the_same_volume(dtype, endian, order, shape, tmp_path):
    plain = of_type(smooth(SHAPES[shape]), dtype)
    level = float(np.median(plain))
    other = in_order(plain.astype(endian + dtype), order, tmp_path)
    assert np.array_equal(other, plain)
    for ours, expected in zip(surface_of(other, level), surface_of(plain, level)):
        assert np.array_equal(ours, expected)


@pytest.mark.parametrize("dtype", TYPES)
@pytest.mark.parametrize("order", ["C", "read-only", "memmap"])
def test_contiguous_arrays_are_not_copied(dtype, order, tmp_path):
    array = in_order(of_type(smooth((6, 7, 8)), dtype), order, tmp_path)
    atlas = isoatlas.open(array)
    assert np.shares_memory(atlas.volume, array)
    assert not atlas.volume.flags.writeable
    atlas.labels(float(np.median(array)))
    assert np.shares_memory(atlas.volume, array)


@pytest.mark.parametrize("dtype", TYPES)
def test_samples_are_what_was_given(dtype):
    array = of_type(smooth((5, 6, 7)), dtype)
    atlas = isoatlas.open(array[:, ::-1])
    assert atlas.dtype == array.dtype and atlas.shape == array.shape and np.array_equal(atlas.volume, array[:, ::-1])
    assert atlas.range == (array.min(), array.max())


@pytest.mark.parametrize("spacing", [None, 2.0, (3.0, 2.0, 0.5)])
@pytest.mark.parametrize("origin", [None, (10.0, -20.0, 30.0)])
@pytest.mark.parametrize("turned", [False, True])
def test_points_lie_where_the_geometry_says(spacing, origin, turned):
    array = smooth((8, 9, 10))
    level = float(np.median(array))
    matrix = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1.0]]) if turned else np.eye(3)
    mesh = isoatlas.open(array, spacing=spacing, origin=origin, direction=matrix if turned else None).surface(level)
    in_voxels = isoatlas.open(array).surface(level)
    steps = np.array([1, 1, 1] if spacing is None else [2, 2, 2] if spacing == 2 else spacing[::-1], float)
    expected = np.array(origin or (0, 0, 0)) + (in_voxels.points * steps) @ matrix.T
    assert np.allclose(mesh.points, expected, atol=1e-12)


def test_points_are_those_of_the_affine_of_nibabel(tmp_path):
    nibabel = pytest.importorskip("nibabel", reason="python3-nibabel is not installed")
    array = np.float32(smooth((8, 9, 10)))
    affine = np.array([[0, -0.7, 0, 5], [1.5, 0, 0, -3], [0, 0, 2, 8], [0, 0, 0, 1.0]])
    nibabel.save(nibabel.Nifti1Image(array.T, affine), tmp_path / "v.nii")
    level = float(np.median(array))
    mesh, in_voxels = isoatlas.open(tmp_path / "v.nii").surface(level), isoatlas.open(array).surface(level)
    assert mesh.space in ("RAS", "LPS")
    expected = in_voxels.points @ affine[:3, :3].T + affine[:3, 3]
    if mesh.space == "LPS":
        expected[:, :2] *= -1
    assert np.allclose(mesh.points, expected, atol=1e-4)


def test_index_and_position_are_in_their_orders(demo):
    atlas = isoatlas.open(demo, spacing=(3, 2, 1), origin=(5, 6, 7))
    for one in atlas.objects:
        z, y, x = one.index
        assert one.id == np.ravel_multi_index(one.index, atlas.shape)
        assert one.position == (5 + x, 6 + 2 * y, 7 + 3 * z)
        assert atlas.volume[one.index] >= one.best_tau


@pytest.mark.parametrize("dtype,kept", [("?", "uint8"), ("f2", "float32"), ("i8", "int32"), ("u8", "int32")])
def test_other_types_are_taken_where_nothing_is_lost(dtype, kept):
    array = (smooth((6, 6, 6)) > 0.5).astype(dtype)
    atlas = isoatlas.open(array)
    assert atlas.dtype == kept and np.array_equal(atlas.volume, array)
    assert np.array_equal(atlas.labels(0.5) > 0, array > 0.5)


def test_large_64_bit_integers_are_unsigned_or_refused():
    array = np.zeros((3, 3, 3), np.int64)
    array[1, 1, 1] = 2**32 - 1
    assert isoatlas.open(array).dtype == "uint32"
    array[1, 1, 1] = 2**32
    with pytest.raises(isoatlas.UnsupportedError, match="4294967296"):
        isoatlas.open(array)


def test_missing_samples_are_replaced_in_a_copy():
    array = smooth((6, 6, 6))
    array[2, 3, 4] = np.nan
    atlas = isoatlas.open(array, missing="below")
    assert np.isnan(array[2, 3, 4]) and atlas.volume[2, 3, 4] < np.nanmin(array)
    assert isoatlas.open(array, missing=0.25).volume[2, 3, 4] == 0.25
    array[2, 3, 4] = -1000
    assert isoatlas.open(array, no_data=-1000, missing=0.5).volume[2, 3, 4] == 0.5


def test_box_is_a_slice_of_the_array_in_its_place():
    array = smooth((8, 9, 10))
    box = np.s_[1:6, 2:8, 3:]
    atlas, level = isoatlas.open(array, box=box, spacing=(2, 3, 4)), float(np.median(array))
    assert np.array_equal(atlas.volume, array[box])
    part = isoatlas.open(array[box], spacing=(2, 3, 4), origin=(12, 6, 2))
    assert np.allclose(atlas.surface(level).points, part.surface(level).points)


def test_low_polarity_finds_what_negated_samples_have():
    array = smooth((8, 9, 10))
    low, negated = isoatlas.open(array, polarity="low"), isoatlas.open(-array)
    level = float(np.median(array))
    assert np.array_equal(low.labels(level), negated.labels(-level))
    assert [one.best_tau for one in low.objects] == [-one.best_tau for one in negated.objects]


class Slabs:
    """An array that is only read slice by slice, as zarr's are."""

    def __init__(self, array):
        self._array, self.reads = array, []
        self.shape, self.dtype, self.ndim = array.shape, array.dtype, array.ndim

    def __getitem__(self, index):
        self.reads.append(index)
        return self._array[index]

    def __array__(self, dtype=None):
        return np.asarray(self._array, dtype)


@pytest.mark.parametrize("endian", "<>")
def test_lazy_arrays_are_read_in_slabs(endian, tmp_path):
    array = smooth((20, 10, 11)).astype(endian + "f4")
    slabs = Slabs(array)
    isoatlas.build(slabs, tmp_path / "slabs.atlas", spacing=(2, 1, 1))
    isoatlas.build(array, tmp_path / "array.atlas", spacing=(2, 1, 1))
    assert slabs.reads and all(isinstance(one, slice) for one in slabs.reads)
    a, b = isoatlas.open(tmp_path / "slabs.atlas"), isoatlas.open(tmp_path / "array.atlas")
    assert np.array_equal(a.volume, b.volume) and np.array_equal(a.volume, array)
    assert a.spacing == (2, 1, 1)
    assert np.array_equal(isoatlas.open(Slabs(array)).volume, array)


def test_data_arrays_bring_their_coordinates():
    class DataArray:
        dims = ("z", "y", "x")
        coords = {"z": np.arange(4) * 2.0 + 10, "y": np.arange(5) * 0.5 - 1, "x": np.arange(6) * 1.0}
        attrs = {"units": "HU"}
        data = smooth((4, 5, 6))

    atlas = isoatlas.open(DataArray())
    assert atlas.spacing == (2, 0.5, 1) and atlas.info["origin"] == [0, -1, 10] and atlas.info["value_unit"] == "HU"
    DataArray.coords = dict(DataArray.coords, z=np.array([0, 1, 2, 4.0]))
    with pytest.raises(isoatlas.UnsupportedError, match="along z"):
        isoatlas.open(DataArray())
