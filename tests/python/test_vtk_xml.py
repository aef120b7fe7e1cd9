"""VTK XML files as VTK writes them: types, ways of storing, compressors, extents, directions, arrays of points and cells."""
import numpy as np
import pytest

import isoatlas

vtk = pytest.importorskip("vtk")
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy  # noqa: E402

TYPES = ["uint8", "int8", "uint16", "int16", "uint32", "int32", "float32", "float64"]
SHAPE = (20, 30, 40)  # more than a block of each compressor
COMPRESSORS = [None, "ZLib", "LZ4"]


def samples(dtype, shape=SHAPE):
    return np.random.default_rng(1).integers(0, 100, shape).astype(dtype)


def image(values):
    grid = vtk.vtkImageData()
    grid.SetDimensions(values.shape[::-1])
    grid.SetOrigin(1, 2, 3)
    grid.SetSpacing(0.5, 1, 2)
    array = numpy_to_vtk(values.ravel(), deep=True)
    array.SetName("values")
    grid.GetPointData().SetScalars(array)
    return grid


def write(writer, data, path, mode="Appended", compressor=None, encoded=False):
    writer.SetFileName(str(path))
    writer.SetInputData(data)
    getattr(writer, f"SetDataModeTo{mode}")()
    if compressor is None:
        writer.SetCompressor(None)
    else:
        getattr(writer, f"SetCompressorTypeTo{compressor}")()
    writer.SetEncodeAppendedData(encoded)
    assert writer.Write() == 1


@pytest.mark.parametrize("compressor", COMPRESSORS)
@pytest.mark.parametrize("mode", ["Ascii", "Binary", "Appended"])
@pytest.mark.parametrize("dtype", TYPES)
def test_images_of_every_type_and_way(dtype, mode, compressor, tmp_path):
    values = samples(dtype)
    for encoded in (False, True):
        for big_endian in (False, True):
            for header in (32, 64):
                writer = vtk.vtkXMLImageDataWriter()
                writer.SetByteOrder(0 if big_endian else 1)
                writer.SetHeaderType(header)
                write(writer, image(values), tmp_path / "v.vti", mode, compressor, encoded)
                atlas = isoatlas.open(tmp_path / "v.vti")
                assert np.array_equal(atlas.volume, values) and atlas.volume.dtype == values.dtype
                assert list(atlas.info["spacing"]) == [0.5, 1, 2] and list(atlas.info["origin"]) == [1, 2, 3]


@pytest.mark.parametrize("size", [1 << 12, 1 << 16, 1 << 22])
@pytest.mark.parametrize("compressor", COMPRESSORS[1:])
def test_blocks_of_other_sizes(compressor, size, tmp_path):
    values = samples("uint16", (30, 40, 1024))
    writer = vtk.vtkXMLImageDataWriter()
    writer.SetBlockSize(size)
    write(writer, image(values), tmp_path / "v.vti", "Appended", compressor)
    assert np.array_equal(isoatlas.open(tmp_path / "v.vti").volume, values)


def test_a_compressor_that_is_not_read(tmp_path):
    write(vtk.vtkXMLImageDataWriter(), image(samples("uint8")), tmp_path / "v.vti", "Appended", "LZMA")
    with pytest.raises(isoatlas.errors.UnsupportedError, match="zlib or LZ4"):
        isoatlas.open(tmp_path / "v.vti")


@pytest.mark.parametrize("compressor", COMPRESSORS)
@pytest.mark.parametrize("mode", ["Ascii", "Binary", "Appended"])
def test_meshes(mode, compressor, tmp_path):
    sphere = vtk.vtkSphereSource()
    sphere.SetThetaResolution(60)
    sphere.SetPhiResolution(60)
    sphere.Update()
    data = sphere.GetOutput()
    write(vtk.vtkXMLPolyDataWriter(), data, tmp_path / "v.vtp", mode, compressor)
    mesh = isoatlas.read_mesh(tmp_path / "v.vtp")
    points = vtk_to_numpy(data.GetPoints().GetData())
    if mode == "Ascii":
        assert np.allclose(mesh.points, points, atol=1e-6)
    else:
        assert np.array_equal(mesh.points, points)
    triangles = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    assert np.array_equal(mesh.triangles, triangles)
