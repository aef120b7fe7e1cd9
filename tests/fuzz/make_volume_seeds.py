#!/usr/bin/env python3
"""Writes the seeds of the NRRD, MetaImage, NumPy, MRC, Amira, BOV, legacy VTK, Zarr, DICOM and RAW targets into tests/fuzz/corpus (the files are committed; this says how they were made)."""
import bz2
import gzip
import io
import json
import pathlib
import struct
import zipfile
import zlib

CORPUS = pathlib.Path(__file__).parent / "corpus"
SAMPLES = bytes(range(48))


def write(folder, name, content):
    path = CORPUS / folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)


def nrrd(version, fields, payload):
    return f"NRRD000{version}\n{fields}\n".encode() + payload


def mrc(mode, size=(2, 3, 4), axes=(1, 2, 3), angles=(90, 90, 90), order="<", space_group=1, cells=(2, 3, 4), start=(0, 0, 0), origin=(0, 0, 0), extended=0):
    header = struct.pack(order + "10i6f3i3f2i", *size, mode, *start, *cells, 4, 6, 8, *angles, *axes, 0, -1, -2, space_group, extended)
    header += bytes(100) + struct.pack(order + "3f", *origin) + b"MAP " + (b"DD" if order == "<" else b"\x11\x11") + bytes(2)
    return header + struct.pack(order + "fi", -1, 1) + b"seed".ljust(80) + bytes(720) + bytes(extended)


def crc32c(data):
    remainder = 0xffffffff
    for byte in data:
        remainder ^= byte
        for _ in range(8):
            remainder = remainder >> 1 ^ (0x82f63b78 if remainder & 1 else 0)
    return remainder ^ 0xffffffff


def keys(values):
    """A hierarchy as the Zarr target reads it: "key length", then the value."""
    return b"".join(f"{key} {len(value)}\n".encode() + value for key, value in values.items())


def document(**members):
    return json.dumps(members).encode()


def zarr_2(**more):
    return document(**{"zarr_format": 2, "shape": [4, 3, 2], "chunks": [4, 3, 2], "dtype": "<u2", "order": "C", "filters": None, "compressor": None, "fill_value": 1, **more})


def zarr_3(codecs, chunk=(4, 3, 2), **more):
    grid = {"name": "regular", "configuration": {"chunk_shape": chunk}}
    return document(**{"zarr_format": 3, "node_type": "array", "shape": [4, 3, 2], "data_type": "uint16", "chunk_grid": grid,
                       "chunk_key_encoding": {"name": "default"}, "fill_value": 0, "codecs": codecs, **more})


def zarr_seeds():
    image = {"axes": ["z", "y", "x"], "datasets": [{"path": "0", "coordinateTransformations": [{"type": "scale", "scale": [1, 2, 3]}]}, {"path": "1"}]}
    group, attributes = document(zarr_format=2), document(multiscales=[image], omero={"channels": [{"label": "a"}]})
    write("zarr", "raw", keys({".zarray": zarr_2(), "0.0.0": SAMPLES}))
    write("zarr", "turned", keys({".zarray": zarr_2(dtype=">f2", order="F", chunks=[3, 2, 2], dimension_separator="/", fill_value="NaN"), "0/0/0": SAMPLES[:24], "1/1/0": SAMPLES[24:]}))
    packed = [("zlib", zlib.compress(SAMPLES)), ("gzip", gzip.compress(SAMPLES, mtime=0)), ("bz2", bz2.compress(SAMPLES)), ("lz4", struct.pack("<I", 48) + b"\xf0\x21" + SAMPLES),
              ("zstd", bytes.fromhex("28b52ffd2030810100") + SAMPLES), ("blosc", struct.pack("<4B3I", 2, 1, 0x02, 2, 48, 48, 64) + SAMPLES)]
    for name, value in packed:
        write("zarr", name, keys({".zarray": zarr_2(compressor={"id": name}), "0.0.0": value}))
    filters = [{"id": "delta", "dtype": "<u2"}, {"id": "fixedscaleoffset", "dtype": "<u2", "astype": "<u2", "scale": 2, "offset": 1}, {"id": "shuffle", "elementsize": 2}]
    write("zarr", "filters", keys({".zarray": zarr_2(filters=filters), "0.0.0": SAMPLES}))
    write("zarr", "image", keys({".zgroup": group, ".zattrs": attributes, "0/.zarray": zarr_2(), "0/0.0.0": SAMPLES, "1/.zarray": zarr_2(shape=[2, 2, 1])}))
    plate = {"plate": {"wells": [{"path": "A/1"}]}}
    write("zarr", "plate", keys({".zattrs": document(**plate), "A/1/.zattrs": document(well={"images": [{"path": "0"}]}), "A/1/0/.zattrs": attributes, "A/1/0/0/.zarray": zarr_2(), "A/1/0/0/0.0.0": SAMPLES}))
    write("zarr", "group", keys({".zgroup": group, "a/b/.zarray": zarr_2(), "a/.zgroup": group, "a/b/0.0.0": SAMPLES, "cannot list": b"", ".zmetadata": document(metadata={"a/.zgroup": {}})}))
    little = {"name": "bytes", "configuration": {"endian": "little"}}
    write("zarr", "three", keys({"zarr.json": zarr_3([{"name": "transpose", "configuration": {"order": [2, 0, 1]}}, little, {"name": "crc32c"}], dimension_names=["z", "y", "x"]),
                                 "c/0/0/0": SAMPLES + struct.pack("<I", crc32c(SAMPLES))}))
    places = struct.pack("<4Q", 0, 24, 24, 24)
    shards = {"name": "sharding_indexed", "configuration": {"chunk_shape": [2, 3, 2], "codecs": [little], "index_codecs": [little, {"name": "crc32c"}]}}
    write("zarr", "shards", keys({"zarr.json": zarr_3([shards]), "c/0/0/0": SAMPLES + places + struct.pack("<I", crc32c(places))}))
    shards["configuration"].update(index_location="start", index_codecs=[little])
    write("zarr", "start", keys({"zarr.json": zarr_3([shards]), "c/0/0/0": struct.pack("<4Q", 2**64 - 1, 2**64 - 1, 32, 24) + SAMPLES[:24]}))
    five = [{"name": name, "type": kind, "unit": unit} for name, kind, unit in (("t", "time", "second"), ("c", "channel", ""), ("y", "space", "micrometer"), ("x", "space", "nanometer"))]
    ome = {"version": "0.5", "multiscales": [{"axes": five, "datasets": [{"path": "s", "coordinateTransformations": [{"type": "translation", "translation": [1, 2, 3, -4]}]}]}]}
    write("zarr", "ome", keys({"zarr.json": document(zarr_format=3, node_type="group", attributes={"ome": ome}), "s/zarr.json": zarr_3([little], [1, 2, 3, 2], shape=[2, 2, 3, 2]), "s/c/1/0/0/0": SAMPLES[:24]}))
    for name, method in (("stored", zipfile.ZIP_STORED), ("deflated", zipfile.ZIP_DEFLATED)):
        archive = io.BytesIO()
        with zipfile.ZipFile(archive, "w", method) as file:
            for key, value in ((".zarray", zarr_2()), ("0.0.0", SAMPLES)):
                file.writestr(zipfile.ZipInfo(key), value, method)
        write("zarr", name, archive.getvalue())


def amira_seeds():
    def mesh(arrays, sections, first="BINARY-LITTLE-ENDIAN 2.1", parameters='CoordType "uniform", BoundingBox 0 1 0 2 0 3', more=""):
        text = f"# AmiraMesh {first}\n# seed\ndefine Lattice 2 3 4\n{more}Parameters {{ Units {{ Coordinates \"um\" }} {parameters} }}\n{arrays}\n"
        return text.encode() + b"".join(b"@%d\n%s\n" % (i + 1, section) for i, section in enumerate(sections))

    runs, packed = b"\x05a\x82bc\x7fd\x00e\x80", zlib.compress(SAMPLES)
    write("amira", "raw", mesh("Lattice { short Data } @1", [SAMPLES], "BINARY 1.9"))
    write("amira", "runs", mesh(f"Lattice {{ byte Labels }} = @1(HxByteRLE,{len(runs)})", [runs], parameters="Materials { Exterior { Id 1 } A { Color 1 0.5 0 } }"))
    write("amira", "zip", mesh(f"Lattice {{ ushort Data }} @1(HxZip,{len(packed)})", [packed], parameters="TransformationMatrix 0 1 0 0 -1 0 0 0 0 0 1 0 1 2 3 1"))
    lines = b"".join(struct.pack("<f", place) for place in (0, 2, 0, 1, 3, 0, 1, 2, 5))
    write("amira", "lines", mesh("Coordinates { float xyz } @1\nLattice { byte Data } @2", [lines, SAMPLES[:24]], parameters='CoordType "rectilinear"', more="define Coordinates 9\n"))
    write("amira", "vectors", mesh("Lattice { byte[2] Data } @1", [SAMPLES]))
    write("amira", "several", mesh("Lattice { byte A } @1\nLattice { byte B } @2", [SAMPLES[:24], SAMPLES[24:]]))
    write("amira", "text", mesh("Lattice { float Data } @1", [b" ".join(b"%d" % i for i in range(24))], "3D ASCII 2.0"))


def text_header_seeds():
    bov = "# seed\nTIME: 1.5\nDATA_FILE: {}\nDATA_SIZE: 2 3 4\nDATA_FORMAT: {}\nDATA_ENDIAN: BIG\nVARIABLE: v\nBRICK_ORIGIN: 1 2 3\nBRICK_SIZE: 2 3 4\nCENTERING: {}\n{}"
    write("bov", "nodal", bov.format("v.raw", "BYTE", "nodal", "BYTE_OFFSET: 9\n").encode())
    write("bov", "zonal", bov.format("v.raw", "FLOAT", "zonal", "DATA_COMPONENTS: 2\n").encode())
    write("bov", "gzip", bov.format("v.gz", "SHORT", "nodal", "").encode())
    write("bov", "bricks", bov.format("v%03d", "BYTE", "nodal", "DIVIDE_BRICK: true\nDATA_BRICKLETS: 1 3 4\n").encode())
    write("raw_header", "library", b"ObjectFileName:\tv.raw\nTaggedFileName: ---\nResolution: 2 3 4\nSliceThickness: 1 2 0.5\nFormat: UCHAR\nByteOffset: 60\nObjectModel: I\nGridType: EQUIDISTANT\n")
    write("raw_header", "inviwo", b"RawFile: v.raw\nRawFile: w.raw\nResolution: 2 3 4\nFormat: Vec2UINT8\nByteOffset: 4\nLittleEndian: true\nBasisVector1: 0 4 0\nBasisVector2: -6 0 0\nBasisVector3: 0 0 2\nOffset: 1 2 3\n")
    sizes = "".join(f"<Extents>{size}</Extents>" for size in (2, 3, 4))
    write("raw_header", "mipav", ('<?xml version="1.0"?>\n<image filename="v.raw" nDimensions="3"><Dataset-attributes><Image-offset>7</Image-offset><Data-type>Short</Data-type>'
                                  f"<Endianess>Big</Endianess>{sizes}<Resolutions><Resolution>1</Resolution><Resolution>2</Resolution></Resolutions><Units>Millimeters</Units>"
                                  "<Origin>1</Origin></Dataset-attributes></image>\n").encode())


def element(tag, vr, value, implicit=False):
    value += b"\0" if len(value) % 2 and vr == "UI" else b" " * (len(value) % 2)
    head = struct.pack("<HH", tag >> 16, tag & 0xFFFF)
    if implicit:
        return head + struct.pack("<I", len(value)) + value
    return head + vr.encode() + (struct.pack("<HI", 0, len(value)) if vr in ("OW", "SQ") else struct.pack("<H", len(value))) + value


def dicom(syntax="1.2.840.10008.1.2.1", implicit=False, more=(), pixels=None, frames=1):
    uid = element(0x00020010, "UI", syntax.encode())
    numbers = {0x00280002: 1, 0x00280010: 3, 0x00280011: 4, 0x00280100: 8, 0x00280101: 8, 0x00280102: 7, 0x00280103: 0}
    elements = {0x00080060: ("CS", b"CT"), 0x0020000E: ("UI", b"1.2.3"), 0x00200032: ("DS", b"1\\2\\3"), 0x00200037: ("DS", b"1\\0\\0\\0\\1\\0"),
                0x00280008: ("IS", str(frames).encode()), 0x00280030: ("DS", b"0.5\\0.25"), 0x00281052: ("DS", b"-1024"), 0x00281053: ("DS", b"2")}
    elements |= {tag: ("US", struct.pack("<H", value)) for tag, value in numbers.items()} | dict(more)
    content = b"".join(element(tag, *elements[tag], implicit) for tag in sorted(elements))
    pixels = element(0x7FE00010, "OW", SAMPLES[:12 * frames], implicit) if pixels is None else pixels
    return bytes(128) + b"DICM" + element(0x00020000, "UL", struct.pack("<I", len(uid))) + uid, content + pixels


def fragments(*all):
    item = lambda value, kind=0xE000: struct.pack("<HHI", 0xFFFE, kind, len(value)) + value
    return struct.pack("<HH", 0x7FE0, 0x10) + b"OB\0\0\xff\xff\xff\xff" + item(b"") + b"".join(map(item, all)) + item(b"", 0xE0DD)


def sequence(tag, *items):
    return tag, ("SQ", b"".join(struct.pack("<HHI", 0xFFFE, 0xE000, len(one)) + one for one in items))


def main():
    zarr_seeds()
    amira_seeds()
    text_header_seeds()
    oriented = (
        "type: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 2 3 4\nspace directions: (1,0,0) (0,1,0) (0,0,2)\n"
        'space units: "mm" "mm" "mm"\nspace origin: (1,2,3)\nkinds: domain domain domain\nendian: little\n'
    )
    plain = "type: uchar\ndimension: 3\nsizes: 4 3 4\nspacings: 1 2 nan\naxis mins: 0 1 2\ncenters: cell node ???\ncontent: seed\n"
    write("nrrd", "raw", nrrd(4, oriented + "encoding: raw\n", SAMPLES))
    write("nrrd", "gzip", nrrd(5, oriented + "encoding: gzip\n", gzip.compress(SAMPLES, mtime=0)))
    write("nrrd", "plain", nrrd(1, plain + "encoding: raw\ncalibration_slope:=-2\ncalibration_intercept:=1e3\n", SAMPLES))
    write("nrrd", "skip", nrrd(4, plain + "encoding: raw\nline skip: 1\nbyte skip: -1\n", b"line\n" + SAMPLES))
    write("nrrd", "text", nrrd(2, "type: float\ndimension: 2\nsizes: 3 2\nencoding: ascii\n", b"1 -2.5 3e8 nan inf 1e-50\n"))
    write("nrrd", "detached", nrrd(4, plain + "encoding: raw\nbyte skip: -1\ndata file: v.raw\n", b""))
    write("nrrd", "series", nrrd(4, plain + "encoding: raw\nbyte skip: 9\ndata file: s%03d.raw 1 4 1 2\n", b""))
    write("nrrd", "list", nrrd(4, plain + "encoding: raw\nbyte skip: 9\ndata file: LIST\na\nb\n", b""))
    write("nrrd", "longer", nrrd(5, oriented + "encoding: gzip\n", gzip.compress(SAMPLES + b"more", mtime=0)))
    write("nrrd", "members", nrrd(5, oriented + "encoding: gzip\n", gzip.compress(SAMPLES[:20], mtime=0) + gzip.compress(SAMPLES[20:], mtime=0)))
    write("nrrd", "behind", nrrd(5, oriented + "encoding: gzip\n", gzip.compress(SAMPLES, mtime=0) + b"garbage"))
    streams = bz2.compress(SAMPLES[:20]) + bz2.compress(SAMPLES[20:], 1)
    for name, payload in (("bzip2", bz2.compress(SAMPLES)), ("streams", streams), ("longer_bzip2", bz2.compress(SAMPLES + b"more") + b"BZh")):
        write("nrrd", name, nrrd(5, oriented + "encoding: bzip2\n", payload))
    write("nrrd", "skip_bzip2", nrrd(5, plain + "encoding: bz2\nbyte skip: 4\n", bz2.compress(b"skip" + SAMPLES)))
    write("nrrd", "elsewhere", nrrd(4, plain + "encoding: raw\nbyte skip: -1\ndata file: ../v.raw\n", b""))
    latin = 'content: Sch\xe4del\nspace units: "\xb5m" "\xb5m" "\xb5m"\nsample units: \xb0C\n'.encode("latin-1")
    write("nrrd", "latin", b"NRRD0004\n" + oriented.replace('space units: "mm" "mm" "mm"\n', "").encode() + b"encoding: raw\n" + latin + b"\n" + SAMPLES)
    write("nrrd", "cut", nrrd(2, "type: int\ndimension: 2\nsizes: 2 2\nencoding: ascii\n", b"1 2 3 4"))
    time = "type: uchar\ndimension: 4\nsizes: 2 3 4 2\nkinds: space space space time\nencoding: raw\n"
    write("nrrd", "time", nrrd(4, time, SAMPLES))
    write("nrrd", "colour", nrrd(4, "type: uchar\ndimension: 3\nsizes: 3 4 4\nkinds: RGB-color domain domain\nencoding: raw\n", SAMPLES))

    for mode, bytes_of_samples in ((0, 24), (1, 48), (6, 48), (12, 48), (2, 96), (4, 192)):
        write("mrc", f"mode_{mode}", mrc(mode) + (4 * SAMPLES)[:bytes_of_samples])
    write("mrc", "big", mrc(1, order=">", extended=160) + SAMPLES)
    write("mrc", "turned", mrc(0, axes=(3, 1, 2), angles=(90, 94.3, 90), start=(0, -21, -12)) + SAMPLES[:24])
    write("mrc", "stack", mrc(0, space_group=401, cells=(2, 3, 2), origin=(1, 2, 3)) + SAMPLES[:24])
    write("mrc", "gzip", gzip.compress(mrc(1, extended=160) + SAMPLES, mtime=0))
    write("mrc", "bzip2", bz2.compress(mrc(1, extended=160) + SAMPLES))
    write("mrc", "image", mrc(0, size=(6, 4, 1), space_group=0) + SAMPLES[:24])

    write("dicom", "explicit", b"".join(dicom()))
    write("dicom", "implicit", b"".join(dicom("1.2.840.10008.1.2", True)))
    write("dicom", "bare", dicom(implicit=True, more={0x00080016: ("UI", b"1.2.840.10008.5.1.4.1.1.2")}.items())[1])
    meta, content = dicom("1.2.840.10008.1.2.1.99")
    packer = zlib.compressobj(9, zlib.DEFLATED, -15)
    write("dicom", "deflated", meta + packer.compress(content) + packer.flush())
    run = struct.pack("<2I", 1, 64) + bytes(56) + b"\x0b" + SAMPLES[:12] + b"\0"
    write("dicom", "rle", b"".join(dicom("1.2.840.10008.1.2.5", pixels=fragments(run))))
    # lossless: 4x3 samples of 8 bits; a table of one code (a difference of zero); 12 such differences
    jpeg = bytes.fromhex("ffd8 ffc3000b08000300040101 1100 ffc4001400 01000000000000000000000000000000 00 ffda00080101 00010000 000f ffd9")
    write("dicom", "jpeg", b"".join(dicom("1.2.840.10008.1.2.4.70", pixels=fragments(jpeg))))
    write("dicom", "frames", b"".join(dicom(frames=3, more={0x00180088: ("DS", b"2")}.items())))
    frame = lambda place: sequence(0x00209113, element(0x00200032, "DS", place))
    frames = [element(*[frame(place)[0], *frame(place)[1]]) for place in (b"0\\0\\2", b"0\\0\\1")]
    write("dicom", "enhanced", b"".join(dicom(frames=2, more=[sequence(0x52009230, *frames)])))

    grid = "DIMENSIONS 2 3 4\nORIGIN 1 2 3\nSPACING 1 -2 0.5\n"
    head = lambda encoding, kind="STRUCTURED_POINTS": f"# vtk DataFile Version 3.0\nseed\n{encoding}\nDATASET {kind}\n"
    numbers = " ".join(map(str, range(24))) + "\n"
    scalars = "SCALARS values {} 1\nLOOKUP_TABLE default\n"
    write("vtk_legacy", "text", (head("ASCII") + grid + "POINT_DATA 24\n" + scalars.format("short") + numbers).encode())
    write("vtk_legacy", "binary", (head("BINARY") + grid + "POINT_DATA 24\n" + scalars.format("unsigned_short")).encode() + SAMPLES + b"\n")
    cells = "CELL_DATA 6\nFIELD FieldData 2\nfirst 3 6 char\n" + "1 2 3 " * 6 + "\nMETADATA\nINFORMATION 0\n\nsecond 1 6 float\n1 2 3 4 5 6\n"
    write("vtk_legacy", "cells", (head("ASCII") + grid + cells).encode())
    write("vtk_legacy", "both", (head("ASCII") + grid + cells + "POINT_DATA 24\nVECTORS v float\n" + 3 * numbers + scalars.format("int") + numbers).encode())
    lines = "DIMENSIONS 2 3 4\nX_COORDINATES 2 float\n0 1\nY_COORDINATES 3 double\n0 1 3\nZ_COORDINATES 4 int\n0 1 2 9\n"
    write("vtk_legacy", "lines", (head("ASCII", "RECTILINEAR_GRID") + lines + "POINT_DATA 24\nCOLOR_SCALARS c 1\n" + numbers + "SCALARS s float\n" + numbers).encode())

    meta = (
        "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = True\nTransformMatrix = 1 0 0 0 1 0 0 0 1\n"
        "Offset = 1 2 3\nCenterOfRotation = 0 0 0\nAnatomicalOrientation = RAI\nElementSpacing = 1 2 3\nDimSize = 2 3 4\nElementType = MET_SHORT\n"
    )
    local = "ElementDataFile = LOCAL\n"
    packed = zlib.compress(SAMPLES)
    write("metaimage", "raw", (meta + local).encode() + SAMPLES)
    write("metaimage", "zlib", (meta + f"CompressedData = True\nCompressedDataSize = {len(packed)}\n" + local).encode() + packed)
    write("metaimage", "longer", (meta + "CompressedData = True\nComment = Sch\xe4del\n" + local).encode("latin-1") + zlib.compress(SAMPLES + b"more"))
    write("metaimage", "damaged", (meta.replace("BinaryDataByteOrderMSB ", "BinaryDataByteOrderMSB0") + local).encode() + SAMPLES)
    write("metaimage", "detached", (meta + "HeaderSize = -1\nElementDataFile = v.raw\n").encode())
    write("metaimage", "list", (meta + "HeaderSize = 5\nElementDataFile = LIST\na\nb\nc\n").encode())
    write("metaimage", "series", (meta + "HeaderSize = 5\nElementDataFile = s%03d.raw 1 4 1\n").encode())
    write("metaimage", "text", b"NDims = 2\nDimSize = 2 2\nElementType = MET_DOUBLE\nBinaryData = False\nElementDataFile = LOCAL\n1 2 3 4e5\n")
    write("metaimage", "time", b"NDims = 4\nDimSize = 2 3 4 2\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n" + SAMPLES)

    for version in (1, 2, 3):
        for name, descr, fortran, shape in (
            ("short", "'<i2'", False, "(4, 3, 2)"),
            ("float", "'>f4'", True, "(4, 3)"),
            ("bool", "'|b1'", False, "(2, 4, 3, 2)"),
            ("fields", "[('a', '<f4')]", False, "(4, 3)"),
        ):
            text = f"{{'descr': {descr}, 'fortran_order': {fortran}, 'shape': {shape}, }}\n".encode()
            length = struct.pack("<H" if version == 1 else "<I", len(text))
            write("npy", f"{name}{version}", b"\x93NUMPY" + bytes([version, 0]) + length + text + SAMPLES)

    write("raw", "all", b'{"dims": [2, 3, 4], "type": "int16", "endian": "big", "skip": 3, "spacing": [1, 2, 0.5], "origin": [0, 0, 0], "unit": "um", "space": "RAS"}')
    write("raw", "zeros", b'{"dims": [2, 3, 4], "type": "u8", "spacing": [0, 1, 1], "unit": "\xb5m"}')
    write("raw", "few", b'{"dims": [2, 3], "type": "u8"}')
    write("raw", "name", b"foo_512x512x128_float32_be.raw")


main()
