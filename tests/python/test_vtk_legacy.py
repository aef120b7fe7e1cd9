"""Legacy VTK files as VTK writes them: grids, types, text and binary, arrays of points and cells, other arrays before the samples."""
import os
import pathlib

import numpy as np
import pytest

import isoatlas

vtk = pytest.importorskip("vtk")
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy  # noqa: E402

TYPES = ["uint8", "int8", "uint16", "int16", "uint32", "int32", "float32", "float64"]
SHAPE = (4, 3, 5)


def array_of(values, name):
    array = numpy_to_vtk(values.ravel() if values.ndim == 3 else values, deep=True)
    array.SetName(name)
    return array


def regular():
    grid = vtk.vtkImageData()
    grid.SetDimensions(SHAPE[::-1])
    grid.SetOrigin(1, 2, 3)
    grid.SetSpacing(0.5, 1, 2)
    return grid


def written(grid, writer, path, binary):
    writer.SetFileName(str(path))
    writer.SetInputData(grid)
    writer.SetFileTypeToBinary() if binary else writer.SetFileTypeToASCII()
    assert writer.Write() == 1
    return isoatlas.open(path)


def samples(dtype, shape=SHAPE):
    """Numbers that text of six digits has."""
    quarters = np.random.default_rng(1).integers(0, 400, shape)
    return (quarters / 4 if dtype.startswith("float") else quarters % 100).astype(dtype)


@pytest.mark.parametrize("binary", [True, False])
@pytest.mark.parametrize("dtype", TYPES)
def test_regular_grids_of_every_type(dtype, binary, tmp_path):
    grid, values = regular(), samples(dtype)
    grid.GetPointData().SetScalars(array_of(values, "values"))
    atlas = written(grid, vtk.vtkStructuredPointsWriter(), tmp_path / "v.vtk", binary)
    if dtype == "uint8" and not binary:  # VTK writes these as COLOR_SCALARS: 255th parts
        assert np.allclose(255 * atlas.volume, values, atol=1e-3) and isoatlas.open(tmp_path / "v.vtk").range[1] == pytest.approx(values.max())
    else:
        assert np.array_equal(atlas.volume, values) and atlas.volume.dtype == values.dtype
    assert list(atlas.info["spacing"]) == [0.5, 1, 2] and list(atlas.info["origin"]) == [1, 2, 3]


@pytest.mark.parametrize("binary", [True, False])
def test_other_arrays_before_the_samples(binary, tmp_path):
    grid, values = regular(), samples("float32")
    cells = samples("float64", tuple(n - 1 for n in SHAPE))
    count = values.size
    grid.GetCellData().SetScalars(array_of(cells, "of cells"))
    grid.GetPointData().SetVectors(array_of(np.ones((count, 3), "float32"), "vectors"))
    grid.GetPointData().SetNormals(array_of(np.ones((count, 3), "float64"), "normals"))
    grid.GetPointData().AddArray(array_of(np.ones((count, 2), "int32"), "pairs"))
    grid.GetPointData().AddArray(array_of(values, "values"))
    grid.GetFieldData().AddArray(array_of(np.arange(7.0), "more"))
    atlas = written(grid, vtk.vtkStructuredPointsWriter(), tmp_path / "v.vtk", binary)
    assert np.array_equal(atlas.volume, values)
    grid.GetPointData().Initialize()
    atlas = written(grid, vtk.vtkStructuredPointsWriter(), tmp_path / "c.vtk", binary)
    assert np.array_equal(atlas.volume, cells) and list(atlas.info["origin"]) == [1.25, 2.5, 4]


@pytest.mark.parametrize("binary", [True, False])
def test_rectilinear_grids(binary, tmp_path):
    grid, values = vtk.vtkRectilinearGrid(), samples("int16")
    lines = [np.float32([0, 1, 3, 7, 8]), np.float64([-1, 0, 5]), np.float32([2, 3, 4, 6])]
    grid.SetDimensions(SHAPE[::-1])
    for place, line in zip((grid.SetXCoordinates, grid.SetYCoordinates, grid.SetZCoordinates), lines):
        place(array_of(line, "line"))
    grid.GetPointData().SetScalars(array_of(values, "values"))
    atlas = written(grid, vtk.vtkRectilinearGridWriter(), tmp_path / "v.vtk", binary)
    assert np.array_equal(atlas.volume, values)
    mesh = atlas.surface(50, boundary="open")
    assert mesh.points[:, 0].max() <= 8 and mesh.points[:, 2].min() >= 2


def test_other_grids_and_damage_are_refused(tmp_path):
    grid, values = regular(), samples("float32")
    grid.GetPointData().SetScalars(array_of(values, "values"))
    written(grid, vtk.vtkStructuredPointsWriter(), tmp_path / "v.vtk", True)
    whole = (tmp_path / "v.vtk").read_bytes()
    (tmp_path / "cut.vtk").write_bytes(whole[:-30])
    with pytest.raises(isoatlas.InputError, match="ends inside 'values'"):
        isoatlas.open(tmp_path / "cut.vtk")
    (tmp_path / "mesh.vtk").write_bytes(whole.replace(b"STRUCTURED_POINTS", b"POLYDATA"))
    with pytest.raises(isoatlas.UnsupportedError, match="Resample To Image"):
        isoatlas.open(tmp_path / "mesh.vtk")
    (tmp_path / "count.vtk").write_bytes(whole.replace(b"POINT_DATA 60", b"POINT_DATA 61"))
    with pytest.raises(isoatlas.InputError, match="61 values on a grid with 60"):
        isoatlas.open(tmp_path / "count.vtk")


def test_the_grid_of_the_shared_data_is_what_vtk_reads():
    path = pathlib.Path(os.environ["ISOATLAS_SOURCE"]).parent / "shared" / "data" / "formats" / "RectGrid2.vtk"
    if not path.exists():
        pytest.skip("no shared data beside the checkout")
    reader = vtk.vtkRectilinearGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    grid, volume = reader.GetOutput(), isoatlas.open(path).volume
    assert volume.shape == grid.GetDimensions()[::-1]
    assert np.array_equal(volume.ravel(), vtk_to_numpy(grid.GetPointData().GetArray("scalars")))
