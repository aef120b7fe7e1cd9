"""TIFF files of tifffile: OME-TIFF, hyperstacks of ImageJ, pyramids, colours, sample by sample and axis by axis; and hostile ones."""
import itertools
import os
import struct
import subprocess

import numpy as np
import pytest

import isoatlas
from conftest import CLI

tifffile = pytest.importorskip("tifffile")

TYPES = ["uint8", "int8", "uint16", "int16", "uint32", "int32", "float32", "float64"]
BT601 = (19595, 38470, 7471)


def samples(dtype, shape, seed=1):
    return np.random.default_rng(seed).integers(0, 100, shape).astype(dtype)


def expect(path, array, **options):
    atlas = isoatlas.open(path, **options)
    assert atlas.volume.dtype == array.dtype.newbyteorder("=") and np.array_equal(atlas.volume, array)
    return atlas


def planes(array, axes, **chosen):
    """The part of an array with these axes, as (z, y, x) or (y, x)."""
    return array[tuple(chosen.get(axis, slice(None)) for axis in axes)]


@pytest.mark.parametrize("options", [{}, {"bigtiff": True}, {"tile": (16, 32)}, {"compression": "zlib"}, {"compression": "zlib", "tile": (16, 16)},
                                     {"rowsperstrip": 5}], ids=str)
@pytest.mark.parametrize("byteorder", "<>")
@pytest.mark.parametrize("dtype", TYPES)
def test_ome_of_every_type_and_layout(dtype, byteorder, options, tmp_path):
    array = samples(dtype, (2, 3, 4, 19, 35))
    path = tmp_path / "v.ome.tif"
    tifffile.imwrite(path, array, ome=True, byteorder=byteorder, photometric="minisblack", **options,
                     metadata={"axes": "TCZYX", "PhysicalSizeX": 0.5, "PhysicalSizeY": 0.25, "PhysicalSizeZ": 2, "PhysicalSizeXUnit": "nm",
                               "PhysicalSizeYUnit": "nm", "PhysicalSizeZUnit": "nm", "TimeIncrement": 3, "TimeIncrementUnit": "min",
                               "Channel": {"Name": ["dapi", "gfp", "actin"]}})
    for t, (c, name) in itertools.product(range(2), enumerate(["dapi", "GFP", "2"])):
        atlas = expect(path, array[t, c], time_step=t, channel=name)
    assert atlas.info["unit"] == "nm" and atlas.info["spacing"] == [0.5, 0.25, 2]


@pytest.mark.parametrize("axes", ["ZCTYX", "TZCYX", "CTZYX", "CZTYX", "TCZYX", "ZTCYX"])
def test_every_order_of_dimensions(axes, tmp_path):
    sizes = {"T": 2, "C": 3, "Z": 4, "Y": 5, "X": 6}
    array = samples("uint16", tuple(sizes[axis] for axis in axes))
    tifffile.imwrite(tmp_path / "v.ome.tif", array, ome=True, photometric="minisblack", metadata={"axes": axes})
    for t, c in itertools.product(range(2), range(3)):
        part = planes(array, axes, T=t, C=c)
        expect(tmp_path / "v.ome.tif", part, time_step=t, channel=str(c))


def test_units_of_ome(tmp_path):
    array = samples("uint8", (3, 5, 6))
    tifffile.imwrite(tmp_path / "v.ome.tif", array, ome=True, metadata={"axes": "ZYX", "PhysicalSizeX": 0.5, "PhysicalSizeY": 0.5, "PhysicalSizeZ": 2000, "PhysicalSizeZUnit": "nm"})
    info = isoatlas.open(tmp_path / "v.ome.tif").info
    assert info["unit"] == "µm" and np.allclose(info["spacing"], (0.5, 0.5, 2))


def test_several_images_are_series(tmp_path):
    one, other = samples("uint16", (3, 8, 9)), samples("float32", (2, 4, 5, 6))
    with tifffile.TiffWriter(tmp_path / "v.ome.tif", ome=True) as file:
        file.write(one, photometric="minisblack", metadata={"axes": "ZYX", "Name": "whole"})
        file.write(other, photometric="minisblack", metadata={"axes": "CZYX", "Name": "part"})
    expect(tmp_path / "v.ome.tif", one, series="whole")
    expect(tmp_path / "v.ome.tif", other[1], series="1", channel="1")
    with pytest.raises(isoatlas.Error) as error:
        isoatlas.open(tmp_path / "v.ome.tif")
    assert error.value.reason == "series_needed"


@pytest.mark.parametrize("byteorder", "<>")
@pytest.mark.parametrize("dtype", ["uint8", "uint16", "float32"])
def test_hyperstacks_of_imagej(dtype, byteorder, tmp_path):
    array = samples(dtype, (2, 4, 3, 7, 8))
    labels = ["red", "blue", "far red"] * 8
    tifffile.imwrite(tmp_path / "v.tif", array, imagej=True, byteorder=byteorder, resolution=(4, 2),
                     metadata={"axes": "TZCYX", "spacing": 2.5, "unit": "um", "finterval": 0.5, "Labels": labels})
    for t, (c, name) in itertools.product(range(2), enumerate(["red", "blue", "far red"])):
        atlas = expect(tmp_path / "v.tif", array[t, :, c], time_step=t, channel=name)
    assert atlas.info["unit"] == "µm" and np.allclose(atlas.info["spacing"], (0.25, 0.5, 2.5))


def test_pages_behind_one_directory(tmp_path):
    """As ImageJ writes above 4 GB: one directory, then all pixels."""
    array = samples("uint16", (4, 3, 7, 8))
    tifffile.imwrite(tmp_path / "v.tif", array, imagej=True, metadata={"axes": "ZCYX"})
    content = bytearray((tmp_path / "v.tif").read_bytes())
    with tifffile.TiffFile(tmp_path / "v.tif") as file:
        page = file.pages[0]
        link = page.offset + 2 + 12 * len(page.tags)
        assert [one.dataoffsets[0] - page.dataoffsets[0] for one in file.pages] == [112 * i for i in range(12)]
    struct.pack_into(file.byteorder + "I", content, link, 0)
    (tmp_path / "v.tif").write_bytes(content)
    for c in range(3):
        expect(tmp_path / "v.tif", array[:, c].astype("uint16"), channel=str(c))


@pytest.mark.parametrize("shape", [(3, 64, 96), (3, 65, 97)])
def test_levels_of_a_pyramid(shape, tmp_path):
    levels = [samples("uint16", shape)]
    for _ in range(2):
        levels.append(levels[-1][:, ::2, ::2])
    with tifffile.TiffWriter(tmp_path / "v.ome.tif", ome=True, bigtiff=True) as file:
        for i, level in enumerate(levels):
            extra = {"subifds": 2, "metadata": {"axes": "ZYX", "PhysicalSizeX": 0.5, "PhysicalSizeY": 0.5, "PhysicalSizeZ": 2}} if i == 0 else {"subfiletype": 1}
            file.write(level, tile=(16, 16), photometric="minisblack", **extra)
    for i, level in enumerate(levels):
        info = expect(tmp_path / "v.ome.tif", level, level=i).info
        assert np.allclose(info["spacing"], (0.5 * 2**i, 0.5 * 2**i, 2))
        assert np.allclose(info["origin"], (0.25 * (2**i - 1), 0.25 * (2**i - 1), 0))
    with pytest.raises(isoatlas.Error) as error:
        isoatlas.open(tmp_path / "v.ome.tif", level=3)
    assert error.value.reason == "no_such_level"


@pytest.mark.parametrize("options", [{}, {"ome": True}, {"planarconfig": "separate"}, {"tile": (16, 16)}, {"planarconfig": "separate", "tile": (16, 16)},
                                     {"compression": "zlib"}], ids=str)
@pytest.mark.parametrize("dtype", ["uint8", "uint16", "float32"])
def test_colours(dtype, options, tmp_path):
    array = (samples(dtype, (4, 20, 21, 3)) * 2).astype(dtype)
    stored = np.moveaxis(array, -1, 1) if options.get("planarconfig") == "separate" else array
    more = {"metadata": {"axes": "ZYXS"}} if options.get("ome") else {}
    tifffile.imwrite(tmp_path / "v.tif", stored, photometric="rgb", **options, **more)
    for i, colour in enumerate(["red", "green", "blue"]):
        expect(tmp_path / "v.tif", array[..., i], channel=colour)
    if dtype == "float32":
        wanted = sum(weight / 65536 * array[..., i].astype("float64") for i, weight in enumerate(BT601)).astype("float32")
    else:
        wanted = ((sum(weight * array[..., i].astype("int64") for i, weight in enumerate(BT601)) + 32768) >> 16).astype(dtype)
    atlas = expect(tmp_path / "v.tif", wanted)
    assert any("luminance" in note for note in atlas.info["notes"])


def test_alpha_and_samples_that_are_channels(tmp_path):
    array = samples("uint8", (4, 20, 21, 4))
    tifffile.imwrite(tmp_path / "alpha.tif", array, photometric="rgb", extrasamples=["unassalpha"])
    expect(tmp_path / "alpha.tif", array[..., 1], channel="1")
    tifffile.imwrite(tmp_path / "v.tif", array, photometric="minisblack", planarconfig="contig")
    for i in range(4):
        expect(tmp_path / "v.tif", array[..., i], channel=str(i))


def data_set(folder, names=("a.ome.tif", "b.ome.tif")):
    """One image of two channels, each in a file of its own."""
    array = samples("uint16", (2, 3, 6, 7))
    data = "".join(f'<TiffData FirstC="{c}" IFD="0" PlaneCount="3"><UUID FileName="{name}">urn:uuid:{c}</UUID></TiffData>' for c, name in enumerate(names))
    for c, name in enumerate(("a.ome.tif", "b.ome.tif")):
        xml = f'<OME UUID="urn:uuid:{c}"><Image ID="Image:0"><Pixels DimensionOrder="XYZCT" SizeX="7" SizeY="6" SizeZ="3" SizeC="2" SizeT="1">{data}</Pixels></Image></OME>'
        tifffile.imwrite(folder / name, array[c], photometric="minisblack", metadata=None, description=xml)
    return array


def test_data_sets_of_several_files(tmp_path):
    array = data_set(tmp_path)
    for name, c in itertools.product(("a.ome.tif", "b.ome.tif"), range(2)):
        expect(tmp_path / name, array[c], channel=str(c))
    (tmp_path / "b.ome.tif").unlink()
    expect(tmp_path / "a.ome.tif", array[0], channel="0")
    with pytest.raises(isoatlas.Error, match="missing: .b.ome.tif"):
        isoatlas.open(tmp_path / "a.ome.tif", channel="1")


@pytest.mark.parametrize("name", ["../outside.tif", "/etc/passwd", "link.tif"])
def test_names_that_lead_outside(name, tmp_path):
    (tmp_path / "in").mkdir()
    data_set(tmp_path)
    os.rename(tmp_path / "b.ome.tif", tmp_path / "outside.tif")
    os.symlink(tmp_path / "outside.tif", tmp_path / "in" / "link.tif")
    data_set(tmp_path / "in", ("a.ome.tif", name))
    with pytest.raises(isoatlas.Error) as error:
        isoatlas.open(tmp_path / "in" / "a.ome.tif", channel="1")
    assert error.value.reason == "file_outside_folder"


def refused(path, *options, codes=(2, 3, 4)):
    """One message and a documented exit code, within 2 GB."""
    done = subprocess.run(["prlimit", "--as=2000000000", CLI, "info", str(path), *options], capture_output=True, text=True, timeout=60)
    if done.returncode == 0:
        return False
    assert done.returncode in codes, (done.returncode, done.stderr)
    assert len(done.stderr.strip().splitlines()) <= 4 and "isoatlas" in done.stderr, done.stderr
    return True


@pytest.mark.parametrize("change", [
    ('SizeZ="3"', 'SizeZ="2000000000"'), ('SizeC="2"', 'SizeC="2000000000"'), ('SizeX="7"', 'SizeX="8"'), ('SizeZ="3"', 'SizeZ="-3"'),
    ('PlaneCount="3"', 'PlaneCount="2000000000"'), ('IFD="0"', 'IFD="30"'), ('FirstC="0"', 'FirstC="7"'), ('XYZCT', 'XYZZT'), ("</Image>", ""),
    ("<TiffData", "<TiffDatum")], ids=str)
def test_descriptions_that_lie(change, tmp_path):
    data_set(tmp_path)
    with tifffile.TiffFile(tmp_path / "a.ome.tif") as file:
        xml, pixels = file.pages[0].description, file.asarray()
    for time in range(2):  # of every occurrence, or of the first one
        other = xml.replace(*change, *([1] if time else []))
        tifffile.imwrite(tmp_path / "a.ome.tif", pixels, photometric="minisblack", metadata=None, description=other)
        with pytest.raises(isoatlas.Error):
            isoatlas.open(tmp_path / "a.ome.tif")
        if CLI:
            assert refused(tmp_path / "a.ome.tif")


def test_entities_are_not_expanded(tmp_path):
    """A thousand million letters, if they were."""
    entities = '<!ENTITY e0 "lots">' + "".join(f'<!ENTITY e{i} "{f"&e{i - 1};" * 10}">' for i in range(1, 10))
    array = data_set(tmp_path)
    with tifffile.TiffFile(tmp_path / "a.ome.tif") as file:
        xml = file.pages[0].description.replace('<Image ', '<Image Name="&e9;" ')
    tifffile.imwrite(tmp_path / "a.ome.tif", array[0], photometric="minisblack", metadata=None, description=f"<!DOCTYPE OME [{entities}]>{xml}")
    expect(tmp_path / "a.ome.tif", array[0], channel="0")


@pytest.mark.parametrize("mode, photometric", [("RGB", 2), ("YCbCr", 6), ("L", 1)])
def test_jpeg_in_tiff(mode, photometric, tmp_path):
    """What is read are the samples that Pillow decodes; of colours that are stored as brightness and differences of colour, too."""
    from PIL import Image, features
    if not features.check("libtiff"):
        pytest.skip("Pillow has no libtiff")
    z, y, x = np.meshgrid(np.arange(3), np.arange(40), np.arange(53), indexing="ij")
    colours = np.stack([4 * x + z, 5 * y, 255 - 3 * x - y], -1).clip(0, 255).astype("u1")
    pages = [Image.fromarray(page[..., 0] if mode == "L" else page).convert(mode) for page in colours]
    pages[0].save(tmp_path / "v.tif", save_all=True, append_images=pages[1:], compression="jpeg", quality=90)
    with tifffile.TiffFile(tmp_path / "v.tif") as file:
        assert len(file.pages) == 3 and file.pages[0].compression == 7
        assert int(file.pages[0].photometric) == photometric
    with Image.open(tmp_path / "v.tif") as file:
        decoded = []
        for page in range(3):
            file.seek(page)
            decoded.append(np.asarray(file.convert("L" if mode == "L" else "RGB")))
    decoded = np.stack(decoded)
    if mode == "L":
        expect(tmp_path / "v.tif", decoded)
        return
    assert abs(decoded.astype(int) - colours).mean() < 8  # it is this picture
    for i, colour in enumerate(["red", "green", "blue"]):
        expect(tmp_path / "v.tif", np.ascontiguousarray(decoded[..., i]), channel=colour)
    wanted = ((sum(weight * decoded[..., i].astype("int64") for i, weight in enumerate(BT601)) + 32768) >> 16).astype("u1")
    atlas = expect(tmp_path / "v.tif", wanted)
    assert any("luminance" in note for note in atlas.info["notes"])


def write_pyramid(path, array, **options):
    with tifffile.TiffWriter(path, ome=True) as file:
        file.write(array, photometric="minisblack", subifds=1, metadata={"axes": "ZYX"}, **options)
        file.write(array[:, ::2, ::2], photometric="minisblack", subfiletype=1, **options)


@pytest.mark.parametrize("options", [{}, {"compression": "zlib"}, {"tile": (16, 16)}], ids=str)
def test_truncated_pyramids(options, tmp_path):
    """The level that is read is whole, or refused; a level that was cut off is not offered, and said."""
    if not CLI:
        pytest.skip("ISOATLAS_CLI does not name the command line")
    array = samples("uint16", (3, 20, 23))
    write_pyramid(tmp_path / "v.ome.tif", array, **options)
    content = (tmp_path / "v.ome.tif").read_bytes()
    told = 0
    for size in [*range(0, len(content), 61), len(content) - 1]:
        (tmp_path / "cut.ome.tif").write_bytes(content[:size])
        try:
            atlas = isoatlas.open(tmp_path / "cut.ome.tif")
        except isoatlas.Error:
            assert refused(tmp_path / "cut.ome.tif")
            continue
        assert np.array_equal(atlas.volume, array)  # what is cut off belongs to the pyramid
        try:
            reduced = isoatlas.open(tmp_path / "cut.ome.tif", level=1).volume
        except isoatlas.Error as error:
            assert error.reason == "no_such_level"
            assert any("reduced image" in note and "damaged" in note for note in atlas.info["notes"])
            told += 1
            continue
        assert np.array_equal(reduced, array[:, ::2, ::2])
        assert not any("damaged" in note for note in atlas.info["notes"])
    assert told > 0


@pytest.mark.parametrize("options", [{}, {"compression": "zlib"}, {"tile": (16, 16)}, {"tile": (4, 16, 16)}, {"tile": (16, 16, 16)}], ids=str)
def test_pages_of_several_slices(options, tmp_path):
    array = samples("uint8", (7, 9, 11))
    tifffile.imwrite(tmp_path / "v.tif", array, volumetric=True, photometric="minisblack", **options)
    with tifffile.TiffFile(tmp_path / "v.tif") as file:
        assert len(file.pages) == 1 and np.array_equal(file.asarray(), array)
    with pytest.raises(isoatlas.errors.UnsupportedError, match="a page for each slice"):
        isoatlas.open(tmp_path / "v.tif")
    content = (tmp_path / "v.tif").read_bytes()
    for tag in (32997, 32998):  # a tag that cannot be read is none that is not there
        place = content.find(struct.pack("<HH", tag, 4))
        if place < 0:
            continue
        damaged = bytearray(content)
        struct.pack_into("<H", damaged, place + 2, 2)
        (tmp_path / "v.tif").write_bytes(damaged)
        with pytest.raises(isoatlas.Error):
            isoatlas.open(tmp_path / "v.tif").volume


def test_damaged_files(tmp_path):
    if not CLI:
        pytest.skip("ISOATLAS_CLI does not name the command line")
    write_pyramid(tmp_path / "v.ome.tif", samples("uint16", (3, 6, 7)))
    content = (tmp_path / "v.ome.tif").read_bytes()
    with tifffile.TiffFile(tmp_path / "v.ome.tif") as file:
        first = file.pages[0].offset
    cyclic = bytearray(content)
    struct.pack_into("<I", cyclic, first + 2 + 12 * struct.unpack_from("<H", content, first)[0], first)
    (tmp_path / "cyclic.ome.tif").write_bytes(cyclic)
    assert refused(tmp_path / "cyclic.ome.tif", codes=(3,))
    for place in range(0, len(content)):
        damaged = bytearray(content)
        damaged[place] ^= 0xff
        (tmp_path / "damaged.ome.tif").write_bytes(damaged)
        try:
            isoatlas.open(tmp_path / "damaged.ome.tif").volume
        except isoatlas.Error as error:
            assert not isinstance(error, isoatlas.errors.InternalError), error
