"""NetCDF against netCDF4, the library of the format: variables, axes, time, missing samples, in every file format it writes."""
import numpy as np
import pytest

import isoatlas
from conftest import SOURCE

netCDF4 = pytest.importorskip("netCDF4")
FORMATS = ["NETCDF3_CLASSIC", "NETCDF3_64BIT_OFFSET", "NETCDF3_64BIT_DATA", "NETCDF4", "NETCDF4_CLASSIC"]
CLASSIC_TYPES = ["i1", "i2", "i4", "f4", "f8"]


def make(path, array, format, places=None, units=("m", "m", "m"), unlimited=False, **create):
    with netCDF4.Dataset(path, "w", format=format) as file:
        names = ["z", "y", "x"][-array.ndim:]
        for i, (name, size) in enumerate(zip(names, array.shape)):
            file.createDimension(name, None if unlimited and i == 0 else size)
        variable = file.createVariable("v", array.dtype.str[1:], names, **create)
        variable.set_auto_maskandscale(False)
        variable[:] = array
        for name, values, unit in zip(names, places or [], units):
            axis = file.createVariable(name, "f8", (name,))
            axis[:] = values
            axis.units = unit
        variable.units, variable.long_name = "K", "temperature"


@pytest.mark.parametrize("format", FORMATS)
@pytest.mark.parametrize("dtype", [*CLASSIC_TYPES, "u1", "u2", "u4"])
def test_every_type_and_format(format, dtype, tmp_path):
    if dtype not in CLASSIC_TYPES and format not in ("NETCDF4", "NETCDF3_64BIT_DATA"):
        pytest.skip("the format has no such type")
    array = (np.random.default_rng(1).random((3, 4, 5)) * 100).astype(dtype)
    places = [[1, 2, 3], [10, 8, 6, 4], [0, 0.5, 1, 1.5, 2]]
    make(tmp_path / "v.nc", array, format, places)
    atlas = isoatlas.open(tmp_path / "v.nc")
    assert np.array_equal(atlas.volume, array)
    assert atlas.info["unit"] == "m"
    assert np.allclose(atlas.info["spacing"], (0.5, 2, 1)) and np.allclose(atlas.info["origin"], (0, 10, 1))
    assert np.allclose(np.asarray(atlas.info["direction"])[1], (0, -1, 0))


@pytest.mark.parametrize("format", FORMATS)
@pytest.mark.parametrize("dtype", ["i1", "i2", "f8"])
def test_records(format, dtype, tmp_path):
    array = (np.random.default_rng(2).random((4, 3, 5)) * 100).astype(dtype)
    make(tmp_path / "v.nc", array, format, [[1, 2, 3, 4], [1, 2, 3], [1, 2, 3, 4, 5]], unlimited=True)
    assert np.array_equal(isoatlas.open(tmp_path / "v.nc").volume, array)


@pytest.mark.parametrize("create", [{"zlib": True}, {"zlib": True, "shuffle": True, "fletcher32": True, "chunksizes": (2, 3, 2)}, {"endian": "big"}])
def test_storage_of_netcdf4(create, tmp_path):
    array = (np.random.default_rng(3).random((5, 4, 6)) * 100).astype("f4")
    make(tmp_path / "v.nc", array, "NETCDF4", **create)
    assert np.array_equal(isoatlas.open(tmp_path / "v.nc").volume, array)


@pytest.mark.parametrize("format", FORMATS)
def test_time_steps_and_missing_samples(format, tmp_path):
    rng = np.random.default_rng(4)
    array = rng.random((3, 4, 5)).astype("f4")
    mask = rng.random(array.shape) > 0.8
    with netCDF4.Dataset(tmp_path / "v.nc", "w", format=format) as file:
        for name, size in (("time", None), ("lat", 4), ("lon", 5)):
            file.createDimension(name, size)
        time = file.createVariable("time", "f8", ("time",))
        time.units = "days since 2001-01-01"
        variable = file.createVariable("v", "f4", ("time", "lat", "lon"), fill_value=1e20)
        variable[:] = np.ma.array(array, mask=mask)
        time[:] = [0, 1, 2]
    for step in range(3):
        got = np.asarray(isoatlas.open(tmp_path / "v.nc", time_step=step, missing="below").volume)
        assert np.array_equal(got[~mask[step]], array[step][~mask[step]])
        assert (got[mask[step]] < got[~mask[step]].min()).all()


@pytest.mark.parametrize("format", ["NETCDF3_64BIT_OFFSET", "NETCDF4"])
@pytest.mark.parametrize("dtype", ["f4", "f8"])
def test_missing_samples_anywhere_in_thousands(format, dtype, tmp_path):
    rng = np.random.default_rng(5)
    array = rng.random((9, 25, 37)).astype(dtype)
    flat = array.reshape(-1)  # eight times 1024 samples and a rest
    for place, value in ((0, 5e19), (1023, 1e20), (1024, 5e19), (3000, 1e20), (8191, 5e19), (8192, 1e20), (8324, 5e19)):
        flat[place] = value
    with netCDF4.Dataset(tmp_path / "v.nc", "w", format=format) as file:
        for name, size in zip("zyx", array.shape):
            file.createDimension(name, size)
        variable = file.createVariable("v", dtype, tuple("zyx"), fill_value=1e20)
        variable.missing_value = np.array([5e19], dtype)
        variable.set_auto_maskandscale(False)
        variable[:] = array
    missing = (array == 5e19) | (array == np.array(1e20, dtype))
    got = np.asarray(isoatlas.open(tmp_path / "v.nc", missing="below").volume)
    assert missing.sum() == 7 and np.array_equal(got[~missing], array[~missing]) and (got[missing] < array[~missing].min()).all()


def test_groups_and_names(tmp_path):
    array = np.arange(24, dtype="i4").reshape(2, 3, 4)
    with netCDF4.Dataset(tmp_path / "v.nc", "w") as file:
        group = file.createGroup("model")
        for name, size in (("a", 2), ("b", 3), ("c", 4)):
            file.createDimension(name, size)
        group.createVariable("v", "i4", ("a", "b", "c"))[:] = array
        file.createVariable("c", "f8", ("c",))[:] = [1, 2, 4, 8]
    atlas = isoatlas.open(tmp_path / "v.nc")
    assert np.array_equal(atlas.volume, array)


def test_shared_files():
    shared = SOURCE.parent / "shared" / "data" / "formats"
    if not shared.exists():
        pytest.skip("no shared data beside the checkout")
    with netCDF4.Dataset(shared / "sampleCurveGrid4.nc") as file:
        expected = file["sample"][:].filled()
    curved = isoatlas.open(shared / "sampleCurveGrid4.nc")
    assert np.array_equal(curved.volume, expected)
    with netCDF4.Dataset(shared / "lsm_4x5.nc") as file:
        mask, lat, lon = file["lsm"][:].filled(), file["latitude"][:], file["longitude"][:]
    atlas = isoatlas.open(shared / "lsm_4x5.nc")
    assert np.array_equal(atlas.volume, mask)
    assert atlas.info["spacing"][0] == pytest.approx(abs(lon[1] - lon[0])) and atlas.info["spacing"][1] == pytest.approx(abs(lat[1] - lat[0]))
    with pytest.raises(isoatlas.UnsupportedError, match="unstructured"):
        isoatlas.open(shared / "sampleGenGrid3.nc").volume
