"""Reading all samples of a file, against the library that the format is known by, in turns: into memory, from the page cache."""
import argparse
import json
import statistics
import sys
import time
from pathlib import Path

import numpy

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from runs import add_options, ours

ARRAY = "smooth-256"


def with_h5py(array, path, **options):
    import h5py
    with h5py.File(path, "w") as file:
        file.create_dataset("a", data=array, **options)
    return lambda: h5py.File(path, "r")["a"][...]


def with_zarr(array, path, **options):
    import zarr
    zarr.save_array(str(path), array, chunks=(64, 64, 64), **options)
    return lambda: zarr.open(str(path), "r")[...]


def with_netcdf(array, path, **options):
    import netCDF4
    with netCDF4.Dataset(path, "w", format=options.pop("format", "NETCDF4")) as file:
        for name, size in zip("zyx", array.shape):
            file.createDimension(name, size)
        file.createVariable("a", array.dtype, ("z", "y", "x"), **options)[:] = array

    def read():
        with netCDF4.Dataset(path) as file:
            file.set_auto_maskandscale(False)
            return file["a"][:]
    return read


def with_tifffile(array, path, **options):
    import tifffile
    tifffile.imwrite(path, array, **options)
    return lambda: tifffile.imread(path)


def with_mrcfile(array, path):
    import mrcfile
    with mrcfile.new(path, overwrite=True) as file:
        file.set_data(array)
    return lambda: numpy.array(mrcfile.open(path, permissive=True).data)


def with_nibabel(array, path):
    import nibabel
    nibabel.save(nibabel.Nifti1Image(array.T, numpy.eye(4)), path)
    return lambda: numpy.asarray(nibabel.load(path).dataobj).T


def with_pydicom(array, folder):
    import pydicom
    from pydicom.uid import CTImageStorage, ExplicitVRLittleEndian, generate_uid
    folder.mkdir(exist_ok=True)
    series, frame = generate_uid(), generate_uid()
    for z, slice_ in enumerate(array):
        meta = pydicom.dataset.FileMetaDataset()
        meta.MediaStorageSOPClassUID, meta.MediaStorageSOPInstanceUID, meta.TransferSyntaxUID = CTImageStorage, generate_uid(), ExplicitVRLittleEndian
        file = pydicom.dataset.FileDataset(str(folder / f"{z}.dcm"), {}, file_meta=meta, preamble=b"\0" * 128)
        file.is_little_endian, file.is_implicit_VR = True, False
        file.SOPClassUID, file.SOPInstanceUID, file.SeriesInstanceUID, file.FrameOfReferenceUID = CTImageStorage, meta.MediaStorageSOPInstanceUID, series, frame
        file.Modality, file.InstanceNumber = "CT", z + 1
        file.Rows, file.Columns, file.PixelSpacing = array.shape[1], array.shape[2], [1, 1]
        file.ImagePositionPatient, file.ImageOrientationPatient = [0, 0, z], [1, 0, 0, 0, 1, 0]
        file.SamplesPerPixel, file.PhotometricInterpretation, file.PixelRepresentation = 1, "MONOCHROME2", 0
        file.BitsAllocated, file.BitsStored, file.HighBit = 16, 16, 15
        file.PixelData = slice_.tobytes()
        file.save_as(folder / f"{z}.dcm")

    def read():
        slices = [pydicom.dcmread(path) for path in folder.iterdir()]
        slices.sort(key=lambda one: one.ImagePositionPatient[2])
        return numpy.stack([one.pixel_array for one in slices])
    return read


def blosc():
    import numcodecs
    return numcodecs.Blosc("lz4", shuffle=1)


FORMATS = [
    ("HDF5, contiguous", "h5py", "a.h5", with_h5py, dict),
    ("HDF5, chunks, gzip, shuffle", "h5py", "b.h5", with_h5py, lambda: {"chunks": (64, 64, 64), "compression": "gzip", "shuffle": True}),
    ("HDF5, chunks, LZF", "h5py", "c.h5", with_h5py, lambda: {"chunks": (64, 64, 64), "compression": "lzf"}),
    ("Zarr, blosc lz4", "zarr", "a.zarr", with_zarr, lambda: {"compressor": blosc()}),
    ("Zarr, not compressed", "zarr", "b.zarr", with_zarr, lambda: {"compressor": None}),
    ("NetCDF classic", "netCDF4", "a.nc", with_netcdf, lambda: {"format": "NETCDF3_64BIT_OFFSET"}),
    ("NetCDF 4, zlib", "netCDF4", "b.nc", with_netcdf, lambda: {"zlib": True, "chunksizes": (64, 64, 64)}),
    ("TIFF", "tifffile", "a.tif", with_tifffile, dict),
    ("TIFF, zlib", "tifffile", "b.tif", with_tifffile, lambda: {"compression": "zlib"}),
    ("MRC", "mrcfile", "a.mrc", with_mrcfile, dict),
    ("NIfTI, gzip", "nibabel", "a.nii.gz", with_nibabel, dict),
    ("DICOM, 256 files", "pydicom", "dicom", with_pydicom, dict),
]


def measure(arguments, array, name, library, file, make, options):
    path = Path(arguments.cache) / "formats" / file
    is_dicom = name.startswith("DICOM")
    if is_dicom:
        low, high = float(array.min()), float(array.max())
        array = ((array - low) / (high - low) * 65535).astype(numpy.uint16)
    try:
        read = make(array, path, **options())
    except ImportError as missing:
        return {"file": name, "library": f"{library} is not installed: {missing.name}"}
    samples = path.parent / "samples.raw"
    ours(arguments.program, path, 1, samples)
    got = numpy.fromfile(samples, array.dtype).reshape(array.shape)
    samples.unlink()
    if not numpy.array_equal(got, array) or not numpy.array_equal(numpy.asarray(read()), array):
        sys.exit(f"{name}: the samples differ")
    own, theirs, peak = [], [], 0
    for _ in range(arguments.pairs):
        begin = time.perf_counter()
        read()
        theirs.append(time.perf_counter() - begin)
        done = ours(arguments.program, path, 2)
        own.append(min(done["seconds"]))
        peak = max(peak, done["peak"] - done["bytes"])
    return {"file": name, "library": library, "library, s": statistics.median(theirs), "isoatlas, s": statistics.median(own),
            "isoatlas / library": statistics.median(a / b for a, b in zip(own, theirs)), "peak beside the samples, MB": round(peak / 1e6)}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    add_options(parser, [ARRAY], pairs=7)
    arguments = parser.parse_args()
    folder = Path(arguments.cache) / "formats"
    folder.mkdir(parents=True, exist_ok=True)
    side = int((arguments.volumes or [ARRAY])[0].split("-")[1])
    grid = numpy.linspace(0, 6, side, dtype=numpy.float32)
    rng = numpy.random.default_rng(1)  # smooth values with noise in their last bits, as measured ones have
    array = numpy.sin(grid)[:, None, None] * numpy.cos(grid * 1.7)[None, :, None] + numpy.sin(grid * 2.3)[None, None, :]
    array = (array + rng.normal(0, 1e-3, array.shape)).astype(numpy.float32)
    records = []
    for name, library, file, make, options in FORMATS:
        records.append(measure(arguments, array, name, library, file, make, options))
        print(records[-1], flush=True)
    document = {"pairs": arguments.pairs, "side": side, "formats": records}
    if arguments.json:
        Path(arguments.json).write_text(json.dumps(document, indent=1))


if __name__ == "__main__":
    main()
