"""Formats without a library in Debian, written here by their descriptions: Amira meshes, bricks of values, .dat and .xml headers of RAW files."""
import gzip
import json
import subprocess
import zlib

import numpy as np
import pytest

import isoatlas
from conftest import CLI

SHAPE = (4, 5, 6)
AMIRA = {"uint8": "byte", "int16": "short", "uint16": "ushort", "int32": "int", "float32": "float", "float64": "double"}


def samples(dtype, shape=SHAPE, seed=1):
    return (np.random.default_rng(seed).random(shape) * 100).astype(dtype)


def runs(plain):
    """HxByteRLE: runs of equal bytes, others as they are."""
    packed, at = bytearray(), 0
    while at < len(plain):
        run = 1
        while run < 127 and at + run < len(plain) and plain[at + run] == plain[at]:
            run += 1
        if run > 2:
            packed += bytes([run, plain[at]])
        else:
            packed += bytes([128 + run]) + plain[at:at + run]
        at += run
    return bytes(packed)


def amira(path, arrays, order="<", coding="", parameters="", first=None):
    nz, ny, nx = SHAPE
    kind = "BINARY-LITTLE-ENDIAN 2.1" if order == "<" else "3D BINARY 2.0"
    lines = [f"# AmiraMesh {first or kind}", f"define Lattice {nx} {ny} {nz}", f"Parameters {{ {parameters} }}"]
    sections = b""
    for number, (name, array) in enumerate(arrays.items(), 1):
        plain = array.astype(array.dtype.newbyteorder(order)).tobytes()
        data = {"": lambda: plain, "HxByteRLE": lambda: runs(plain), "HxZip": lambda: zlib.compress(plain)}[coding]()
        if first:
            data = "\n".join(map(repr, array.ravel().tolist())).encode()
        components = f"[{array.shape[3]}]" if array.ndim == 4 else ""
        lines.append(f"Lattice {{ {AMIRA[array.dtype.name]}{components} {name} }} @{number}" + (f"({coding},{len(data)})" if coding else ""))
        sections += f"@{number}\n".encode() + data + b"\n"
    path.write_bytes(("\n".join(lines) + "\n\n# Data section follows\n").encode() + sections)


@pytest.mark.parametrize("coding", ["", "HxByteRLE", "HxZip"])
@pytest.mark.parametrize("order", ["<", ">"])
@pytest.mark.parametrize("dtype", AMIRA)
def test_amira_of_every_type(dtype, order, coding, tmp_path):
    array = samples(dtype)
    array[1:3] = 7  # long runs
    amira(tmp_path / "v.am", {"Data": array}, order, coding, 'Units { Coordinates "nm" } BoundingBox 10 15 -4 4 0 1.5, CoordType "uniform"')
    atlas = isoatlas.open(tmp_path / "v.am")
    assert np.array_equal(atlas.volume, array)
    assert atlas.info["unit"] == "nm"
    assert np.allclose(atlas.info["spacing"], (1, 2, 0.5)) and np.allclose(atlas.info["origin"], (10, -4, 0))


def test_amira_as_text(tmp_path):
    array = samples("float32")
    amira(tmp_path / "v.am", {"Data": array}, first="3D ASCII 2.0")
    assert np.array_equal(isoatlas.open(tmp_path / "v.am").volume, array)


@pytest.mark.parametrize("coding", ["", "HxByteRLE", "HxZip"])
def test_arrays_and_components_of_amira(coding, tmp_path):
    arrays = {"Labels": samples("uint8"), "Flow": samples("float32", (*SHAPE, 3)), "Colours": samples("uint8", (*SHAPE, 4))}
    amira(tmp_path / "v.am", arrays, coding=coding)
    with pytest.raises(isoatlas.Error, match="datasets"):
        isoatlas.open(tmp_path / "v.am")
    assert np.array_equal(isoatlas.open(tmp_path / "v.am:/Labels").volume, arrays["Labels"])
    for k, name in enumerate("xyz"):
        assert np.array_equal(isoatlas.open(tmp_path / "v.am:/Flow", channel=name).volume, arrays["Flow"][..., k])
    assert np.array_equal(isoatlas.open(tmp_path / "v.am:/Colours", channel="3").volume, arrays["Colours"][..., 3])


def test_box_of_amira(tmp_path, cli):
    array = samples("int16")
    amira(tmp_path / "v.am", {"Data": array}, coding="HxByteRLE")
    cli("convert", "v.am", "--box", "1:4,2:5,0:3", "-o", "box.npy")
    assert np.array_equal(np.load(tmp_path / "box.npy"), array[0:3, 2:5, 1:4])


@pytest.mark.parametrize("packed", [False, True])
@pytest.mark.parametrize("order", ["<", ">"])
@pytest.mark.parametrize("dtype, name", [("uint8", "BYTE"), ("int16", "SHORT"), ("int32", "INT"), ("float32", "FLOAT"), ("float64", "DOUBLE")])
def test_bricks_of_values(dtype, name, order, packed, tmp_path):
    array = samples(dtype)
    data = b"head" + array.astype(array.dtype.newbyteorder(order)).tobytes()
    file = "v.values.gz" if packed else "v.values"
    (tmp_path / file).write_bytes(gzip.compress(data) if packed else data)
    nz, ny, nx = SHAPE
    (tmp_path / "v.bov").write_text(f"TIME: 3\nDATA_FILE: {file}\nDATA_SIZE: {nx} {ny} {nz}\nDATA_FORMAT: {name}\nVARIABLE: density\nBYTE_OFFSET: 4\n"
                                    f"DATA_ENDIAN: {'LITTLE' if order == '<' else 'BIG'}\nCENTERING: zonal\nBRICK_ORIGIN: 1 2 3\nBRICK_SIZE: 6 10 2\n")
    atlas = isoatlas.open(tmp_path / "v.bov")
    assert np.array_equal(atlas.volume, array)
    assert np.allclose(atlas.info["spacing"], (1, 2, 0.5)) and np.allclose(atlas.info["origin"], (1.5, 3, 3.25))


@pytest.mark.parametrize("dtype, name", [("uint8", "UCHAR"), ("uint16", "USHORT"), ("float32", "FLOAT"), ("int16", "INT16"), ("float64", "FLOAT64")])
def test_dat_and_xml_beside_raw(dtype, name, tmp_path):
    array = samples(dtype)
    array.tofile(tmp_path / "v.raw")
    nz, ny, nx = SHAPE
    (tmp_path / "v.dat").write_text(f"ObjectFileName: v.raw\nTaggedFileName: ---\nResolution: {nx} {ny} {nz}\nSliceThickness: 1 2 0.5\nFormat: {name}\nObjectType: TEXTURE_VOLUME_OBJECT\n")
    for file in ("v.raw", "v.dat"):
        atlas = isoatlas.open(tmp_path / file)
        assert np.array_equal(atlas.volume, array)
        assert np.allclose(atlas.info["spacing"], (1, 2, 0.5))
    (tmp_path / "v.dat").unlink()
    kinds = {"uint8": "Unsigned Byte", "uint16": "Unsigned Short", "float32": "Float", "int16": "Short", "float64": "Double"}
    (tmp_path / "v.xml").write_text('<?xml version="1.0" encoding="UTF-8"?>\n<image filename="v.raw" nDimensions="3"><Dataset-attributes>'
                                    f"<Data-type>{kinds[dtype]}</Data-type><Endianess>Little</Endianess>" + "".join(f"<Extents>{n}</Extents>" for n in (nx, ny, nz))
                                    + "<Resolutions><Resolution>1</Resolution><Resolution>2</Resolution><Resolution>0.5</Resolution></Resolutions>"
                                    "<Units>Micrometers</Units></Dataset-attributes></image>")
    for file in ("v.raw", "v.xml"):
        atlas = isoatlas.open(tmp_path / file)
        assert np.array_equal(atlas.volume, array)
        assert atlas.info["unit"] == "µm" and np.allclose(atlas.info["spacing"], (1, 2, 0.5))


def test_names_of_materials(tmp_path, cli):
    labels = np.zeros(SHAPE, "uint8")
    labels[1:3, 1:4, 1:3], labels[1:3, 1:4, 4:6] = 1, 2
    amira(tmp_path / "v.am", {"Labels": labels}, coding="HxByteRLE", parameters="Materials { Exterior { Id 1 } Bone { Id 2, Color 1 0 0 } \"soft tissue\" { Id 3 } }")
    listed = json.loads(cli("objects", "v.am", "--labels", "yes", "--json"))["labels"]
    assert {row["label"]: row["name"] for row in listed} == {1: "Bone", 2: "soft tissue"}


@pytest.mark.parametrize("name", ["v.bov", "v.dat", "v.am"])
def test_a_lying_header_is_one_message(name, tmp_path):
    if not CLI:
        pytest.skip("ISOATLAS_CLI does not name the command line")
    (tmp_path / "v.raw").write_bytes(bytes(100))
    (tmp_path / name).write_text({
        "v.bov": "DATA_FILE: v.raw\nDATA_SIZE: 100000 100000 100000\nDATA_FORMAT: DOUBLE\n",
        "v.dat": "ObjectFileName: v.raw\nResolution: 100000 100000 100000\nFormat: FLOAT\n",
        "v.am": "# AmiraMesh BINARY-LITTLE-ENDIAN 2.1\ndefine Lattice 100000 100000 100000\nLattice { float Data } @1(HxByteRLE,9)\n@1\n123456789\n"}[name])
    done = subprocess.run([CLI, "info", name], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 3 and done.stderr.count("\n") == 1, done.stderr
