"""Zarr arrays against zarr-python (version 2), and against hand-written stores of version 3, sample by sample and axis by axis."""
import bz2
import gzip
import itertools
import json
import struct
import zipfile
import zlib

import numpy as np
import pytest

import isoatlas

zarr = pytest.importorskip("zarr")
import numcodecs  # noqa: E402

TYPES = ["uint8", "int8", "uint16", "int16", "uint32", "int32", "float16", "float32", "float64", "bool"]
SHAPE = (7, 9, 10)


def samples(dtype, shape=SHAPE, seed=1):
    """Few different values, so that there are ties."""
    return np.random.default_rng(seed).integers(0, 20, shape).astype(dtype)


def read(path, **options):
    return isoatlas.open(path, **options).volume


def as_read(array):
    return array.astype({"float16": "float32", "bool": "uint8"}.get(array.dtype.name, array.dtype.newbyteorder("=")))


def expect(path, array, **options):
    volume = read(path, **options)
    assert volume.dtype == as_read(array).dtype and np.array_equal(volume, as_read(array))


@pytest.mark.parametrize("order", "CF")
@pytest.mark.parametrize("byte_order", "<>")
@pytest.mark.parametrize("dtype", TYPES)
def test_every_type_order_and_byte_order(dtype, byte_order, order, tmp_path):
    array = samples(dtype).astype(np.dtype(dtype).newbyteorder(byte_order))
    for separator in "./":
        path = tmp_path / f"v{ord(separator)}.zarr"
        zarr.array(array, store=zarr.DirectoryStore(str(path), dimension_separator=separator), chunks=(3, 4, 6), order=order, dimension_separator=separator)
        expect(path, array)


COMPRESSORS = [None, numcodecs.Zlib(6), numcodecs.GZip(3), numcodecs.Zstd(3), numcodecs.LZ4(), numcodecs.BZ2(5),
               *(numcodecs.Blosc(cname=name, clevel=5, shuffle=shuffle) for name in numcodecs.blosc.list_compressors() for shuffle in (0, 1, 2))]


@pytest.mark.parametrize("compressor", COMPRESSORS, ids=str)
@pytest.mark.parametrize("dtype", ["uint8", "int16", "float64"])
def test_every_compressor(compressor, dtype, tmp_path):
    array = samples(dtype, (40, 41, 42))
    zarr.array(array, store=zarr.DirectoryStore(str(tmp_path / "v.zarr")), chunks=(16, 17, 42), compressor=compressor)
    expect(tmp_path / "v.zarr", array)


@pytest.mark.parametrize("filters,dtype", [
    ([numcodecs.Shuffle(4)], "float32"), ([numcodecs.Shuffle(2)], "uint8"), ([numcodecs.Delta("int16")], "int16"), ([numcodecs.Delta("int32", "int8")], "int32"),
    ([numcodecs.Delta("uint8")], "uint8"), ([numcodecs.Delta("float32")], "float32"), ([numcodecs.Delta(">i2"), numcodecs.Shuffle(2)], ">i2"),
    ([numcodecs.FixedScaleOffset(offset=-3, scale=10, dtype="float32", astype="uint8")], "float32"),
    ([numcodecs.FixedScaleOffset(offset=5, scale=2, dtype="int32", astype="int16")], "int32"), ([numcodecs.Zlib(), numcodecs.LZ4()], "uint16"),
], ids=str)
def test_filters(filters, dtype, tmp_path):
    for compressor in (None, numcodecs.Zlib()):
        path = tmp_path / f"{compressor is None}.zarr"
        stored = zarr.array(samples(dtype), store=zarr.DirectoryStore(str(path)), chunks=(3, 4, 6), filters=filters, compressor=compressor)
        expect(path, stored[:])


def test_filters_that_are_not_read_are_named(tmp_path):
    for filters in ([numcodecs.Quantize(2, "float32")], [numcodecs.BitRound(4)]):
        path = tmp_path / f"{filters[0].codec_id}.zarr"
        zarr.array(samples("float32"), store=zarr.DirectoryStore(str(path)), filters=filters)
        with pytest.raises(isoatlas.UnsupportedError, match=filters[0].codec_id):
            isoatlas.open(path)
    zarr.array(samples("float32"), store=zarr.DirectoryStore(str(tmp_path / "lzma.zarr")), compressor=numcodecs.LZMA())
    with pytest.raises(isoatlas.UnsupportedError, match="lzma"):
        isoatlas.open(tmp_path / "lzma.zarr")


@pytest.mark.parametrize("dtype,fill", [("int16", -7), ("float32", 2.5), ("float64", "1e300"), ("uint8", None), ("bool", True)])
def test_chunks_that_are_not_written_have_the_fill_value(dtype, fill, tmp_path):
    fill = float(fill) if isinstance(fill, str) else fill
    stored = zarr.open(zarr.DirectoryStore(str(tmp_path / "v.zarr")), mode="w", shape=SHAPE, chunks=(3, 4, 6), dtype=dtype, fill_value=fill)
    stored[2:5, 1:6] = 1
    expected = stored[:] if fill is not None else np.where(np.isin(np.indices(SHAPE)[0], [2, 3, 4]) & np.isin(np.indices(SHAPE)[1], range(1, 6)), 1, 0).astype(dtype)
    assert np.array_equal(read(tmp_path / "v.zarr"), as_read(expected))


@pytest.mark.parametrize("compression", [zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED])
def test_zip_archives(compression, tmp_path):
    array = samples("float32")
    with zarr.ZipStore(str(tmp_path / "v.zip"), compression=compression, mode="w") as store:
        zarr.array(array, store=store, chunks=(3, 4, 6))
    expect(tmp_path / "v.zip", array)
    with zarr.ZipStore(str(tmp_path / "g.zip"), compression=compression, mode="w") as store:
        group = zarr.group(store)
        group.array("a/first", array)
        group.array("second", array + 1)
    expect(f"{tmp_path}/g.zip:/a/first", array)
    expect(f"{tmp_path}/g.zip:/second", array + 1)
    with pytest.raises(isoatlas.InputError, match="/a/first"):
        isoatlas.open(tmp_path / "g.zip")


def test_zip64_archives(tmp_path):
    array = samples("uint8")
    with zipfile.ZipFile(tmp_path / "v.zip", "w") as archive:
        zarr.array(array, store=zarr.DirectoryStore(str(tmp_path / "v.zarr")), chunks=(3, 4, 6))
        for path in sorted((tmp_path / "v.zarr").iterdir()):
            with archive.open(path.name, "w", force_zip64=True) as entry:
                entry.write(path.read_bytes())
    expect(tmp_path / "v.zip", array)


def test_time_is_the_slowest_of_four_axes(tmp_path):
    array = samples("uint16", (3, 4, 5, 6))
    zarr.array(array, store=zarr.DirectoryStore(str(tmp_path / "v.zarr")), chunks=(2, 2, 5, 4))
    for step in range(3):
        expect(tmp_path / "v.zarr", array[step], time_step=step)


# Version 3, by the letter of the specification.

def crc32c(data):
    remainder = 0xffffffff
    for byte in data:
        remainder ^= byte
        for _ in range(8):
            remainder = remainder >> 1 ^ 0x82f63b78 if remainder & 1 else remainder >> 1
    return remainder ^ 0xffffffff


ENCODERS = {
    "gzip": lambda data: gzip.compress(data, 1), "zstd": numcodecs.Zstd(1).encode, "blosc": numcodecs.Blosc("zstd").encode,
    "crc32c": lambda data: data + struct.pack("<I", crc32c(data)), "numcodecs.zlib": zlib.compress, "numcodecs.lz4": numcodecs.LZ4().encode,
    "numcodecs.bz2": bz2.compress,
}


def chunk_bytes(chunk, codecs):
    data = chunk
    for codec in codecs:
        settings = codec.get("configuration", {})
        if codec["name"] == "transpose":
            data = np.transpose(data, settings["order"])
        elif codec["name"] == "bytes":
            data = np.ascontiguousarray(data).astype(data.dtype.newbyteorder("<" if settings.get("endian", "little") == "little" else ">")).tobytes()
        elif codec["name"] == "sharding_indexed":
            data = shard_bytes(data, settings)
        else:
            data = bytes(ENCODERS[codec["name"]](data))
    return data


def shard_bytes(shard, settings):
    size = settings["chunk_shape"]
    counts = [n // k for n, k in zip(shard.shape, size)]
    missing, places, data = 2**64 - 1, [], b""
    at_start = settings.get("index_location", "end") == "start"
    checksum = any(codec["name"] == "crc32c" for codec in settings["index_codecs"])
    index_bytes = 16 * int(np.prod(counts)) + 4 * checksum
    for place in itertools.product(*map(range, counts)):
        chunk = shard[tuple(slice(p * k, (p + 1) * k) for p, k in zip(place, size))]
        if not chunk.any():  # the fill value is 0
            places += [missing, missing]
            continue
        encoded = chunk_bytes(chunk, settings["codecs"])
        places += [len(data) + index_bytes * at_start, len(encoded)]
        data += encoded
    order = "<" if settings["index_codecs"][0].get("configuration", {}).get("endian", "little") == "little" else ">"
    index = struct.pack(f"{order}{len(places)}Q", *places)
    index += struct.pack("<I", crc32c(index)) if checksum else b""
    return index + data if at_start else data + index


def write_version_3(folder, array, chunk, codecs, encoding=("default", "/"), **more):
    folder.mkdir(parents=True, exist_ok=True)
    kind, separator = encoding
    names = {"bool": "bool"}
    (folder / "zarr.json").write_text(json.dumps({
        "zarr_format": 3, "node_type": "array", "shape": array.shape, "data_type": names.get(array.dtype.name, array.dtype.name),
        "chunk_grid": {"name": "regular", "configuration": {"chunk_shape": chunk}},
        "chunk_key_encoding": {"name": kind, "configuration": {"separator": separator}},
        "fill_value": False if array.dtype == bool else 0, "codecs": codecs, **more}))
    padded = np.pad(array, [(0, -n % k) for n, k in zip(array.shape, chunk)])
    for place in itertools.product(*(range(n // k) for n, k in zip(padded.shape, chunk))):
        part = padded[tuple(slice(p * k, (p + 1) * k) for p, k in zip(place, chunk))]
        key = separator.join((["c"] if kind == "default" else []) + [str(p) for p in place])
        (folder / key).parent.mkdir(parents=True, exist_ok=True)
        (folder / key).write_bytes(chunk_bytes(part, codecs))


LITTLE, BIG = ({"name": "bytes", "configuration": {"endian": endian}} for endian in ("little", "big"))


@pytest.mark.parametrize("bytes_codec", [LITTLE, BIG], ids=["little", "big"])
@pytest.mark.parametrize("dtype", TYPES)
def test_version_3_in_every_type(dtype, bytes_codec, tmp_path):
    array = samples(dtype)
    write_version_3(tmp_path / "v.zarr", array, (3, 4, 6), [bytes_codec])
    expect(tmp_path / "v.zarr", array)


@pytest.mark.parametrize("names", [["gzip"], ["zstd"], ["blosc"], ["crc32c"], ["zstd", "crc32c"], ["crc32c", "gzip"], ["numcodecs.zlib"], ["numcodecs.lz4"], ["numcodecs.bz2"]], ids="+".join)
@pytest.mark.parametrize("encoding", [("default", "/"), ("default", "."), ("v2", "."), ("v2", "/")], ids="".join)
def test_version_3_with_codecs(names, encoding, tmp_path):
    array = samples("int16")
    write_version_3(tmp_path / "v.zarr", array, (3, 4, 6), [{"name": "transpose", "configuration": {"order": [1, 2, 0]}}, LITTLE, *({"name": n} for n in names)], encoding)
    expect(tmp_path / "v.zarr", array)


@pytest.mark.parametrize("inner", [[LITTLE], [BIG, {"name": "zstd"}], [{"name": "transpose", "configuration": {"order": [2, 0, 1]}}, LITTLE, {"name": "blosc"}]],
                         ids=["raw", "zstd", "blosc"])
@pytest.mark.parametrize("place", ["start", "end"])
@pytest.mark.parametrize("index", [[LITTLE, {"name": "crc32c"}], [BIG]], ids=["checksum", "big"])
def test_shards(inner, place, index, tmp_path):
    array = samples("uint32", (13, 14, 15))
    array[:6, :8] = 0
    settings = {"chunk_shape": [3, 2, 4], "codecs": inner, "index_codecs": index, "index_location": place}
    write_version_3(tmp_path / "v.zarr", array, (6, 8, 8), [{"name": "sharding_indexed", "configuration": settings}])
    expect(tmp_path / "v.zarr", array)


def test_an_image_of_ome_zarr_0_5_with_shards(tmp_path):
    array = samples("uint16", (13, 14, 15))
    settings = {"chunk_shape": [3, 2, 4], "codecs": [LITTLE, {"name": "zstd"}], "index_codecs": [LITTLE, {"name": "crc32c"}]}
    write_version_3(tmp_path / "v.ome.zarr" / "scale0", array, (6, 8, 8), [{"name": "sharding_indexed", "configuration": settings}])
    axes = [{"name": name, "type": "space", "unit": "nanometer"} for name in "zyx"]
    levels = [{"path": "scale0", "coordinateTransformations": [{"type": "scale", "scale": [4, 3, 2]}, {"type": "translation", "translation": [1, 2, 3]}]}]
    ome = {"version": "0.5", "multiscales": [{"axes": axes, "datasets": levels}]}
    (tmp_path / "v.ome.zarr" / "zarr.json").write_text(json.dumps({"zarr_format": 3, "node_type": "group", "attributes": {"ome": ome}}))
    for path in (tmp_path / "v.ome.zarr", tmp_path / "v.ome.zarr" / "scale0"):
        atlas = isoatlas.open(path)
        assert np.array_equal(atlas.volume, array)
        assert list(atlas.info["spacing"]) == [2, 3, 4] and list(atlas.info["origin"]) == [3, 2, 1] and atlas.info["unit"] == "nm"


def test_every_damage_is_an_error_of_its_own(tmp_path):
    """Whatever happens to a byte or a length, the answer is a volume or an error for users."""
    array = samples("uint8", (4, 5, 6))
    random = np.random.default_rng(3)
    for compressor in (numcodecs.Blosc("lz4"), numcodecs.Blosc("zstd"), numcodecs.Blosc("blosclz"), numcodecs.LZ4(), numcodecs.Zstd(), numcodecs.BZ2()):
        path = tmp_path / f"{compressor}.zarr".replace("/", "")
        zarr.array(array, store=zarr.DirectoryStore(str(path)), chunks=(4, 5, 6), compressor=compressor)
        whole = (path / "0.0.0").read_bytes()
        for _ in range(300):
            damaged = bytearray(whole)
            for place in random.integers(0, len(whole), random.integers(1, 4)):
                damaged[place] = random.integers(0, 256)
            (path / "0.0.0").write_bytes(bytes(damaged[:random.integers(0, len(whole) + 1)] if random.integers(0, 2) else damaged))
            try:
                assert isoatlas.open(path).volume.shape == array.shape
            except isoatlas.InputError as error:
                assert "0.0.0" in str(error)


@pytest.mark.parametrize("dtype", ["uint8", "int16", "float32", "float64"])
def test_zarr_python_reads_what_is_written(dtype, tmp_path):
    array = samples(dtype, (70, 130, 140))
    array[:64, :64, :64] = 0
    isoatlas.open(array, spacing=(1, 2, 3), origin=(5, 6, 7), unit="um").save(tmp_path / "v.ome.zarr")
    group = zarr.open_group(str(tmp_path / "v.ome.zarr"), mode="r")
    assert np.array_equal(group["0"][:], array) and group["0"].dtype == array.dtype
    image = group.attrs["multiscales"][0]
    assert [axis["name"] for axis in image["axes"]] == ["z", "y", "x"] and image["axes"][0]["unit"] == "micrometer"
    assert image["datasets"][0]["coordinateTransformations"] == [{"type": "scale", "scale": [1, 2, 3]}, {"type": "translation", "translation": [7, 6, 5]}]
    blocks = array.reshape(35, 2, 65, 2, 70, 2).astype("float64").mean(axis=(1, 3, 5))
    assert group["1"].shape == (35, 65, 70) and np.allclose(group["1"][:], np.rint(blocks) if dtype[0] in "iu" else blocks)
    assert image["datasets"][1]["coordinateTransformations"][1]["translation"] == [7.5, 7, 6.5]
    assert len(image["datasets"]) == 2
    window = group.attrs["omero"]["channels"][0]["window"]
    assert window["start"] == array.min() and window["end"] == array.max()


def test_zarr_python_reads_written_labels(tmp_path):
    array = np.zeros((20, 30, 40), "uint8")
    array[5:10, 5:10, 5:10], array[12:18, 20:25, 30:38] = 200, 100
    atlas = isoatlas.open(array)
    atlas.save_labels(tmp_path / "labels.ome.zarr", tau=50)
    group = zarr.open_group(str(tmp_path / "labels.ome.zarr"), mode="r")
    (name,) = group["labels"].attrs["labels"]
    assert np.array_equal(group[f"labels/{name}/0"][:] > 0, array > 0)
    assert "image-label" in group[f"labels/{name}"].attrs
