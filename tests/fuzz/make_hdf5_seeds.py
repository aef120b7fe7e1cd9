#!/usr/bin/python3
"""Writes the seeds of the HDF5 and NetCDF targets into tests/fuzz/corpus with h5py and netCDF4 (the files are committed; this says how they were made)."""
import pathlib

import h5py
import netCDF4
import numpy as np

CORPUS = pathlib.Path(__file__).parent / "corpus"
SAMPLES = np.arange(24, dtype="<u2").reshape(4, 3, 2)


def hdf5(name, **options):
    (CORPUS / "hdf5_volume").mkdir(parents=True, exist_ok=True)
    return h5py.File(CORPUS / "hdf5_volume" / name, "w", **options)


def netcdf(name, format):
    (CORPUS / "netcdf").mkdir(parents=True, exist_ok=True)
    return netCDF4.Dataset(CORPUS / "netcdf" / name, "w", format=format)


def main():
    with hdf5("plain") as file:
        file["v"] = SAMPLES
    with hdf5("new", libver="latest") as file:
        file["g/v"] = SAMPLES.astype(">f4")
        file["g/again"] = h5py.SoftLink("/g")
    with hdf5("packed", userblock_size=512) as file:
        file.create_dataset("v", data=SAMPLES, chunks=(2, 2, 2), compression="gzip", shuffle=True, fletcher32=True, maxshape=(None, 3, 2))
    with hdf5("links") as file:
        file["v"] = SAMPLES.astype("f2")
        file["w"] = SAMPLES[0]
        file["out"] = h5py.ExternalLink("../other.h5", "/v")
        file["self"] = h5py.ExternalLink("links", "/")
        file["loop"] = h5py.SoftLink("/loop")
    with hdf5("virtual") as file:
        layout = h5py.VirtualLayout((2, 3, 2), "<u2")
        layout[0], layout[1] = h5py.VirtualSource("a", "v", shape=(3, 2)), h5py.VirtualSource(".", "own", shape=(3, 2))
        file["own"] = SAMPLES[0]
        file.create_virtual_dataset("v", layout)
    with hdf5("virtual_circle") as file:
        for own, source in ("v", "w"), ("w", "v"):
            layout = h5py.VirtualLayout((3, 2), "<u2")
            layout[:] = h5py.VirtualSource(".", source, shape=(3, 2))
            file.create_virtual_dataset(own, layout)
    with hdf5("nexus") as file:
        group = file.create_group("entry/data")
        group["v"], group["y"], group["x"] = SAMPLES[:, :, 0], [4.0, 3, 2, 1], [0.0, 1, 4]
        group["y"].attrs["units"] = "mm"
        group.attrs["signal"], group.attrs["axes"] = "v", ["y", "x"]
        file.attrs["default"] = "entry"
        file["entry"].attrs["default"] = "data"
    characters = lambda text: np.frombuffer(text.encode(), "S1")
    with hdf5("imaris") as file:
        for level in (0, 1):
            group = file.create_group(f"DataSet/ResolutionLevel {level}/TimePoint 0/Channel 0")
            group["Data"] = SAMPLES[::level + 1]
            for axis, size in zip("XYZ", (2, 3, 3 - level)):
                group.attrs[f"ImageSize{axis}"] = characters(str(size))
        image = file.create_group("DataSetInfo/Image")
        for i in range(3):
            image.attrs[f"ExtMin{i}"], image.attrs[f"ExtMax{i}"] = characters("1"), characters("9.5")
        file.create_group("DataSetInfo/TimeInfo").attrs["TimePoint1"] = characters("2020-02-29 23:59:59.5")
        file.create_group("DataSetInfo/Channel 0").attrs["Name"] = characters("red")
    with hdf5("openpmd") as file:
        file.attrs["openPMD"], file.attrs["meshesPath"] = np.bytes_("1.1.0"), np.bytes_("meshes/")
        for step in ("1", "20"):
            file[f"data/{step}/meshes/E/x"] = SAMPLES
            mesh = file[f"data/{step}/meshes/E"]
            mesh.attrs["gridSpacing"], mesh.attrs["gridGlobalOffset"], mesh.attrs["gridUnitSI"] = [1.0, 2, 3], [0.0, 0, 1], 1e-6
            mesh.attrs["axisLabels"], mesh["x"].attrs["position"], mesh["x"].attrs["unitSI"] = ["x", "y", "z"], [0.5, 0, 0], 2.0
    with hdf5("viewer") as file:
        file["s00/resolutions"] = [[1.0, 1, 1], [2, 2, 1]]
        file["t00000/s00/0/cells"], file["t00000/s00/1/cells"] = SAMPLES.astype("i2"), SAMPLES[:, :2, :1].astype("i2")
    with hdf5("vtk") as file:
        group = file.create_group("VTKHDF")
        group["PointData/a"] = np.stack([SAMPLES, SAMPLES])
        group["Steps/Values"] = [0.0, 1.5]
        group["Steps"].attrs["NSteps"] = 2
        group.attrs["Version"], group.attrs["Type"], group.attrs["WholeExtent"] = [2, 0], np.bytes_("ImageData"), [1, 2, 0, 2, 0, 3]
    for name, format in (("classic", "NETCDF3_CLASSIC"), ("offset", "NETCDF3_64BIT_OFFSET"), ("data", "NETCDF3_64BIT_DATA")):
        for records in (False, True):
            with netcdf(name + ("_records" if records else ""), format) as file:
                for dimension, size in (("time", None if records else 2), ("one", 1), ("y", 3), ("x", 4)):
                    file.createDimension(dimension, size)
                variable = file.createVariable("v", "i2", ("time", "one", "y", "x"), fill_value=-1)
                variable.scale_factor, variable.units, variable.coordinates = 0.5, "K", "place"
                variable.set_auto_maskandscale(False)
                variable[:] = SAMPLES.reshape(2, 1, 3, 4)
                file.createVariable("place", "f4", ("y", "x"))[:] = 1
                file.createVariable("x", "f8", ("x",))[:] = [8, 4, 2, 1]
                time = file.createVariable("time", "f8", ("time",))
                time.units = "days since 2000-01-01"
                time[:] = [0, 1]


main()
