"""DICOM against pydicom, which writes the series and decodes the same files."""
import os
import pathlib
import random

import numpy as np
import pytest

import isoatlas

pydicom = pytest.importorskip("pydicom")
from pydicom.dataset import Dataset, FileMetaDataset  # noqa: E402
from pydicom.sequence import Sequence  # noqa: E402
from pydicom.uid import ExplicitVRBigEndian, ExplicitVRLittleEndian, ImplicitVRLittleEndian, RLELossless, generate_uid  # noqa: E402

SHARED = pathlib.Path(os.environ.get("ISOATLAS_SOURCE", ".")).resolve().parent / "shared/data/formats/dicom"
SERIES = generate_uid()


def data_set(array, position=(0, 0, 0), orientation=(1, 0, 0, 0, 1, 0), spacing=(0.5, 0.25), syntax=ExplicitVRLittleEndian, **more):
    ds = Dataset()
    ds.file_meta = FileMetaDataset()
    ds.file_meta.TransferSyntaxUID = syntax
    ds.is_little_endian, ds.is_implicit_VR = syntax != ExplicitVRBigEndian, syntax == ImplicitVRLittleEndian
    ds.SOPClassUID, ds.SOPInstanceUID, ds.SeriesInstanceUID = "1.2.840.10008.5.1.4.1.1.4", generate_uid(), SERIES
    ds.PatientName, ds.PatientID, ds.PatientBirthDate, ds.InstitutionName = "SECRET^NAME", "SECRETID", "19000101", "SECRET CLINIC"
    ds.Modality, ds.Rows, ds.Columns = "MR", *array.shape[-2:]
    ds.ImagePositionPatient, ds.ImageOrientationPatient, ds.PixelSpacing = list(map(float, position)), list(map(float, orientation)), list(spacing)
    ds.SamplesPerPixel, ds.PhotometricInterpretation = 1, "MONOCHROME2"
    bits = 8 * array.dtype.itemsize
    ds.BitsAllocated, ds.BitsStored, ds.HighBit, ds.PixelRepresentation = bits, bits, bits - 1, int(array.dtype.kind == "i")
    ds.PixelData = array.astype(array.dtype.newbyteorder("<" if ds.is_little_endian else ">")).tobytes()
    ds["PixelData"].VR = "OW"
    for name, value in more.items():
        setattr(ds, name, value)
    return ds


def write(ds, path):
    pydicom.dcmwrite(path, ds, write_like_original=False)


def write_series(folder, array, places, **options):
    names = [f"IM{i:04}" for i in range(len(places))]
    random.Random(1).shuffle(names)
    for z, (name, place) in enumerate(zip(names, places)):
        write(data_set(array[z], place, InstanceNumber=(7 * z) % len(places), **options), folder / name)


@pytest.mark.parametrize("dtype", ["uint8", "int16", "uint16"])
@pytest.mark.parametrize("syntax", [ExplicitVRLittleEndian, ImplicitVRLittleEndian, ExplicitVRBigEndian])
def test_series_are_sorted_by_place(tmp_path, dtype, syntax):
    array = np.random.default_rng(1).integers(0, 100, (6, 5, 4)).astype(dtype)
    write_series(tmp_path, array, [(1, 2, 3 - 1.5 * z) for z in range(6)], syntax=syntax)
    atlas = isoatlas.open(tmp_path)
    assert np.array_equal(atlas.volume, array[::-1])
    assert np.allclose(atlas.info["spacing"], (0.25, 0.5, 1.5)) and np.allclose(atlas.info["origin"], (1, 2, 3 - 7.5))
    assert atlas.info["unit"] == "mm" and "SECRET" not in repr(atlas.info) and SERIES not in repr(atlas.info)


def test_run_lengths(tmp_path):
    array = np.random.default_rng(2).integers(-300, 300, (12, 9)).astype("int16")
    ds = data_set(array)
    ds.compress(RLELossless)
    write(ds, tmp_path / "v.dcm")
    assert np.array_equal(isoatlas.open(tmp_path / "v.dcm").volume, array)


def test_slopes_of_slices(tmp_path):
    array = np.random.default_rng(3).integers(0, 1000, (3, 5, 4)).astype("uint16")
    for z in range(3):
        write(data_set(array[z], (0, 0, z), RescaleSlope=z + 0.5, RescaleIntercept=-z), tmp_path / str(z))
    expected = np.stack([array[z] * (z + 0.5) - z for z in range(3)]).astype("float32")
    assert np.array_equal(isoatlas.open(tmp_path).volume, expected)


@pytest.mark.parametrize("places, says", [([0, 1, 2, 5, 6], "2 slices are missing"), ([0, 1, 1, 2, 3], "1 place has more")])
def test_gaps_and_doubles(tmp_path, places, says):
    write_series(tmp_path, np.zeros((5, 4, 3), "uint8"), [(0, 0, z) for z in places])
    with pytest.raises(isoatlas.Error, match=says) as raised:
        isoatlas.open(tmp_path)
    assert "SECRET" not in str(raised.value)


def test_enhanced_frames(tmp_path):
    array = np.random.default_rng(4).integers(0, 1000, (4, 5, 6)).astype("uint16")
    ds = data_set(array, NumberOfFrames=4)
    del ds.ImagePositionPatient, ds.ImageOrientationPatient, ds.PixelSpacing
    shared, orientation, measures = Dataset(), Dataset(), Dataset()
    orientation.ImageOrientationPatient, measures.PixelSpacing = [0, 1, 0, 0, 0, -1], [2, 3]
    shared.PlaneOrientationSequence, shared.PixelMeasuresSequence = Sequence([orientation]), Sequence([measures])
    ds.SharedFunctionalGroupsSequence, ds.PerFrameFunctionalGroupsSequence = Sequence([shared]), Sequence()
    order = [2, 0, 3, 1]
    for place in order:  # the normal points to -x
        frame, position = Dataset(), Dataset()
        position.ImagePositionPatient = [-4 * place, 0, 0]
        frame.PlanePositionSequence = Sequence([position])
        ds.PerFrameFunctionalGroupsSequence.append(frame)
    write(ds, tmp_path / "v")
    atlas = isoatlas.open(tmp_path / "v")
    assert np.array_equal(atlas.volume, array[np.argsort(order)])
    assert np.allclose(atlas.info["spacing"], (3, 2, 4))


@pytest.mark.skipif(not SHARED.is_dir(), reason="no shared data beside the checkout")
def test_files_of_pydicom():
    reference = pydicom.dcmread(SHARED / "single/MR_small.dcm").pixel_array
    for path in sorted((SHARED / "single").iterdir()):
        expected = reference if path.name.startswith("MR") else pydicom.dcmread(path).pixel_array
        assert np.array_equal(isoatlas.open(path).volume, expected), path.name
    stack = sorted((pydicom.dcmread(path) for path in (SHARED / "series/98892001/CT5N").iterdir()), key=lambda ds: ds.ImagePositionPatient[2])
    atlas = isoatlas.open(SHARED / "series/98892001/CT5N")
    assert np.array_equal(atlas.volume, np.stack([ds.pixel_array for ds in stack]))
    assert np.allclose(atlas.info["origin"], stack[0].ImagePositionPatient)
    with pytest.raises(isoatlas.Error, match="161 slices are missing"):
        isoatlas.open(SHARED / "series/77654033/CT2")


def test_nothing_about_the_patient_is_written(tmp_path):
    (tmp_path / "in").mkdir()
    array = np.random.default_rng(5).integers(0, 100, (6, 7, 8)).astype("uint16")
    write_series(tmp_path / "in", array, [(0, 0, z) for z in range(6)], SeriesDescription="SECRET TEXT")
    atlas = isoatlas.open(tmp_path / "in")
    atlas.save(tmp_path / "out.nrrd")
    for path in tmp_path.glob("out*"):
        content = path.read_bytes()
        assert b"SECRET" not in content and SERIES.encode() not in content and b"19000101" not in content
