#!/usr/bin/env python3
"""Writes the seeds of the NIfTI, VTK XML, TIFF and picture targets into tests/fuzz/corpus (the files are committed; this says how they were made)."""
import base64
import bz2
import gzip
import pathlib
import struct
import zlib

CORPUS = pathlib.Path(__file__).parent / "corpus"
SAMPLES = bytes(range(48))


def write(folder, name, content):
    path = CORPUS / folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)


def nifti1(order="<", dims=(3, 4, 3, 2, 1, 1, 1, 1), datatype=4, qform=1, sform=1, slope=0.5):
    header = bytearray(352)
    struct.pack_into(order + "i", header, 0, 348)
    struct.pack_into(order + "8h", header, 40, *dims)
    struct.pack_into(order + "hh", header, 70, datatype, 16)
    struct.pack_into(order + "8f", header, 76, -1, 2, 3, 4, 1, 1, 1, 1)
    struct.pack_into(order + "fff", header, 108, 352, slope, 7)
    header[123] = 2
    header[148:152] = b"seed"
    struct.pack_into(order + "hh", header, 252, qform, sform)
    struct.pack_into(order + "6f", header, 256, 0.5, 0.5, 0.5, 1, 2, 3)
    struct.pack_into(order + "12f", header, 280, 2, 0, 0, -1, 0, 3, 0, -2, 0, 0, 4, -3)
    header[344:348] = b"n+1\0"
    return bytes(header)


def nifti2(order="<"):
    header = bytearray(544)
    struct.pack_into(order + "i", header, 0, 540)
    header[4:12] = b"n+2\0\r\n\032\n"
    struct.pack_into(order + "hh", header, 12, 2, 8)
    struct.pack_into(order + "8q", header, 16, 3, 4, 4, 3, 1, 1, 1, 1)
    struct.pack_into(order + "8d", header, 104, 1, 2, 3, 4, 1, 1, 1, 1)
    struct.pack_into(order + "qdd", header, 168, 544, 2, 1)
    struct.pack_into(order + "ii", header, 344, 0, 1)
    struct.pack_into(order + "12d", header, 400, 2, 0, 0, -1, 0, 3, 0, -2, 0, 0, 4, -3)
    return bytes(header)


def vtk_array(samples, wide, packed, coded):
    word = "<Q" if wide else "<I"
    if not packed:
        data = struct.pack(word, len(samples)) + samples
        return base64.b64encode(data) if coded else data
    blocks = [zlib.compress(samples[i : i + 20]) for i in range(0, len(samples), 20)]
    header = b"".join(struct.pack(word, n) for n in [len(blocks), 20, len(samples) % 20] + [len(b) for b in blocks])
    if coded:
        return base64.b64encode(header) + base64.b64encode(b"".join(blocks))
    return header + b"".join(blocks)


def vti(form, wide=False, packed=False, raw=True, kind="ImageData", cells=False):
    attributes = f'type="{kind}" version="1.0" byte_order="LittleEndian" header_type="{"UInt64" if wide else "UInt32"}"'
    if packed:
        attributes += ' compressor="vtkZLibDataCompressor"'
    grid = 'WholeExtent="0 3 0 2 0 1" Origin="1 2 3" Spacing="1 2 -3" Direction="0 1 0 1 0 0 0 0 1"'
    data = "CellData" if cells else "PointData"
    array = f'<DataArray type="UInt16" Name="v" format="{form}"'
    coordinates = ""
    if kind == "RectilinearGrid":
        lines = ("0 1 2 3", "0 1 4", "-1 1")
        coordinates = "<Coordinates>" + "".join(f'<DataArray type="Float32" format="ascii">{x}</DataArray>' for x in lines) + "</Coordinates>"
    text = f'<?xml version="1.0"?><VTKFile {attributes}><{kind} {grid}><Piece Extent="0 3 0 2 0 1">{coordinates}<{data} Scalars="v">'.encode()
    if form == "appended":
        text += f'{array} offset="0"/>'.encode()
    elif form == "ascii":
        text += f"{array}>{' '.join(str(i) for i in range(24))}</DataArray>".encode()
    else:
        text += f"{array}>".encode() + vtk_array(SAMPLES, wide, packed, True) + b"</DataArray>"
    text += f"</{data}></Piece></{kind}>".encode()
    if form == "appended":
        text += f'<AppendedData encoding="{"raw" if raw else "base64"}">_'.encode() + vtk_array(SAMPLES, wide, packed, not raw) + b"</AppendedData>"
    return text + b"</VTKFile>"


def tiff(order="<", pages=2, compression=1, tiled=False, description=b""):
    """4 x 3 pixels of 16 bits a page."""
    mark = b"II" if order == "<" else b"MM"
    out = bytearray(mark + struct.pack(order + "HI", 42, 0))
    link = 4
    for page in range(pages):
        pixels = SAMPLES[page * 24 :][:24]
        if tiled:
            pixels = pixels.ljust(512, b"\0")
        if compression == 8:
            pixels = zlib.compress(pixels)
        if compression == 32773:
            pixels = bytes([len(pixels) - 1]) + pixels
        at = len(out)
        out += pixels + b"\0" * (len(pixels) % 2)
        text_at = len(out)
        text = description + b"\0" * (2 - len(description) % 2)
        out += text
        entries = [(256, 3, 1, 4), (257, 3, 1, 3), (258, 3, 1, 16), (259, 3, 1, compression), (262, 3, 1, 1), (270, 2, len(text), text_at)]
        if tiled:
            entries += [(277, 3, 1, 1), (322, 3, 1, 16), (323, 3, 1, 16), (324, 4, 1, at), (325, 4, 1, len(pixels))]
        else:
            entries += [(273, 4, 1, at), (277, 3, 1, 1), (278, 3, 1, 3), (279, 4, 1, len(pixels))]
        struct.pack_into(order + "I", out, link, len(out))
        out += struct.pack(order + "H", len(entries))
        for tag, kind, count, value in entries:
            body = struct.pack(order + "HH", value, 0) if kind == 3 else struct.pack(order + "I", value)
            out += struct.pack(order + "HHI", tag, kind, count) + body
        link = len(out)
        out += struct.pack(order + "I", 0)
    return bytes(out)


def png(colour=0, depth=8, channels=1, interlaced=False, table=False, chunks=()):
    """6 x 4 pixels (interlaced: 1 x 1)."""
    width, height = (1, 1) if interlaced else (6, 4)
    row = (width * channels * depth + 7) // 8
    rows = b"".join(b"\0" + (2 * SAMPLES)[y : y + row] for y in range(height))
    parts = [(b"IHDR", struct.pack(">IIBBBBB", width, height, depth, colour, 0, 0, interlaced))]
    if table:
        parts.append((b"PLTE", bytes(range(3 * 48))))
    parts += [*chunks, (b"IDAT", zlib.compress(rows)), (b"IEND", b"")]
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data)) for kind, data in parts)


def bmp(bits=24, height=4, core=False):
    """3 pixels wide."""
    table = b"" if bits > 8 else b"".join(bytes([i, i, 40 - i]) + (b"" if core else b"\0") for i in range(40))
    header = struct.pack("<IHHHH", 12, 3, height, 1, bits) if core else struct.pack("<IiiHHIIiiII", 40, 3, height, 1, bits, 0, 0, 2835, 2835, len(table) // 4, 0)
    begin = 14 + len(header) + len(table)
    return b"BM" + struct.pack("<IHHI", begin + 48, 0, 0, begin) + header + table + bytes(range(0, 40)) + bytes(8)


# 16 x 8 pixels of Pillow: grey levels, and progressive colours
JPEG = base64.b64decode(
    "/9j/4AAQSkZJRgABAQAAAQABAAD/2wBDABsSFBcUERsXFhceHBsgKEIrKCUlKFE6PTBCYFVlZF9VXVtqeJmBanGQc1tdhbWGkJ6jq62rZ4C8ybqmx5moq6T/wAALCAAIAB"
    "ABAREA/8QAFQABAQAAAAAAAAAAAAAAAAAAAgP/xAAXEAADAQAAAAAAAAAAAAAAAAAAAgVi/9oACAEBAAA/AAsLBVYWD//Z")
PROGRESSIVE = base64.b64decode(
    "/9j/4AAQSkZJRgABAQAAAQABAAD/2wBDACgcHiMeGSgjISMtKygwPGRBPDc3PHtYXUlkkYCZlo+AjIqgtObDoKrarYqMyP/L2u71////m8H////6/+b9//j/2wBDASstLT"
    "w1PHZBQXb4pYyl+Pj4+Pj4+Pj4+Pj4+Pj4+Pj4+Pj4+Pj4+Pj4+Pj4+Pj4+Pj4+Pj4+Pj4+Pj4+Pj4+Pj/wgARCAAIABADASIAAhEBAxEB/8QAFQABAQAAAAAAAAAAAAAA"
    "AAAAAAH/xAAUAQEAAAAAAAAAAAAAAAAAAAAC/9oADAMBAAIQAxAAAAGUb//EABQQAQAAAAAAAAAAAAAAAAAAABD/2gAIAQEAAQUCP//EABYRAAMAAAAAAAAAAAAAAAAAAA"
    "ACE//aAAgBAwEBPwGan//EABYRAQEBAAAAAAAAAAAAAAAAAAEAAv/aAAgBAgEBPwFwX//EABQQAQAAAAAAAAAAAAAAAAAAABD/2gAIAQEABj8CP//EABUQAQEAAAAAAAAA"
    "AAAAAAAAAAAR/9oACAEBAAE/Iar/2gAMAwEAAgADAAAAEPf/xAAVEQEBAAAAAAAAAAAAAAAAAAAAYf/aAAgBAwEBPxCT/8QAFREBAQAAAAAAAAAAAAAAAAAAAFH/2gAIAQ"
    "IBAT8Qjf/EABUQAQEAAAAAAAAAAAAAAAAAAAAB/9oACAEBAAE/EIx//9k=")


def main():
    write("picture", "png", png())
    write("picture", "png_bit", png(depth=1))
    write("picture", "png_deep", png(depth=16, chunks=[(b"pHYs", struct.pack(">IIB", 2835, 2835, 1))]))
    write("picture", "png_table", png(colour=3, table=True, chunks=[(b"tRNS", b"\1\2")]))
    write("picture", "png_colours", png(colour=6, channels=4))
    write("picture", "png_interlaced", png(colour=2, channels=3, depth=16, interlaced=True))
    write("picture", "bmp", bmp())
    write("picture", "bmp_alpha", bmp(bits=32, height=-3))
    write("picture", "bmp_table", bmp(bits=8))
    write("picture", "bmp_core", bmp(core=True))
    write("picture", "jpeg", JPEG)
    write("picture", "jpeg_progressive", PROGRESSIVE)
    write("nifti", "little", nifti1() + SAMPLES)
    write("nifti", "big", nifti1(">") + SAMPLES)
    write("nifti", "qform", nifti1(sform=0) + SAMPLES)
    write("nifti", "plain", nifti1(qform=0, sform=0, slope=0) + SAMPLES)
    write("nifti", "time", nifti1(dims=(4, 4, 3, 1, 2, 1, 1, 1)) + SAMPLES)
    write("nifti", "flat", nifti1(dims=(2, 6, 4, 1, 1, 1, 1, 1)) + SAMPLES)
    write("nifti", "gzip", gzip.compress(nifti1() + SAMPLES, mtime=0))
    write("nifti", "bzip2", bz2.compress(nifti1() + SAMPLES))
    write("nifti", "two", nifti2() + SAMPLES)
    write("nifti", "two_big", nifti2(">") + SAMPLES)
    for wide in (False, True):
        for packed in (False, True):
            name = ("_wide" if wide else "") + ("_zlib" if packed else "")
            write("vti", "raw" + name, vti("appended", wide, packed))
            write("vti", "base64" + name, vti("appended", wide, packed, raw=False))
            write("vti", "binary" + name, vti("binary", wide, packed))
    write("vti", "ascii", vti("ascii"))
    write("vti", "cells", vti("ascii", cells=True))
    write("vti", "rectilinear", vti("ascii", kind="RectilinearGrid"))
    write("tiff", "little", tiff())
    write("tiff", "big", tiff(">"))
    write("tiff", "deflate", tiff(compression=8))
    write("tiff", "packbits", tiff(compression=32773))
    write("tiff", "tiles", tiff(tiled=True))
    write("tiff", "tiles_deflate", tiff(tiled=True, compression=8))
    write("tiff", "imagej", tiff(description=b"ImageJ=1.5\nimages=2\nframes=2\nunit=um\nspacing=2\ncf=0\nc0=1\nc1=2\n"))
    write("tiff", "behind", tiff(pages=1, description=b"ImageJ=1.5\nimages=2\nslices=2\n") + SAMPLES)
    ome = b'<OME><Image><Pixels SizeC="1" SizeT="2" SizeZ="1" DimensionOrder="XYTZC" PhysicalSizeX="2"/></Image></OME>'
    write("tiff", "ome", tiff(description=ome))
    pixels = b'<OME UUID="a"><Image><Pixels SizeX="4" SizeY="3" SizeZ="2" SizeC="1" SizeT="1" DimensionOrder="XYCZT">%s</Pixels></Image></OME>'
    files = b"".join(b'<TiffData FirstZ="%d" IFD="%d"><UUID FileName="%s">b</UUID></TiffData>' % (z, z, name) for z, name in enumerate((b"fuzz", b"b.tif")))
    write("tiff", "ome_files", tiff(description=pixels % files))
    write("tiff", "ome_planes", tiff(description=pixels % b'<TiffData IFD="0" PlaneCount="2"/>'))
    write("tiff", "ome_elsewhere", tiff(description=b'<OME><BinaryOnly MetadataFile="b.tif"/></OME>'))
    write("tiff", "hyperstack", tiff(description=b"ImageJ=1.5\nimages=2\nchannels=1\nslices=1\nframes=2\nfinterval=2\n"))


if __name__ == "__main__":
    main()
