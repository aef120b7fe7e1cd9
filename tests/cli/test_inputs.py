"""Files of strangers: names and texts that are not UTF-8, damaged streams, bytes behind the samples, headers that point elsewhere."""
import gzip
import json
import os
import struct
import xml.dom.minidom

from harness import CliTest, main
from served import Viewer

NAME = os.fsdecode(b"Sch\xe4del\x07.nrrd")   # Latin-1, and a bell
SHOWN = "Sch\\xe4del\\x07.nrrd"
WRITTEN = "Sch\\xe4del\x07.nrrd"             # JSON has its own escape for control characters


def nrrd(payload, encoding="raw", more=b"", type="ushort", sizes="6 5 4"):
    head = f"NRRD0004\ntype: {type}\ndimension: 3\nsizes: {sizes}\nendian: little\nencoding: {encoding}\n".encode()
    return head + more + b"\n" + payload


class Inputs(CliTest):
    phantoms = {"v.nrrd": ["nested-shells", "--size", "32", "--shells", "2"]}

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.samples = struct.pack("<120H", *((i * 7919) % 251 for i in range(120)))
        texts = b'space: left-posterior-superior\nspace directions: (1,0,0) (0,1,0) (0,0,2)\nspace origin: (0,0,0)\n'
        texts += b'space units: "\xb5m" "\xb5m" "\xb5m"\ncontent: Sch\xe4del \x1b[31m red\nsample units: \xb0C\n'
        (cls.folder / NAME).write_bytes(nrrd(cls.samples, more=texts))
        cls.write("plain.nrrd", nrrd(cls.samples))

    @classmethod
    def write(cls, name, content):
        path = cls.folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(content)
        return name

    def tearDown(self):
        self.assert_no_partial()

    # Text that is not UTF-8

    def test_info_understands_latin_1(self):
        info = self.run_json("info", NAME)
        self.assertEqual(info["volume"]["path"], WRITTEN)
        self.assertEqual(info["volume"]["unit"], "\u00b5m")
        self.assertEqual(info["volume"]["value_unit"], "\u00b0C")
        self.assertEqual(info["description"], "Sch\u00e4del \\x1b[31m red")
        text = self.run_ok("info", NAME).stdout
        self.assertIn(SHOWN, text)
        self.assertIn("Sch\u00e4del \\x1b[31m red", text)
        self.assertNotIn("\x1b", text)

    def test_every_verb_reads_and_writes_utf_8(self):
        """The harness decodes what is printed: anything but UTF-8 would raise."""
        stem = os.fsdecode(b"\xe4us")
        outputs = {"extract": ([".ply", ".stl", ".obj", ".vtp", ".glb", ".vtkhdf"], ["--best"]), "label": ([".nrrd", ".nii", ".tif"], ["--zones"]),
                   "tree": ([".json", ".graphml", ".csv", ".vtu"], []), "convert": ([".nrrd", ".npy", ".raw", ".mha", ".nii", ".vti", ".tif"], []),
                   "spectrum": ([".svg", ".csv", ".json"], []), "render": ([".png"], ["--tau", "100", "--size", "32x32", "--samples", "1"])}
        for verb in ("objects", "handles", "spectrum", "tree", "verify"):
            self.run_ok(verb, NAME)
            self.run_json(verb, NAME)
        for verb, (extensions, options) in outputs.items():
            for extension in extensions:
                with self.subTest(verb=verb, extension=extension):
                    printed = self.run_ok(verb, NAME, *options, "-o", stem + extension).stdout
                    self.assertIn("" if verb == "spectrum" else "\\xe4us" + extension, printed)
                    self.assertEqual(self.run_json(verb, NAME, *options, "-o", stem + extension).get("output", "\\xe4us" + extension),
                                     "\\xe4us" + extension)
        for extension in (".ply", ".obj", ".vtp", ".nrrd", ".nii", ".glb", ".stl"):
            read_back = self.start(["verify" if extension in (".ply", ".obj", ".vtp", ".glb", ".stl") else "info", stem + extension])
            self.assertEqual(read_back.returncode, 0, read_back.stderr)
        for extension in (".json", ".graphml", ".csv", ".svg", ".obj"):
            (self.folder / (stem + extension)).read_bytes().decode("utf-8")
        for extension in (".graphml", ".svg"):
            xml.dom.minidom.parseString((self.folder / (stem + extension)).read_bytes())
        self.assertIn("comment unit \u00b5m\n".encode(), (self.folder / (stem + ".ply")).read_bytes())
        self.assertEqual(self.run_json("info", stem + ".nrrd")["volume"]["unit"], "\u00b5m")

    def test_stores_and_pages(self):
        built = self.run_json("build", NAME, "-o", "s.atlas")
        self.assertEqual(built["output"], "s.atlas")
        info = self.run_json("info", "s.atlas")
        self.assertEqual((info["volume"]["unit"], info["volume"]["value_unit"]), ("\u00b5m", "\u00b0C"))
        self.assertEqual(info["description"], "Sch\u00e4del \\x1b[31m red")
        page = self.run_json("atlas", NAME)
        self.assertEqual(page["output"], "Sch\\xe4del\x07.atlas.html")
        text = (self.folder / os.fsdecode(b"Sch\xe4del\x07.atlas.html")).read_bytes().decode("utf-8")
        self.assertIn("Sch\\\\xe4del", text)
        self.run_ok("objects", os.fsdecode(b"Sch\xe4del\x07.atlas"))

    def test_viewer(self):
        stem = os.fsdecode(b"\xe4view.nrrd")
        self.write(stem, (self.folder / NAME).read_bytes())
        viewer = Viewer(self.folder, stem)
        try:
            self.assertEqual(viewer.document["store"], "\\xe4view.atlas")
            viewer.until("open")
            status, _, body = viewer.ask("/api/atlas")
            self.assertEqual(status, 200)
            volume = json.loads(body.decode("utf-8"))["volume"]
            self.assertEqual((volume["name"], volume["unit"], volume["valueUnit"]), ("\\xe4view", "\u00b5m", "\u00b0C"))
        finally:
            viewer.stop()

    def test_names_in_errors_and_hints(self):
        error = self.run_json("info", os.fsdecode(b"missing\xff\n.nrrd"), code=3)["error"]
        self.assertEqual(error["file"], "missing\\xff\n.nrrd")
        self.assertEqual(error["message"].split(":")[0], "missing\\xff\\x0a.nrrd")
        hint = self.run_ok("info", NAME).stderr
        self.assertIn("$'Sch\\344del\\007.nrrd'", hint)

    def test_texts_of_other_formats(self):
        header = bytearray(352)
        struct.pack_into("<i", header, 0, 348)
        struct.pack_into("<8h", header, 40, 3, 6, 5, 4, 1, 1, 1, 1)
        struct.pack_into("<hh", header, 70, 512, 16)
        struct.pack_into("<8f", header, 76, 1, 1, 1, 1, 1, 1, 1, 1)
        struct.pack_into("<f", header, 108, 352)
        header[148:156] = b"Sch\xe4del\x9b"
        header[344:348] = b"n+1\0"
        files = {"t.nii": bytes(header) + self.samples,
                 "t.mha": b"NDims = 3\nDimSize = 6 5 4\nElementType = MET_USHORT\nElementByteOrderMSB = False\nComment = Sch\xe4del\x9b\n"
                          b"ElementDataFile = LOCAL\n" + self.samples,
                 "t.raw": self.samples}
        self.write("t.raw.json", b'{"dims": [6, 5, 4], "type": "uint16", "unit": "\xb5m"}')
        for name, content in files.items():
            info = self.run_json("info", self.write(name, content))
            self.assertEqual(info["description"], "" if name == "t.raw" else "Sch\u00e4del\u203a")
            self.run_ok("build", name, "-o", name + ".atlas")
        self.assertEqual(self.run_json("info", "t.raw")["volume"]["unit"], "\u00b5m")

    # Damaged streams and what follows the samples

    def test_damaged_streams(self):
        packed = gzip.compress(self.samples, mtime=0)
        for at in (len(packed) // 2, len(packed) - 6, len(packed) - 2):
            damaged = bytearray(packed)
            damaged[at] ^= 1
            name = self.write("damaged.nrrd", nrrd(bytes(damaged), "gzip"))
            for options in ([], ["--skip-rest"]):
                self.run_error(3, "objects", name, *options, says="compressed data")
        self.run_error(3, "objects", self.write("cut.nrrd", nrrd(packed[:-1], "gzip")), says="ends early")

    def test_skip_rest(self):
        for encoding, payload in (("raw", self.samples + b"x"), ("gzip", gzip.compress(self.samples + b"x")),
                                  ("gzip", gzip.compress(self.samples) + b"x")):
            name = self.write("longer.nrrd", nrrd(payload, encoding))
            self.run_error(3, "objects", name, says="1 byte follows", next_says="--skip-rest")
            info = self.run_json("info", name, "--skip-rest")
            self.assertEqual(info["volume"]["notes"], ["1 byte after the samples was ignored (longer.nrrd)"])
            self.run_ok("build", name, "--skip-rest", "-o", "longer.atlas")
            self.assertIn("--skip-rest", self.run_ok("info", name, "--skip-rest").stderr)   # the next command needs it as well
        self.write("longer.raw", self.samples + b"x")
        options = ["--dims", "6x5x4", "--type", "uint16"]
        self.run_error(3, "info", "longer.raw", *options, next_says="--skip-rest")
        self.run_ok("info", "longer.raw", *options, "--skip-rest")

    def test_text_cut_in_its_last_number(self):
        head = b"NRRD0001\ntype: int\ndimension: 2\nsizes: 2 2\nencoding: ascii\n\n"
        self.run_ok("info", self.write("text.nrrd", head + b"1 2 3 41\n"))
        self.run_error(3, "info", self.write("text.nrrd", head + b"1 2 3 4"), says="longer number", next_says="line end")

    def test_sidecar_without_distances(self):
        self.write("zero.raw", self.samples)
        for spacing in ("[0, 1, 1]", "[1, 1, 0.0]", "[-0.0, 1]"):
            self.write("zero.raw.json", f'{{"dims": [6, 5, 4], "type": "uint16", "spacing": {spacing}}}'.encode())
            self.run_error(3, "info", "zero.raw", says="spacing")

    # Headers that point elsewhere

    def test_follow_links(self):
        self.write("secret", self.samples)
        (self.folder / "volumes").mkdir(exist_ok=True)
        link = self.folder / "volumes" / "link.raw"
        if not link.is_symlink():
            link.symlink_to("../secret")
        for target in ("../secret", str(self.folder / "secret"), "link.raw"):
            self.write("volumes/v.nhdr", nrrd(b"", more=f"data file: {target}\n".encode()))
            self.write("volumes/v.mhd", b"NDims = 3\nDimSize = 6 5 4\nElementType = MET_USHORT\nElementByteOrderMSB = False\nElementDataFile = "
                       + target.encode() + b"\n")
            for name in ("volumes/v.nhdr", "volumes/v.mhd"):
                self.run_error(3, "objects", name, says="outside its folder", next_says="--follow-links")
                self.run_error(3, "build", name, "-o", "never.atlas", says="outside its folder")
                self.assertFalse((self.folder / "never.atlas").exists())
                self.run_ok("objects", name, "--follow-links")
        self.run_error(3, "info", self.write("volumes/v.nhdr", nrrd(b"", more=b"data file: /etc/passwd\n")), says="outside its folder")

    def test_stores_take_neither_option(self):
        self.run_ok("build", "plain.nrrd", "-o", "plain.atlas")
        for option in ("--skip-rest", "--follow-links"):
            self.run_error(2, "objects", "plain.atlas", option, says="contradicts the store")


main()
