"""MRC maps against mrcfile, the library of the format: what it writes is read, what is written it reads and finds valid."""
import numpy as np
import pytest

import isoatlas

mrcfile = pytest.importorskip("mrcfile")


@pytest.mark.parametrize("dtype", ["int8", "int16", "uint16", "float32", "float16"])
@pytest.mark.parametrize("shape", [(4, 5, 6), (5, 6)])
def test_what_mrcfile_writes_is_read(dtype, shape, tmp_path):
    array = (np.random.default_rng(1).random(shape) * 100).astype(dtype)
    with mrcfile.new(tmp_path / "v.mrc") as file:
        file.set_data(array)
        file.voxel_size = (1.5, 2.5, 3.5)
        file.header.origin = (10, -20, 30)
        if len(shape) == 3:
            file.set_volume()
    atlas = isoatlas.open(tmp_path / "v.mrc")
    assert atlas.shape == shape
    assert np.array_equal(atlas.volume, array.astype("float32" if dtype == "float16" else dtype))
    assert atlas.info["unit"] == "Å"
    assert np.allclose(atlas.info["spacing"][:len(shape)], (1.5, 2.5, 3.5)[:len(shape)], rtol=1e-6)
    assert np.allclose(atlas.info["origin"][:len(shape)], (10, -20, 30)[:len(shape)])


@pytest.mark.parametrize("dtype", ["uint8", "int8", "int16", "uint16", "float32"])
def test_mrcfile_reads_what_is_written(dtype, tmp_path):
    array = (np.random.default_rng(2).random((4, 5, 6)) * 100).astype(dtype)
    isoatlas.open(array, spacing=(0.1, 0.2, 0.3), origin=(1, 2, 3), unit="nm").save(tmp_path / "v.mrc")
    assert mrcfile.validate(tmp_path / "v.mrc")
    with mrcfile.open(tmp_path / "v.mrc") as file:
        assert np.array_equal(file.data, array)
        assert np.allclose((file.voxel_size.x, file.voxel_size.y, file.voxel_size.z), (3, 2, 1), rtol=1e-6)
        assert np.allclose((file.header.origin.x, file.header.origin.y, file.header.origin.z), (10, 20, 30))


@pytest.mark.parametrize(("compression", "name"), [("gzip", "emd_1.map.gz"), ("bzip2", "emd_1.map.bz2")])
def test_maps_that_are_packed_as_a_whole(compression, name, tmp_path):
    array = (np.random.default_rng(3).random((4, 5, 6)) * 100).astype("float32")
    with mrcfile.new(tmp_path / name, compression=compression) as file:
        file.set_data(array)
        file.voxel_size = 2
    atlas = isoatlas.open(tmp_path / name)
    assert np.array_equal(atlas.volume, array)
    assert np.allclose(atlas.info["spacing"], 2)


def test_labels_are_a_mask_of_the_map(tmp_path):
    array = np.random.default_rng(4).random((4, 5, 6)).astype("float32")
    with mrcfile.new(tmp_path / "map.mrc") as file:
        file.set_data(array)
        file.voxel_size = 2
        file.header.origin = (10, -20, 30)
    atlas = isoatlas.open(tmp_path / "map.mrc")
    atlas.save_labels(tmp_path / "mask.mrc", 0.5)
    assert mrcfile.validate(tmp_path / "mask.mrc")
    with mrcfile.open(tmp_path / "mask.mrc") as file:
        assert np.array_equal(file.data, atlas.labels(0.5))
        assert np.array_equal(file.data > 0, array >= 0.5)
        assert float(file.voxel_size.x) == 2
        assert float(file.header.origin.y) == -20
