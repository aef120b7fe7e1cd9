"""Every kind of failure: exit code, one clear message with a next step, nothing half-written."""
import json
import os
import struct
import unittest

from harness import CliTest, main


class Errors(CliTest):
    phantoms = {"v.nrrd": ["nested-shells", "--size", "32", "--shells", "2"]}

    def tearDown(self):
        self.assert_no_partial()

    # 2: usage

    def test_bad_flags(self):
        self.run_error(2, "info")
        self.run_error(2, "info", "v.nrrd", "--nonsense")
        self.run_error(2, "info", "v.nrrd", "more.nrrd")
        self.run_error(2, "objects", "v.nrrd", "--tau", "abc")
        self.run_error(2, "objects", "v.nrrd", "--tau", "nan", says="finite")
        self.run_error(2, "objects", "v.nrrd", "--top", "0")
        self.run_error(2, "tree", "v.nrrd", "--detail", "evnets", next_says="events")
        self.run_error(2, "extract", "v.nrrd", "--tau", "0.5", "--shell", "iner", "-o", "x.ply", next_says="inner")
        self.run_error(2, "extract", "v.nrrd", "--tau", "0.5", "--boundary", "ajar", "-o", "x.ply", says="ajar")
        self.run_error(2, "info", "v.nrrd", "--interpolant", "faces")
        self.run_error(2, "objects", "v.nrrd", "--interpolant", "linear", says="linear")
        self.run_error(2, "objects", "v.nrrd", "--interpolant", "faces", "--tunnel-height", "1", next_says="trilinear")
        for height in ("-1", "nan", "101%", "high"):
            self.run_error(2, "objects", "v.nrrd", "--interpolant", "trilinear", "--tunnel-height=" + height, says=height)
        self.run_error(2, "objects", "v.nrrd", "--missing", "above", says="above")
        self.run_error(2, "objects", "v.nrrd", "--threads", "-1")
        for option, value in (("--dims", "4xx4"), ("--dims", "0x4x4"), ("--dims", "4x4x4x4"), ("--spacing", "1,-1,1"), ("--origin", "a"),
                              ("--type", "complex"), ("--endian", "middle")):
            self.run_error(2, "info", "v.nrrd", option, value, says=option)

    def test_contradictions(self):
        self.run_error(2, "extract", "v.nrrd", "-o", "x.ply", says="which isovalue", next_says="isoatlas objects v.nrrd")
        self.run_error(2, "extract", "v.nrrd", "--tau", "0.5", "--best", "-o", "x.ply", says="contradict")
        self.run_error(2, "label", "v.nrrd", "-o", "x.nrrd", says="nothing to label")
        self.run_error(2, "label", "v.nrrd", "--zones", "--tau", "0.5", "-o", "x.nrrd", says="contradict")
        self.run_error(2, "phantom", "gyroid", next_says="-o")
        self.run_error(2, "phantom", next_says="--list")
        self.run_error(2, "phantom", "gyroid", "--quantise", "1", "-o", "x.nrrd")

    def test_output_names(self):
        self.run_error(2, "extract", "v.nrrd", "--tau", "0.5", says="output")
        self.run_error(2, "extract", "v.nrrd", "--tau", "0.5", "-o", "x.pyl", says=".pyl", next_says=".ply")
        self.run_error(2, "extract", "v.nrrd", "--tau", "0.5", "-o", "surface", says="extension")
        self.run_error(2, "tree", "v.nrrd", "-o", "tree.xml", says=".xml")
        self.run_error(2, "label", "v.nrrd", "--zones", "-o", "z.ply", says=".ply")
        self.run_error(2, "phantom", "gyroid", "-o", "x.jpeg", says=".jpeg")
        (self.folder / "folder.ply").mkdir(exist_ok=True)
        self.run_error(2, "extract", "v.nrrd", "--tau", "0.5", "-o", "folder.ply", says="folder")

    def test_the_input_is_never_overwritten(self):
        before = (self.folder / "v.nrrd").read_bytes()
        self.run_error(2, "label", "v.nrrd", "--tau", "0.5", "-o", "v.nrrd", says="overwrite the input")
        if not (self.folder / "link.nrrd").exists():
            (self.folder / "link.nrrd").symlink_to("v.nrrd")
        self.run_error(2, "label", "v.nrrd", "--tau", "0.5", "-o", "link.nrrd", says="overwrite the input")
        self.assertEqual((self.folder / "v.nrrd").read_bytes(), before)

    # the library gives a reason, the command line the option

    def test_reasons_become_options(self):
        (self.folder / "c.raw").write_bytes(bytes(1000))
        def reason_of(code, *arguments, next_says):
            error = self.run_error(code, *arguments, next_says=next_says)
            return error["reason"], error["value"]
        raw = ["info", "c.raw", "--dims"]
        self.assertEqual(reason_of(2, "info", "c.raw", next_says="give --dims NXxNYxNZ --type TYPE, or write them into c.raw.json"),
                         ("raw_layout_unknown", "c.raw.json"))
        self.assertEqual(reason_of(3, *raw, "10x10x5", "--type", "uint8", next_says="the size fits these dims with --type uint16 or int16"),
                         ("raw_type_differs", "uint16 or int16"))
        self.assertEqual(reason_of(3, *raw, "11x11x11", "--type", "uint8", next_says="the size fits --dims 10x10x10 with this type"),
                         ("raw_sizes_differ", "10x10x10"))
        self.assertEqual(reason_of(3, *raw, "3x3x3", "--type", "uint8",
                                   next_says="add --skip 973; if something follows the samples, pass --skip-rest"), ("raw_has_more", "973"))
        self.assertEqual(reason_of(3, *raw, "7x7x77", "--type", "float32", next_says="check --dims, --type and --skip"), ("raw_size_differs", ""))
        self.assertEqual(reason_of(2, "info", "v.nrrd", "--skip", "4", next_says="leave --skip out; it is for RAW files"),
                         ("contradicts_header", "skip_bytes"))
        error = self.run_error(2, "info", "v.nrrd", "--endian", "big", "--type", "int8", says="--type contradicts the header of the file")
        self.assertEqual((error["reason"], error["value"]), ("contradicts_header", "type"))
        self.assertEqual(reason_of(2, "info", "v.nrrd", "--time-step", "1", next_says="omit --time-step"), ("no_time_steps", "0"))
        (self.folder / "v.nrdr").write_bytes(b"?")
        self.assertEqual(reason_of(4, "info", "v.nrdr", next_says="convert the file, or give --dims and --type if it is RAW")[0], "unknown_format")
        (self.folder / "v.nrd").write_bytes(b"?")
        self.assertEqual(reason_of(4, "info", "v.nrd", next_says="did you mean .nrrd? convert"), ("unknown_format", ".nrrd"))
        (self.folder / "v.img").write_bytes(b"?")
        self.assertEqual(reason_of(4, "info", "v.img", next_says="give it as RAW with --dims and --type"), ("analyze_pair", ""))
        self.run_ok("build", "v.nrrd", "-o", "v.atlas")
        self.assertEqual(reason_of(6, "dump", "v.atlas", "nothing", next_says="isoatlas dump v.atlas lists the parts"), ("no_such_part", ""))
        self.assertEqual(self.run_error(2, "objects", "v.nrrd", "--tau", "abc")["reason"], "none")

    # 3: input

    def test_missing_files(self):
        for verb in ("info", "objects", "tree", "verify"):
            self.assertEqual(self.run_error(3, verb, "none.nrrd")["file"], "none.nrrd")
        self.run_error(3, "extract", "none.nrrd", "--tau", "1", "-o", "x.ply")
        self.run_error(3, "label", "none.nrrd", "--zones", "-o", "x.nrrd")
        self.run_error(3, "verify", "none.ply")

    def test_truncated_files(self):
        whole = (self.folder / "v.nrrd").read_bytes()
        (self.folder / "cut.nrrd").write_bytes(whole[:-100])
        (self.folder / "stump.nrrd").write_bytes(whole[:20])
        (self.folder / "empty.nrrd").write_bytes(b"")
        for name in ("cut.nrrd", "stump.nrrd", "empty.nrrd"):
            self.run_error(3, "objects", name, says=name)
        self.run_ok("extract", "v.nrrd", "--tau", "0.5", "-o", "whole.ply")
        (self.folder / "cut.ply").write_bytes((self.folder / "whole.ply").read_bytes()[:-100])
        self.run_error(3, "verify", "cut.ply", says="cut.ply")

    def test_wrong_dims(self):
        (self.folder / "a.raw").write_bytes(bytes(64))
        self.run_error(3, "info", "a.raw", "--dims", "5x5x5", "--type", "uint8", says="a.raw")
        self.assertEqual(self.run_json("info", "a.raw", "--dims", "4", "--type", "uint8")["voxels"], 64)
        (self.folder / "b.raw").write_bytes(struct.pack(">64h", *range(64)))
        for dims in (["4x4x4"], ["4", "4", "4"], ["4,4,4"]):
            info = self.run_json("info", "--dims", *dims, "b.raw", "--type", "int16", "--endian", "big", "--spacing", "2", "2", "3")
            self.assertEqual((info["values"]["high"], info["volume"]["spacing"]), (63, [2, 2, 3]))

    # 4: unsupported

    def test_unknown_formats(self):
        (self.folder / "notes.docx").write_bytes(b"\xd0\xcf\x11\xe0" + bytes(range(256)))
        self.run_error(4, "info", "notes.docx", says="notes.docx")
        (self.folder / "complex.npy").write_bytes(
            b"\x93NUMPY\x01\x00v\x00" + b"{'descr': '<c8', 'fortran_order': False, 'shape': (2, 2, 2), }".ljust(117) + b"\n" + bytes(64))
        self.run_error(4, "info", "complex.npy", says="complex.npy")

    # 5: resource

    def test_unwritable_places(self):
        commands = [["extract", "v.nrrd", "--tau", "0.5", "-o", "{}.ply"], ["tree", "v.nrrd", "-o", "{}.json"],
                    ["label", "v.nrrd", "--zones", "-o", "{}.nrrd"], ["phantom", "gyroid", "--size", "8", "-o", "{}.nrrd"]]
        for command in commands:
            self.run_error(5, *(word.format("no/such/folder/x") for word in command), says="folder", next_says="mkdir -p")
            self.run_error(5, *(word.format("/proc/x") for word in command), says="/proc/x")

    @unittest.skipIf(os.geteuid() == 0, "root may write everywhere")
    def test_read_only_folder(self):
        (self.folder / "locked").mkdir(mode=0o555, exist_ok=True)
        self.run_error(5, "extract", "v.nrrd", "--tau", "0.5", "-o", "locked/x.ply")

    def test_an_old_output_survives_a_failure(self):
        (self.folder / "old.ply").write_text("old")
        self.run_error(6, "extract", "v.nrrd", "--tau", "0.5", "--object", "v0", "-o", "old.ply")
        self.assertEqual((self.folder / "old.ply").read_text(), "old")
        self.run_ok("extract", "v.nrrd", "--tau", "0.5", "-o", "old.ply")
        self.assertNotEqual((self.folder / "old.ply").read_bytes(), b"old")

    # 6: not found

    def test_isovalues_outside_the_range(self):
        for verb in (["objects"], ["extract", "-o", "x.ply"], ["label", "-o", "x.nrrd"]):
            error = self.run_error(6, verb[0], "v.nrrd", *verb[1:], "--tau", "1e9", says="above every sample", next_says="isoatlas objects v.nrrd")
            self.assertIn("..", error["expected"])
            self.run_error(6, verb[0], "v.nrrd", *verb[1:], "--tau", "-1e9", says="below every sample")

    def test_no_such_object_or_contour(self):
        self.run_error(6, "extract", "v.nrrd", "--tau", "0.5", "--object", "v0", "-o", "x.ply")
        self.run_error(6, "extract", "v.nrrd", "--tau", "0.5", "--object", "v123456789", "-o", "x.ply")
        self.run_error(6, "extract", "v.nrrd", "--tau", "0.5", "--contour", "v1", "-o", "x.ply")
        self.run_error(6, "extract", "v.nrrd", "--object", "v1", "-o", "x.ply", next_says="isoatlas objects")
        self.run_ok("phantom", "checkerboard", "--size", "4", "-o", "board.nrrd")
        self.run_error(6, "extract", "board.nrrd", "--tau", "1", "--shell", "inner", "-o", "x.ply", says="nothing was written")
        self.assertFalse((self.folder / "x.ply").exists())


if __name__ == "__main__":
    main()
