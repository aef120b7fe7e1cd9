"""Slices in PNG, JPEG and BMP files written by Pillow: sample by sample; folders that do not fit; and hostile files."""
import io
import struct
import subprocess
import zlib

import numpy as np
import pytest

import isoatlas
from conftest import CLI

Image = pytest.importorskip("PIL.Image")
PngImagePlugin = pytest.importorskip("PIL.PngImagePlugin")

BT601 = (19595, 38470, 7471)
needs_cli = pytest.mark.skipif(not CLI, reason="ISOATLAS_CLI does not name the command line")


def random(shape, seed=1, high=256, dtype="uint8"):
    return np.random.default_rng(seed).integers(0, high, shape).astype(dtype)


def luminance(colours):
    return ((sum(weight * colours[..., i].astype("int64") for i, weight in enumerate(BT601)) + 32768) >> 16).astype(colours.dtype)


def expect(path, array, **options):
    atlas = isoatlas.open(path, **options)
    assert atlas.volume.dtype == array.dtype and np.array_equal(atlas.volume, array)
    return atlas


def expect_colours(path, colours, **options):
    for i, name in enumerate(["red", "green", "blue"]):
        expect(path, colours[..., i], channel=name, **options)
    atlas = expect(path, luminance(colours), **options)
    assert any("luminance" in note for note in atlas.info["notes"])
    return atlas


def save_slices(folder, images, suffix, **options):
    folder.mkdir(exist_ok=True)
    for i, image in enumerate(images):
        image.save(folder / f"slice{i}.{suffix}", **options)
    return folder


def palette_image(indices, colours):
    image = Image.fromarray(indices, "P")
    image.putpalette([int(value) for value in np.ravel(colours)])
    return image


@pytest.mark.parametrize("suffix", ["png", "bmp", "jpg"])
def test_grey_slices_in_natural_order(suffix, tmp_path):
    array = random((12, 19, 35))
    folder = save_slices(tmp_path / "v", [Image.fromarray(one) for one in array], suffix)
    wanted = array if suffix != "jpg" else np.stack([np.asarray(Image.open(folder / f"slice{i}.jpg")) for i in range(12)])
    info = expect(folder, wanted).info
    assert info["format"] == {"png": "PNG", "bmp": "BMP", "jpg": "JPEG"}[suffix] + " slices"
    expect(folder, wanted[3:9, 2:7, 5:30], box=(slice(3, 9), slice(2, 7), slice(5, 30)))


def test_grey_of_16_bits(tmp_path):
    array = random((3, 19, 35), high=65536, dtype="uint16")
    expect(save_slices(tmp_path / "v", [Image.fromarray(one) for one in array], "png"), array)


@pytest.mark.parametrize("suffix", ["png", "bmp", "jpg"])
def test_colours(suffix, tmp_path):
    array = random((4, 19, 35, 3))
    folder = save_slices(tmp_path / "v", [Image.fromarray(one, "RGB") for one in array], suffix)
    wanted = array if suffix != "jpg" else np.stack([np.asarray(Image.open(folder / f"slice{i}.jpg")) for i in range(4)])
    expect_colours(folder, wanted)


@pytest.mark.parametrize("options", [{"progressive": True}, {"subsampling": 0}, {"optimize": True, "quality": 20}], ids=str)
def test_kinds_of_jpeg(options, tmp_path):
    array = random((3, 33, 50, 3))
    folder = save_slices(tmp_path / "v", [Image.fromarray(one, "RGB") for one in array], "jpg", **options)
    expect_colours(folder, np.stack([np.asarray(Image.open(folder / f"slice{i}.jpg")) for i in range(3)]))


@pytest.mark.parametrize("suffix", ["png", "bmp"])
def test_alpha_is_ignored_with_a_note(suffix, tmp_path):
    array = random((3, 19, 35, 4))
    folder = save_slices(tmp_path / "v", [Image.fromarray(one, "RGBA") for one in array], suffix)
    info = expect_colours(folder, array[..., :3]).info
    assert any("alpha" in note for note in info["notes"])


def test_grey_with_alpha(tmp_path):
    array = random((3, 19, 35, 2))
    info = expect(save_slices(tmp_path / "v", [Image.fromarray(one, "LA") for one in array], "png"), array[..., 0]).info
    assert any("alpha" in note for note in info["notes"])


@pytest.mark.parametrize("mode, key", [("L", 7), ("RGB", (1, 2, 3)), ("P", 3)])
def test_transparent_colours_are_ignored_with_a_note(mode, key, tmp_path):
    array = random((9, 8, 3) if mode == "RGB" else (9, 8), high=16)
    image = palette_image(array, [[i, 0, i] for i in range(16)]) if mode == "P" else Image.fromarray(array, mode)
    image.save(tmp_path / "v.png", transparency=key)
    atlas = isoatlas.open(tmp_path / "v.png", channel="index") if mode == "P" else isoatlas.open(tmp_path / "v.png")
    assert np.array_equal(atlas.volume, luminance(array) if mode == "RGB" else array)
    assert any("alpha" in note for note in atlas.info["notes"])


@pytest.mark.parametrize("suffix", ["png", "bmp"])
@pytest.mark.parametrize("colours", [2, 4, 16, 100, 256])
def test_colour_tables(colours, suffix, tmp_path):
    indices, table = random((3, 19, 35), high=colours), random((colours, 3), 2)
    folder = save_slices(tmp_path / "v", [palette_image(one, table) for one in indices], suffix)
    expect_colours(folder, table[indices])
    expect(folder, indices, channel="index")


def test_grey_tables_are_grey_levels(tmp_path):
    indices, levels = random((3, 19, 35), high=40), random(40, 2)
    folder = save_slices(tmp_path / "v", [palette_image(one, np.repeat(levels[:, None], 3, 1)) for one in indices], "png")
    info = expect(folder, levels[indices]).info
    assert any("colour table" in note for note in info["notes"])


def test_one_bit(tmp_path):
    array = random((3, 19, 35), high=2).astype(bool)
    folder = save_slices(tmp_path / "v", [Image.fromarray(one) for one in array], "png")
    info = expect(folder, array.astype("uint8") * 255).info
    assert any("1 bits are scaled" in note for note in info["notes"])


@pytest.mark.parametrize("suffix, options, length", [("png", {"dpi": (254, 127)}, 1), ("jpg", {"dpi": (254, 127)}, 1), ("bmp", {"dpi": (254, 127)}, 1),
                                                     ("png", {}, 0), ("jpg", {}, 0)])
def test_spacing(suffix, options, length, tmp_path):
    folder = save_slices(tmp_path / "v", [Image.fromarray(random((9, 8)))] * 3, suffix, **options)
    info = isoatlas.open(folder).info
    if length:
        assert info["unit"] == "mm" and np.allclose(info["spacing"], (0.1, 0.2, 0.1), rtol=1e-4)
        assert any("slice spacing" in note for note in info["notes"])
    else:
        assert info["spacing"] == [1, 1, 1] and not info["unit"]
    assert isoatlas.open(folder, spacing=(3, 2, 1)).info["spacing"] == [1, 2, 3]


def test_a_given_spacing_is_not_assumed(tmp_path):
    folder = save_slices(tmp_path / "v", [Image.fromarray(random((9, 8)))] * 3, "png", dpi=(254, 254))
    info = isoatlas.open(folder, spacing=(0.3, 0.2, 0.1)).info
    assert info["spacing"] == [0.1, 0.2, 0.3] and not any("slice spacing" in note for note in info["notes"])


def test_chunks_out_of_place_do_not_matter(tmp_path):
    image, extra = Image.fromarray(random((9, 8))), PngImagePlugin.PngInfo()
    for kind, data in [(b"gAMA", b"wrong"), (b"pHYs", b"short"), (b"iCCP", b"x\0\0no stream"), (b"tRNS", b"too long"), (b"PLTE", b"abc")]:
        extra.add(kind, data)
    image.save(tmp_path / "v.png", pnginfo=extra)
    expect(tmp_path / "v.png", np.asarray(image))


def test_spacing_without_a_unit_is_not_taken(tmp_path):
    image, extra = Image.fromarray(random((9, 8))), PngImagePlugin.PngInfo()
    extra.add(b"pHYs", b"\0\0\0\2\0\0\0\1\0")
    image.save(tmp_path / "v.png", pnginfo=extra)
    assert isoatlas.open(tmp_path / "v.png").info["spacing"] == [1, 1, 1]


@pytest.mark.parametrize("suffix", ["png", "bmp"])
def test_single_file_is_an_image(suffix, tmp_path):
    array = random((19, 35))
    Image.fromarray(array).save(tmp_path / f"v.{suffix}")
    info = expect(tmp_path / f"v.{suffix}", array).info
    assert any("2D image" in note for note in info["notes"])


def test_content_decides_not_the_name(tmp_path):
    array = random((3, 9, 8))
    folder = tmp_path / "v"
    folder.mkdir()
    for i, one in enumerate(array):
        Image.fromarray(one).save(folder / f"slice{i}", format="PNG")
    expect(folder, array)
    Image.fromarray(array[0]).save(tmp_path / "v.jpg", format="PNG")
    expect(tmp_path / "v.jpg", array[0])


def test_top_down_and_old_bmp(tmp_path):
    array = random((5, 7, 3))
    Image.fromarray(array, "RGB").save(tmp_path / "v.bmp")
    whole = bytearray((tmp_path / "v.bmp").read_bytes())
    rows = np.frombuffer(bytes(whole[54:]), "uint8").reshape(5, 24)
    whole[22:26] = (-5).to_bytes(4, "little", signed=True)
    (tmp_path / "top.bmp").write_bytes(bytes(whole[:54]) + rows[::-1].tobytes())
    expect_colours(tmp_path / "top.bmp", array)
    core = b"BM" + (26 + 120).to_bytes(4, "little") + bytes(4) + (26).to_bytes(4, "little") + (12).to_bytes(4, "little")
    core += b"".join(value.to_bytes(2, "little") for value in (7, 5, 1, 24))
    (tmp_path / "core.bmp").write_bytes(core + rows.tobytes())
    expect_colours(tmp_path / "core.bmp", array)


def png(array, depth, colour, interlaced):
    """A PNG file of rows without filters; array: (height, width, channels)."""
    passes = [(0, 0, 8, 8), (4, 0, 8, 8), (0, 4, 4, 8), (2, 0, 4, 4), (0, 2, 2, 4), (1, 0, 2, 2), (0, 1, 1, 2)] if interlaced else [(0, 0, 1, 1)]
    rows = b""
    for x, y, dx, dy in passes:
        part = array[y::dy, x::dx]
        for row in part.reshape(len(part), -1) if part.size else []:
            wide = row.astype(">u2" if depth == 16 else "u1").view("u1")
            bits = np.unpackbits(wide[:, None], axis=1)
            rows += b"\0" + np.packbits(bits if depth >= 8 else bits[:, 8 - depth:]).tobytes()
    header = struct.pack(">IIBBBBB", array.shape[1], array.shape[0], depth, colour, 0, 0, interlaced)
    parts = [(b"IHDR", header), (b"IDAT", zlib.compress(rows)), (b"IEND", b"")]
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data)) for kind, data in parts)


@pytest.mark.parametrize("interlaced", [False, True])
@pytest.mark.parametrize("depth, colour, channels", [(1, 0, 1), (2, 0, 1), (4, 0, 1), (8, 0, 1), (16, 0, 1), (8, 2, 3), (16, 2, 3), (8, 4, 2), (16, 4, 2),
                                                     (8, 6, 4), (16, 6, 4)])
def test_depths_and_interlaced_rows(depth, colour, channels, interlaced, tmp_path):
    folder = tmp_path / "v"
    folder.mkdir()
    array = random((3, 19, 35, channels), high=2**depth, dtype="uint16" if depth == 16 else "uint8")
    for i, one in enumerate(array):
        (folder / f"{i}.png").write_bytes(png(one, depth, colour, interlaced))
    if channels >= 3:
        expect_colours(folder, array[..., :3])
    else:
        expect(folder, array[..., 0] * (255 // (2**depth - 1) if depth < 8 else 1))


def failure(path, **options):
    with pytest.raises(isoatlas.Error) as error:
        isoatlas.open(path, **options).volume
    return error.value


@pytest.mark.parametrize("other", [random((9, 7)), random((10, 8)), random((9, 8, 3)), random((9, 8), high=65536, dtype="uint16")], ids=range(4))
def test_the_first_misfit_is_named(other, tmp_path):
    folder = save_slices(tmp_path / "v", [Image.fromarray(random((9, 8)))] * 12, "png")
    for i in (10, 7):
        Image.fromarray(other).save(folder / f"slice{i}.png")
    error = failure(folder)
    assert "slice7.png" in str(error) and "slice0.png" in str(error) and "\n" not in str(error)


def test_damaged_names_and_other_kinds_are_errors(tmp_path):
    folder = save_slices(tmp_path / "v", [Image.fromarray(random((9, 8)))] * 3, "png")
    (folder / "notes.txt").write_text("ignored")
    assert any("1 other" in note for note in isoatlas.open(folder).info["notes"])
    (folder / "slice1.png").write_bytes(b"")
    assert "slice1.png" in str(failure(folder))
    Image.fromarray(random((9, 8))).save(folder / "slice1.png", format="BMP")
    assert "slice1.png" in str(failure(folder))


def test_what_is_not_read_is_named(tmp_path):
    Image.fromarray(random((9, 8, 4)), "CMYK").save(tmp_path / "v.jpg")
    assert "CMYK" in str(failure(tmp_path / "v.jpg"))
    Image.fromarray(random((9, 8), high=2).astype(bool)).save(tmp_path / "v.bmp")
    assert "1 bits" in str(failure(tmp_path / "v.bmp"))


def encoded(image, form, **options):
    out = io.BytesIO()
    image.save(out, format=form, **options)
    return out.getvalue()


def small_files():
    grey, colours = Image.fromarray(random((6, 7))), Image.fromarray(random((6, 7, 3)), "RGB")
    yield "grey.png", encoded(grey, "PNG", dpi=(254, 254)), (6, 7)
    yield "deep.png", encoded(Image.fromarray(random((6, 7), high=65536, dtype="uint16")), "PNG"), (6, 7)
    yield "table.png", encoded(palette_image(random((6, 7), high=9), random((9, 3), 2)), "PNG"), (6, 7)
    yield "grey.jpg", encoded(grey, "JPEG"), (6, 7)
    yield "progressive.jpg", encoded(colours, "JPEG", progressive=True, quality=30), (6, 7)
    yield "table.bmp", encoded(palette_image(random((6, 7)), random((256, 3), 2)), "BMP"), (6, 7)
    yield "colours.bmp", encoded(colours, "BMP"), (6, 7)


SMALL = {name: (content, shape) for name, content, shape in small_files()}


@pytest.mark.parametrize("name", SMALL)
def test_every_truncation_is_refused(name, tmp_path):
    whole, _ = SMALL[name]
    for size in [*range(0, len(whole), 16), len(whole) - 1]:
        (tmp_path / name).write_bytes(whole[:size])
        error = failure(tmp_path / name)
        assert isinstance(error, (isoatlas.InputError, isoatlas.UnsupportedError)) and "\n" not in str(error), size


@pytest.mark.parametrize("name", SMALL)
def test_every_damaged_byte(name, tmp_path, capfd):
    whole, shape = SMALL[name]
    read = 0
    for place in range(len(whole)):
        for bits in (255, 1):
            (tmp_path / name).write_bytes(whole[:place] + bytes([whole[place] ^ bits]) + whole[place + 1:])
            try:
                volume = isoatlas.open(tmp_path / name).volume
            except (isoatlas.InputError, isoatlas.UnsupportedError) as error:
                assert "\n" not in str(error), place
            else:
                read += 1
                assert volume.size <= 4096 * len(whole), place
    assert name.endswith(".png") <= (read == 0)  # every byte of PNG is in a checksum
    assert capfd.readouterr().err == ""


@needs_cli
@pytest.mark.parametrize("name", SMALL)
def test_the_command_line_says_one_line(name, tmp_path):
    whole, _ = SMALL[name]
    (tmp_path / name).write_bytes(whole[:len(whole) - 3])
    done = subprocess.run([CLI, "convert", tmp_path / name, "-o", tmp_path / "v.npy"], capture_output=True, text=True, timeout=60)
    assert done.returncode == 3 and done.stderr.count("\n") == 1


@pytest.mark.parametrize("name, place", [("grey.png", 16), ("grey.jpg", None), ("colours.bmp", 18)])
def test_claims_beyond_the_file_are_refused(name, place, tmp_path):
    whole = bytearray(SMALL[name][0])
    if name.endswith(".png"):
        whole[16:24] = (30000).to_bytes(4, "big") * 2
        whole[29:33] = zlib.crc32(whole[12:29]).to_bytes(4, "big")
    elif name.endswith(".jpg"):
        place = whole.index(b"\xff\xc0") + 5
        whole[place:place + 4] = (60000).to_bytes(2, "big") * 2
    else:
        whole[18:26] = (30000).to_bytes(4, "little") * 2
    (tmp_path / name).write_bytes(whole)
    error = failure(tmp_path / name)
    assert isinstance(error, isoatlas.InputError) and ("30000" in str(error) or "60000" in str(error))
