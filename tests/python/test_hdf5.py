"""HDF5 against h5py: what it writes in any type, chunk shape and filter is read; conventions place the samples; what lies is refused."""
import pathlib
import subprocess
import sys

import numpy as np
import pytest

import isoatlas
from conftest import CLI, SOURCE

h5py = pytest.importorskip("h5py")
TYPES = [order + kind for order in "<>" for kind in ("u1", "i1", "u2", "i2", "u4", "i4", "f2", "f4", "f8")]


def read(path, **options):
    return isoatlas.open(path, **options)


def same(array, got):
    return np.array_equal(np.asarray(got), array.astype("f4" if array.dtype.itemsize == 2 and array.dtype.kind == "f" else array.dtype.newbyteorder("=")))


@pytest.mark.parametrize("dtype", TYPES)
def test_every_type(dtype, tmp_path):
    array = (np.random.default_rng(1).random((3, 4, 5)) * 100).astype(dtype)
    with h5py.File(tmp_path / "v.h5", "w") as file:
        file["deep/down/v"] = array
    assert same(array, read(tmp_path / "v.h5").volume)


@pytest.mark.parametrize("filters", [{}, {"compression": "gzip"}, {"compression": "gzip", "shuffle": True, "fletcher32": True},
                                     {"compression": "szip"}, {"scaleoffset": 0}, {"fletcher32": True}])
@pytest.mark.parametrize("chunks", [(1, 1, 1), (7, 6, 5), (3, 5, 2), (1, 9, 8)])
def test_every_filter_of_hdf5(filters, chunks, tmp_path):
    if filters.get("compression") == "szip" and not h5py.h5z.filter_avail(h5py.h5z.FILTER_SZIP):
        pytest.skip("this HDF5 has no szip")
    array = np.random.default_rng(2).integers(0, 1000, (7, 9, 8)).astype("u2")
    try:
        with h5py.File(tmp_path / "v.h5", "w") as file:
            file.create_dataset("v", data=array, chunks=chunks, **filters)
    except ValueError as error:
        pytest.skip(f"h5py does not write it: {error}")
    atlas = read(tmp_path / "v.h5")
    assert same(array, atlas.volume)


BLOSC, LZ4, ZSTD, BZIP2 = 32001, 32004, 32015, 307
PLUGINS = {BLOSC: "hdf5-filter-plugin-blosc-serial", LZ4: "hdf5-filter-plugin", BZIP2: "hdf5-filter-plugin"}


@pytest.mark.parametrize("shuffle", [False, True])
@pytest.mark.parametrize("filter, settings", [
    *((BLOSC, (0, 0, 0, 0, level, bits, compressor)) for level, bits, compressor in ((5, 1, 0), (9, 0, 1), (1, 2, 1), (5, 1, 2), (5, 2, 4), (5, 1, 5), (0, 1, 0))),
    (LZ4, ()), (LZ4, (64,)), (LZ4, (1 << 20,)), (BZIP2, (9,))], ids=str)
def test_filters_of_plugins(filter, settings, shuffle, tmp_path):
    """Written by the plugins of Debian, which h5py loads."""
    if not h5py.h5z.filter_avail(filter):
        pytest.skip(f"{PLUGINS[filter]} is not installed")
    rng = np.random.default_rng(5)
    for array in (rng.integers(0, 50, (7, 9, 8)).astype("u2"), rng.random((20, 21, 22)).astype("f4"), np.zeros((5, 6, 7), "i4")):
        with h5py.File(tmp_path / "v.h5", "w") as file:
            file.create_dataset("v", data=array, chunks=(5, 6, 7), shuffle=shuffle, compression=filter, compression_opts=settings)
        assert same(array, read(tmp_path / "v.h5").volume)


def with_stored_chunk(path, shape, filter, settings, chunk):
    """An array of one chunk of uint16 that is there already: HDF5 itself need not know the filter."""
    with h5py.File(path, "w") as file:
        creation = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
        creation.set_chunk(shape)
        creation.set_filter(filter, h5py.h5z.FLAG_OPTIONAL, settings)
        set = h5py.h5d.create(file.id, b"v", h5py.h5t.STD_U16LE, h5py.h5s.create_simple(shape), creation)
        set.write_direct_chunk((0, 0, 0), chunk)


def test_zstandard(tmp_path):
    codecs = pytest.importorskip("numcodecs")
    array = np.random.default_rng(6).integers(0, 50, (7, 9, 8)).astype("<u2")
    chunk = codecs.Zstd(level=3).encode(array)
    with_stored_chunk(tmp_path / "v.h5", array.shape, ZSTD, (3,), chunk)
    assert same(array, read(tmp_path / "v.h5").volume)
    for damaged in (chunk[:-1], chunk[:20], chunk + b"more", codecs.Zstd().encode(array[:-1]), codecs.Zstd().encode(np.zeros(1 << 20, "u1"))):
        with_stored_chunk(tmp_path / "d.h5", array.shape, ZSTD, (3,), damaged)
        with pytest.raises(isoatlas.Error):
            np.asarray(read(tmp_path / "d.h5").volume)


@pytest.mark.parametrize("filter", [BLOSC, LZ4])
def test_damaged_chunks_of_plugins(filter, tmp_path):
    """Every prefix is refused; a byte that is damaged may give other samples, but never more or fewer of them."""
    if not h5py.h5z.filter_avail(filter):
        pytest.skip(f"{PLUGINS[filter]} is not installed")
    array = np.random.default_rng(7).integers(0, 3, (4, 5, 6)).astype("<u2")
    with h5py.File(tmp_path / "v.h5", "w") as file:
        set = file.create_dataset("v", data=array, chunks=array.shape, compression=filter)
        file.flush()
        chunk = set.id.read_direct_chunk((0, 0, 0))[1]
        settings = set.id.get_create_plist().get_filter(0)[2]
    with_stored_chunk(tmp_path / "v.h5", array.shape, filter, settings, chunk)
    assert same(array, read(tmp_path / "v.h5").volume)
    for size in range(1, len(chunk), 3):
        with_stored_chunk(tmp_path / "d.h5", array.shape, filter, settings, chunk[:size])
        with pytest.raises(isoatlas.Error):
            np.asarray(read(tmp_path / "d.h5").volume)
    for place in range(len(chunk)):
        damaged = bytearray(chunk)
        damaged[place] ^= 0x55
        with_stored_chunk(tmp_path / "d.h5", array.shape, filter, settings, bytes(damaged))
        try:
            assert np.asarray(read(tmp_path / "d.h5").volume).shape == array.shape
        except isoatlas.Error:
            pass


def test_samples_that_were_never_written(tmp_path):
    with h5py.File(tmp_path / "v.h5", "w") as file:
        set = file.create_dataset("v", (4, 5, 6), "i4", chunks=(2, 2, 2), fillvalue=7, maxshape=(None, None, None))
        set[0, 0, 0] = 1
        expected = set[()]
    assert np.array_equal(read(tmp_path / "v.h5").volume, expected)


def test_booleans_and_one_more_dimension(tmp_path):
    array = np.random.default_rng(3).random((1, 4, 5, 6, 1)) > 0.5
    with h5py.File(tmp_path / "v.h5", "w") as file:
        file["v"] = array
    assert np.array_equal(read(tmp_path / "v.h5").volume, array[0, ..., 0])


@pytest.mark.parametrize("libver", ["earliest", "latest"])
@pytest.mark.parametrize("shape, chunks, most", [((7, 9, 8), None, None), ((7, 9, 8), (3, 5, 2), None), ((7, 9, 8), (7, 9, 8), None),
                                                 ((7, 9, 8), (3, 5, 2), (None, 9, 8)), ((7, 9, 8), (3, 5, 2), (None, None, 8))])
def test_every_index_and_any_box(shape, chunks, most, libver, tmp_path):
    """Single chunk, implicit, fixed array, extensible array and B-trees of both versions."""
    array = np.random.default_rng(6).integers(0, 4, shape).astype(">i2")
    for filters in ({},) if chunks is None else ({}, {"compression": "lzf"}, {"compression": "gzip", "shuffle": True, "fletcher32": True}):
        with h5py.File(tmp_path / "v.h5", "w", libver=libver) as file:
            file.create_dataset("v", data=array, chunks=chunks, maxshape=most, **filters)
        assert same(array, read(tmp_path / "v.h5").volume)
        assert same(array[2:7, 1:8, 3:6], read(tmp_path / "v.h5", box=((2, 7), (1, 8), (3, 6))).volume)


@pytest.fixture
def run_cli():
    if not CLI:
        pytest.skip("ISOATLAS_CLI does not name the command line")
    return lambda *words: subprocess.run([CLI, *map(str, words)], capture_output=True, text=True, timeout=300)


def test_virtual_and_external_storage(tmp_path):
    parts = [np.full((4, 5), value, "u1") for value in (1, 2, 3)]
    layout = h5py.VirtualLayout((3, 4, 5), "u1")
    for i, part in enumerate(parts):
        with h5py.File(tmp_path / f"{i}.h5", "w") as file:
            file["p"] = part
        layout[i] = h5py.VirtualSource(f"{i}.h5", "p", shape=(4, 5))
    with h5py.File(tmp_path / "v.h5", "w") as file:
        file.create_virtual_dataset("v", layout)
    assert np.array_equal(read(tmp_path / "v.h5").volume, np.stack(parts))
    with h5py.File(tmp_path / "1.h5", "a") as file:
        file.move("p", "q")
    with pytest.raises(isoatlas.InputError, match="1.h5:p"):   # h5py gives zeros
        read(tmp_path / "v.h5").volume
    (tmp_path / "1.h5").unlink()
    with pytest.raises(isoatlas.InputError, match="1.h5"):   # here, too
        read(tmp_path / "v.h5").volume
    (tmp_path / "raw").write_bytes(bytes(range(60)))
    with h5py.File(tmp_path / "e.h5", "w") as file:
        file.create_dataset("v", (3, 4, 5), "u1", external=[("raw", 0, 60)])
    (tmp_path / "raw").write_bytes(bytes(range(60)))
    assert np.array_equal(np.asarray(read(tmp_path / "e.h5").volume).ravel(), np.arange(60))
    (tmp_path / "raw").write_bytes(bytes(range(59)))
    with pytest.raises(isoatlas.InputError, match="raw"):
        read(tmp_path / "e.h5").volume


@pytest.mark.parametrize("persist", [False, True])
def test_file_space_strategies(persist, tmp_path):
    """What of the file is free is kept in a message of the superblock's extension."""
    array = np.arange(60, dtype="u1").reshape(3, 4, 5)
    with h5py.File(tmp_path / "v.h5", "w", libver="latest", fs_strategy="page", fs_persist=persist, fs_threshold=16, fs_page_size=4096) as file:
        file["gone"], file["v"] = array, array
        del file["gone"]
    assert np.array_equal(read(tmp_path / "v.h5").volume, array)


def virtual(path, name, source, file="."):
    """An array of 1 x 4 x 5 that is another one."""
    layout = h5py.VirtualLayout((1, 4, 5), "u1")
    layout[:] = h5py.VirtualSource(file, source, shape=(1, 4, 5))
    with h5py.File(path, "a") as opened:
        opened.create_virtual_dataset(name, layout)


def test_virtual_arrays_of_virtual_arrays(tmp_path):
    array = np.arange(20, dtype="u1").reshape(1, 4, 5)
    with h5py.File(tmp_path / "samples.h5", "w") as file:
        file["g/0"] = array
    virtual(tmp_path / "v.h5", "1", "g/0", file="samples.h5")
    for i in range(2, 10):
        virtual(tmp_path / "v.h5", str(i), str(i - 1))
    assert np.array_equal(read(f"{tmp_path}/v.h5:/8").volume, array)
    with pytest.raises(isoatlas.InputError, match="more than 8"):
        read(f"{tmp_path}/v.h5:/9").volume


def test_virtual_arrays_in_a_circle(tmp_path):
    """libhdf5 follows them until its stack is full."""
    virtual(tmp_path / "itself.h5", "v", "v")
    virtual(tmp_path / "pair.h5", "v", "w")
    virtual(tmp_path / "pair.h5", "w", "v")
    for one, other in ("a", "b"), ("b", "a"):
        virtual(tmp_path / f"{one}.h5", "v", "v", file=f"{other}.h5")
    for name in ("itself.h5:/v", "pair.h5:/v", "a.h5:/v", "b.h5:/v"):
        with pytest.raises(isoatlas.InputError, match="in a circle"):
            read(f"{tmp_path}/{name}").volume


def test_sources_with_numbers(tmp_path):
    """%b: a file for each number."""
    array = np.arange(60, dtype="u1").reshape(3, 4, 5)
    for i in range(3):
        with h5py.File(tmp_path / f"part_{i}.h5", "w") as file:
            file["p"] = array[i:i + 1]
    create, space = h5py.h5p.create(h5py.h5p.DATASET_CREATE), h5py.h5s.create_simple((3, 4, 5), (h5py.h5s.UNLIMITED, 4, 5))
    space.select_hyperslab((0, 0, 0), (h5py.h5s.UNLIMITED, 1, 1), (1, 4, 5), (1, 4, 5))
    create.set_virtual(space, b"part_%b.h5", b"p", h5py.h5s.create_simple((1, 4, 5)))
    with h5py.File(tmp_path / "v.h5", "w", libver="latest") as file:
        h5py.h5d.create(file.id, b"v", h5py.h5t.STD_U8LE, space, create)
    with h5py.File(tmp_path / "v.h5") as file:
        found = file["v"][:]  # which parts HDF5 finds depends on its version
    assert len(found) >= 1 and np.array_equal(read(tmp_path / "v.h5").volume, found)
    with open(tmp_path / "part_0.h5", "r+b") as file:
        file.truncate(1000)
    with pytest.raises(isoatlas.Error):
        read(tmp_path / "v.h5").volume


def test_files_outside_the_folder_are_not_read(tmp_path):
    (tmp_path / "in").mkdir()
    with h5py.File(tmp_path / "secret.h5", "w") as file:
        file["p"] = np.ones((4, 5), "u1")
    (tmp_path / "raw").write_bytes(bytes(60))
    layout = h5py.VirtualLayout((2, 4, 5), "u1")
    for i in range(2):
        layout[i] = h5py.VirtualSource("../secret.h5", "p", shape=(4, 5))
    with h5py.File(tmp_path / "in" / "virtual.h5", "w") as file:
        file.create_virtual_dataset("v", layout)
    with h5py.File(tmp_path / "in" / "external.h5", "w") as file:
        file.create_dataset("v", (3, 4, 5), "u1", external=[("../raw", 0, 60)])
    with h5py.File(tmp_path / "in" / "absolute.h5", "w") as file:
        file.create_dataset("v", (3, 4, 5), "u1", external=[(str(tmp_path / "raw"), 0, 60)])
    for name in ("virtual", "external", "absolute"):
        with pytest.raises(isoatlas.InputError, match="outside its folder"):
            read(tmp_path / "in" / f"{name}.h5").volume


def test_user_block_as_matlab_writes_it(tmp_path):
    array = np.random.default_rng(4).random((3, 4, 5))
    for block in (512, 8192):
        with h5py.File(tmp_path / "v.mat", "w", userblock_size=block) as file:
            file["v"] = array
            file["v"].attrs["MATLAB_class"] = np.bytes_("double")
        with open(tmp_path / "v.mat", "r+b") as file:  # a text, room for a subsystem, version and byte order
            file.write(b"MATLAB 7.3 MAT-file, Platform: GLNXA64".ljust(116) + bytes(8) + b"\x00\x02IM")
        assert np.array_equal(read(tmp_path / "v.mat").volume, array)


@pytest.mark.parametrize("shape, chunks", [((1 << 20, 1 << 20, 1 << 20), (32, 32, 32)), ((1 << 40, 1 << 20), (64, 64))])
def test_petabytes_that_are_not_there(shape, chunks, tmp_path, run_cli):
    with h5py.File(tmp_path / "v.h5", "w") as file:
        file.create_dataset("v", shape, "u1", chunks=chunks, compression="gzip")
    done = run_cli("objects", tmp_path / "v.h5")
    assert done.returncode in (2, 3, 4, 5) and done.stderr and "HDF5-DIAG" not in done.stderr
    assert (tmp_path / "v.h5").stat().st_size < 1 << 20


def test_damage_has_one_message(tmp_path, run_cli):
    """Nothing but one message comes."""
    rng = np.random.default_rng(5)
    with h5py.File(tmp_path / "v.h5", "w") as file:
        file.create_dataset("g/v", data=rng.integers(0, 255, (8, 9, 10)).astype("u1"), chunks=(4, 5, 6), compression="gzip", fletcher32=True)
        file["g/v"].attrs["units"] = "K"
    content = (tmp_path / "v.h5").read_bytes()
    crashes = []
    for i in range(60):
        damaged = bytearray(content)
        if i % 3 == 0:
            damaged = damaged[:rng.integers(8, len(content))]
        else:
            for at in rng.integers(8, len(content), 3):
                damaged[at] = rng.integers(0, 256)
        (tmp_path / "d.h5").write_bytes(damaged)
        done = run_cli("info", tmp_path / "d.h5")
        if done.returncode not in (0, 2, 3, 4, 5):
            crashes.append((i, done.returncode, done.stderr[-200:]))
        assert "HDF5-DIAG" not in done.stderr
    assert not crashes, crashes


DAMAGE = """
import sys, isoatlas
content = open(sys.argv[1], "rb").read()
for at in range(8, len(content)):
    if not any(content[at - 4:at + 5]):
        continue
    for value in {0, 255, content[at] ^ 1} - {content[at]}:
        with open(sys.argv[2], "wb") as file:
            file.write(content[:at] + bytes([value]) + content[at + 1:])
        try:
            isoatlas.open(sys.argv[2] + ":/v").volume
        except isoatlas.InternalError:
            raise
        except (isoatlas.Error, ValueError):
            pass
"""


@pytest.mark.parametrize("kind", ["enumeration", "attributes", "virtual"])
def test_headers_that_lie_do_not_end_the_program(kind, tmp_path):
    """Every byte of small files whose headers have no checksums."""
    array = (np.arange(24, dtype="u1") % 2).reshape(2, 3, 4)
    type = h5py.enum_dtype({"none": 0, "some": 1}, "u1")
    with h5py.File(tmp_path / "v.h5", "w", libver="earliest") as file:
        if kind == "virtual":
            file["p"] = array[0]
            layout = h5py.VirtualLayout((2, 3, 4), "u1")
            for i in range(2):
                layout[i] = h5py.VirtualSource(".", "p", shape=(3, 4))
            file.create_virtual_dataset("v", layout)
        else:
            file.create_dataset("v", data=array.astype(type) if kind == "enumeration" else array, dtype=type if kind == "enumeration" else "u1")
        if kind == "attributes":
            file["v"].attrs.create("units", "K")
            file["v"].attrs.create("flags", [0, 1], dtype=type)
            file["v"].attrs["pairs"] = np.zeros(2, dtype=[("a", "f4"), ("b", "i2", (3,))])
    content = (tmp_path / "v.h5").read_bytes().rstrip(b"\0")
    assert len(content) < 8000
    done = subprocess.run([sys.executable, "-B", "-c", DAMAGE, tmp_path / "v.h5", tmp_path / "d.h5"], capture_output=True, text=True,
                          timeout=600)
    assert done.returncode == 0, done.stderr[-2000:]


def test_h5py_reads_texts_after_isoatlas(tmp_path):
    """Both may use one HDF5 in one process."""
    with h5py.File(tmp_path / "v.h5", "w") as file:
        file["v"] = np.zeros((3, 4, 5), "u1")
        file["v"].attrs["units"] = "K"  # of any length
        file["texts"] = ["one", "other"]
    assert isoatlas.info(tmp_path / "v.h5")["value_unit"] == "K"
    with h5py.File(tmp_path / "v.h5") as file:
        assert list(file["texts"].asstr()) == ["one", "other"] and file["v"].attrs["units"] == "K"


def test_shared_files_say_what_they_are():
    shared = SOURCE.parent / "shared" / "data" / "formats"
    if not shared.exists():
        pytest.skip("no shared data beside the checkout")
    for name in ("can_0.hdf", "can-vtu.hdf"):
        with pytest.raises(isoatlas.UnsupportedError, match="VTKHDF"):
            read(shared / name).volume


@pytest.mark.parametrize("dtype", ["u1", "i1", "u2", "i2", "u4", "i4", "f4", "f8"])
@pytest.mark.parametrize("shape", [(70, 65, 130), (1, 9, 8), (3, 1, 1), (64, 64, 64), (30, 40), (600, 530)])
def test_written_arrays_are_read_back(dtype, shape, tmp_path):
    """By h5py and by isoatlas, also where the last chunks are not full and axes have one sample."""
    array = (np.random.default_rng(7).random(shape) * 100).astype(dtype)
    isoatlas.write(tmp_path / "v.h5", array)
    with h5py.File(tmp_path / "v.h5") as file:
        assert list(file) == ["volume"]
        written = file["volume"]
        assert written.dtype == array.dtype and np.array_equal(written[()], array)
        edge = 512 if array.ndim == 2 else 64
        assert written.chunks == tuple(min(edge, size) for size in shape) and written.compression == "gzip" and written.shuffle
    assert np.array_equal(np.asarray(read(tmp_path / "v.h5").volume).reshape(shape), array)


TURNED = [[0.6, -0.8, 0], [0.8, 0.6, 0], [0, 0, -1]]


@pytest.mark.parametrize("direction", [None, TURNED])
@pytest.mark.parametrize("unit", ["mm", "um", "furlong", None])
def test_written_geometry_is_read_back_exactly(direction, unit, tmp_path):
    array = np.random.default_rng(8).random((3, 4, 5))
    isoatlas.write(tmp_path / "v.h5", array, spacing=(0.3, 0.1, 0.7), origin=(1 / 3, -2, 1e5 / 7), direction=direction, unit=unit,
                   value_unit="HU", space="LPS")
    info = isoatlas.info(tmp_path / "v.h5")
    assert list(info["spacing"]) == [0.7, 0.1, 0.3] and list(info["origin"]) == [1 / 3, -2, 1e5 / 7]
    assert np.array_equal(info["direction"], np.eye(3) if direction is None else direction)
    isoatlas.write(tmp_path / "v.nrrd", array, unit=unit, value_unit="HU", space="LPS")
    other = isoatlas.info(tmp_path / "v.nrrd")
    assert [info[key] for key in ("unit", "value_unit", "space")] == [other[key] for key in ("unit", "value_unit", "space")]
    with h5py.File(tmp_path / "v.h5") as file:
        attributes = file["volume"].attrs
        assert attributes["gridSpacing"].tolist() == [0.3, 0.1, 0.7]
        assert attributes["axisLabels"].tolist() == [b"z", b"y", b"x"]
        assert ("gridUnitSI" in attributes) == ("element_size_um" in attributes) == (unit in ("mm", "um"))
        if unit == "mm":
            assert np.allclose(attributes["element_size_um"], [300, 100, 700])
        assert ("gridDirection" in attributes) == (direction is not None)


def test_written_images_keep_their_place(tmp_path, cli):
    isoatlas.write(tmp_path / "v.nrrd", np.arange(20, dtype="u1").reshape(4, 5), spacing=(2, 3), origin=(1, 2, 0), unit="mm")
    cli("convert", "v.nrrd", "-o", "v.hdf5")
    info = isoatlas.info(tmp_path / "v.hdf5")
    assert info["spacing"][:2] == isoatlas.info(tmp_path / "v.nrrd")["spacing"][:2]
    assert info["origin"] == isoatlas.info(tmp_path / "v.nrrd")["origin"]


def test_calibration_and_description_are_written(tmp_path, cli):
    array = np.arange(60, dtype="i2").reshape(3, 4, 5)
    with h5py.File(tmp_path / "a.h5", "w") as file:
        file["v"] = array
        file["v"].attrs.update({"scale_factor": 0.1, "add_offset": -7.5, "units": "µ", "long_name": "an example"})
    cli("convert", "a.h5", "-o", "b.h5")
    with h5py.File(tmp_path / "b.h5") as file:
        attributes = file["volume"].attrs
        assert attributes["scale_factor"] == 0.1 and attributes["add_offset"] == -7.5
        assert attributes["units"].decode() == "µ" and attributes["long_name"] == b"an example"
    one, other = isoatlas.info(tmp_path / "a.h5"), isoatlas.info(tmp_path / "b.h5")
    assert all(one[key] == other[key] for key in one.keys() - {"path", "file_bytes", "notes", "encoding", "chunk", "volumes"})
    first = (tmp_path / "b.h5").read_bytes()
    cli("convert", "a.h5", "-o", "b.h5")
    assert (tmp_path / "b.h5").read_bytes() == first


def test_written_labels(tmp_path, cli, demo):
    isoatlas.open(demo).save(tmp_path / "v.nrrd")
    cli("label", "v.nrrd", "--tau", "120", "-o", "labels.h5")
    cli("label", "v.nrrd", "--tau", "120", "-o", "labels.npy.nrrd")
    with h5py.File(tmp_path / "labels.h5") as file:
        labels, attributes = file["labels"][()], dict(file["labels"].attrs)
    assert labels.dtype == "u1" and labels.max() > 0
    assert np.array_equal(labels, read(tmp_path / "labels.npy.nrrd").volume) and np.array_equal(labels, read(tmp_path / "labels.h5").volume)
    assert attributes["labels_are"] == b"objects" and float(attributes["tau"]) == 120
    cli("label", "v.nrrd", "--top", "2", "-o", "objects.h5")
    assert (tmp_path / "objects.csv").read_text().startswith("number,name")


def test_half_a_file_is_none(tmp_path, run_cli):
    array = np.random.default_rng(9).random((64, 64, 64))
    isoatlas.write(tmp_path / "v.nrrd", array)
    (tmp_path / "out").mkdir()
    done = subprocess.run(["bash", "-c", f"ulimit -f 200; exec '{CLI}' convert '{tmp_path}/v.nrrd' -o '{tmp_path}/out/v.h5'"],
                          capture_output=True, text=True, timeout=300)
    assert done.returncode != 0 and not list((tmp_path / "out").iterdir())
