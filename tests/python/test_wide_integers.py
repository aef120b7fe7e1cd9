"""Integers of 64 bits, the default of NumPy: read as float64 from every format that has them, none of them rounded."""
import json

import numpy as np
import pytest

import isoatlas

EXACT = [0, 1, 7, 2**31, 2**32, 2**53, 2**53 + 2, 2**62, 2**63 - 2**10]
TYPES = ["int64", "uint64"]


def exact(dtype):
    values = np.array(EXACT, dtype)
    if dtype == "int64":
        values = np.concatenate([values, -values, np.array([-(2**63)], dtype)])
    else:
        values = np.concatenate([values, np.array([2**63, 2**64 - 2**11], dtype)])
    return np.resize(np.random.default_rng(1).permutation(values), (4, 5, 6))


def write_npy(path, array):
    np.save(path, array)


def write_npy_big(path, array):
    np.save(path, array.astype(array.dtype.newbyteorder(">")))


def write_nrrd(path, array, encoding="raw", type_name=None):
    sizes = " ".join(map(str, array.shape[::-1]))
    payload = array.tobytes() if encoding == "raw" else " ".join(map(str, array.ravel())).encode() + b"\n"
    header = f"NRRD0004\ntype: {type_name or array.dtype}\ndimension: 3\nsizes: {sizes}\nendian: little\nencoding: {encoding}\n\n"
    path.write_bytes(header.encode() + payload)


def write_nrrd_text(path, array):
    write_nrrd(path, array, "ascii", "long long" if array.dtype == np.int64 else "unsigned long long int")


def write_metaimage(path, array):
    sizes = " ".join(map(str, array.shape[::-1]))
    name = "MET_LONG_LONG" if array.dtype == np.int64 else "MET_ULONG_LONG"
    header = f"NDims = 3\nDimSize = {sizes}\nElementByteOrderMSB = True\nElementType = {name}\nElementDataFile = LOCAL\n"
    path.write_bytes(header.encode() + array.byteswap().tobytes())


def write_nifti(path, array):
    nibabel = pytest.importorskip("nibabel", reason="python3-nibabel is not installed")
    nibabel.save(nibabel.Nifti1Image(array.T, np.eye(4), dtype=array.dtype), path)


def write_hdf5(path, array):
    with pytest.importorskip("h5py").File(path, "w") as file:
        file.create_dataset("v", data=array, chunks=(2, 3, 4), compression="gzip", shuffle=True)


def write_hdf5_big(path, array):
    with pytest.importorskip("h5py").File(path, "w") as file:
        file.create_dataset("v", data=array.astype(array.dtype.newbyteorder(">")))


def write_netcdf(path, array, format="NETCDF4", **create):
    with pytest.importorskip("netCDF4").Dataset(path, "w", format=format) as file:
        for name, size in zip("zyx", array.shape):
            file.createDimension(name, size)
        variable = file.createVariable("v", array.dtype.str[1:], ("z", "y", "x"), **create)
        variable.set_auto_maskandscale(False)
        variable[:] = array


def write_netcdf_classic(path, array):
    write_netcdf(path, array, "NETCDF3_64BIT_DATA")


def write_zarr(path, array):
    path.mkdir()
    metadata = {"zarr_format": 2, "shape": array.shape, "chunks": array.shape, "dtype": array.dtype.str, "order": "C",
                "fill_value": 0, "filters": None, "compressor": None}
    (path / ".zarray").write_text(json.dumps(metadata))
    (path / "0.0.0").write_bytes(array.tobytes())


def write_zarr_3(path, array):
    path.mkdir()
    metadata = {"zarr_format": 3, "node_type": "array", "shape": array.shape, "data_type": str(array.dtype), "fill_value": 0, "attributes": {},
                "chunk_grid": {"name": "regular", "configuration": {"chunk_shape": array.shape}},
                "chunk_key_encoding": {"name": "default"}, "codecs": [{"name": "bytes", "configuration": {"endian": "big"}}]}
    (path / "zarr.json").write_text(json.dumps(metadata))
    (path / "c/0/0").mkdir(parents=True)
    (path / "c/0/0/0").write_bytes(array.byteswap().tobytes())


def vtk_image(array):
    vtk = pytest.importorskip("vtk")
    from vtk.util.numpy_support import numpy_to_vtk

    image = vtk.vtkImageData()
    image.SetDimensions(array.shape[::-1])
    kind = vtk.VTK_TYPE_INT64 if array.dtype == np.int64 else vtk.VTK_TYPE_UINT64
    scalars = numpy_to_vtk(array.ravel(), deep=True, array_type=kind)
    scalars.SetName("v")
    image.GetPointData().SetScalars(scalars)
    return vtk, image


def write_vti(path, array, mode="SetDataModeToAppended"):
    vtk, image = vtk_image(array)
    writer = vtk.vtkXMLImageDataWriter()
    getattr(writer, mode)()
    writer.SetFileName(str(path))
    writer.SetInputData(image)
    assert writer.Write() == 1


def write_vti_text(path, array):
    write_vti(path, array, "SetDataModeToAscii")


def write_vtk(path, array, binary=True):
    vtk, image = vtk_image(array)
    writer = vtk.vtkStructuredPointsWriter()
    writer.SetFileName(str(path))
    writer.SetInputData(image)
    writer.SetFileTypeToBinary() if binary else writer.SetFileTypeToASCII()
    assert writer.Write() == 1


def write_vtk_text(path, array):
    write_vtk(path, array, binary=False)


WRITERS = [("v.npy", write_npy), ("v.npy", write_npy_big), ("v.nrrd", write_nrrd), ("v.nrrd", write_nrrd_text), ("v.mha", write_metaimage),
           ("v.nii", write_nifti), ("v.h5", write_hdf5), ("v.h5", write_hdf5_big), ("v.nc", write_netcdf), ("v.nc", write_netcdf_classic),
           ("v.zarr", write_zarr), ("v.zarr", write_zarr_3), ("v.vti", write_vti), ("v.vti", write_vti_text), ("v.vtk", write_vtk),
           ("v.vtk", write_vtk_text)]


@pytest.mark.parametrize("dtype", TYPES)
@pytest.mark.parametrize("name,write", WRITERS, ids=lambda value: getattr(value, "__name__", ""))
def test_integers_that_float64_has_are_read_exactly(name, write, dtype, tmp_path):
    array = exact(dtype)
    write(tmp_path / name, array)
    samples, info = isoatlas.read(tmp_path / name)
    assert samples.dtype == np.float64 and [int(value) for value in samples.ravel()] == [int(value) for value in array.ravel()]
    assert any(f"{dtype} samples are read as float64" in note for note in info["notes"])


@pytest.mark.parametrize("dtype", TYPES)
@pytest.mark.parametrize("name,write", WRITERS, ids=lambda value: getattr(value, "__name__", ""))
def test_integers_that_float64_does_not_have_are_refused(name, write, dtype, tmp_path):
    array = exact(dtype)
    array[2, 3, 4] = 2**53 + 1
    write(tmp_path / name, array)
    with pytest.raises(isoatlas.UnsupportedError, match="9007199254740993"):
        isoatlas.read(tmp_path / name)


@pytest.mark.parametrize("format", ["NETCDF4", "NETCDF3_64BIT_DATA"])
@pytest.mark.parametrize("dtype,default", [("int64", -(2**63) + 2), ("uint64", 2**64 - 2)])
@pytest.mark.parametrize("fill", [None, -12345, 2**60 + 1])
def test_missing_integers_of_netcdf_are_nan(format, dtype, default, fill, tmp_path):
    if fill is not None and fill < 0 and dtype == "uint64":
        pytest.skip("no value of the type")
    array = exact(dtype)
    array[1, 2, 3] = default if fill is None else fill
    array[2, 2, 2] = 2**60  # rounds to the same float64 as one of the others
    write_netcdf(tmp_path / "v.nc", array, format, **({} if fill is None else {"fill_value": fill}))
    samples, _ = isoatlas.read(tmp_path / "v.nc", missing=0.25)
    assert samples[1, 2, 3] == 0.25 and np.count_nonzero(samples == 0.25) == 1


@pytest.mark.parametrize("fill", [-1, 2**60, 2**53 + 1, 2**64 - 1, 1.5, "NaN"])
@pytest.mark.parametrize("dtype", TYPES)
def test_fill_values_of_zarr(fill, dtype, tmp_path):
    write_zarr(tmp_path / "v.zarr", exact(dtype))
    metadata = json.loads((tmp_path / "v.zarr/.zarray").read_text())
    (tmp_path / "v.zarr/.zarray").write_text(json.dumps({**metadata, "fill_value": fill}))
    (tmp_path / "v.zarr/0.0.0").unlink()
    smallest, largest = (-(2**63), 2**63 - 1) if dtype == "int64" else (0, 2**64 - 1)
    is_of_type = isinstance(fill, int) and smallest <= fill <= largest
    if is_of_type and float(fill) == fill:
        assert (isoatlas.read(tmp_path / "v.zarr")[0] == fill).all()
    else:
        with pytest.raises(isoatlas.Error, match="float64 does not have" if is_of_type else "fill_value"):
            isoatlas.read(tmp_path / "v.zarr")


def test_labels_of_a_mask(tmp_path):
    mask = np.zeros((12, 12, 12), np.int64)
    mask[2:5, 2:5, 2:5], mask[7:10, 7:10, 7:10] = 1, 2
    np.save(tmp_path / "mask.npy", mask)
    atlas = isoatlas.open(tmp_path / "mask.npy")
    assert atlas.dtype == "float64" and len(np.unique(atlas.labels(0.5))) == 3
