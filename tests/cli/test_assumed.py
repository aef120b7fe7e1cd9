"""What is assumed about the samples, and what the user says instead of the header: fill values, labels, noise, geometry, units."""
import json
import struct
import subprocess

import harness
from harness import CliTest, main

MICRO = "\u00b5m"


def npy(samples, type, shape):
    kinds = {"<f4": "f", "<i2": "h", "|u1": "B", "<u2": "H"}
    head = f"{{'descr': '{type}', 'fortran_order': False, 'shape': {shape}, }}".encode()
    head += b" " * (-(10 + len(head) + 1) % 64) + b"\n"
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(head)) + head + struct.pack(f"<{len(samples)}{kinds[type]}", *samples)


def noise(seed):
    """Numbers from 0 to 1."""
    state = seed
    while True:
        state = (state * 6364136223846793005 + 1442695040888963407) % 2 ** 64
        yield (state >> 33) / 2 ** 31


class Assumed(CliTest):
    N = 24

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        n = cls.N
        voxels = [(x, y, z) for z in range(n) for y in range(n) for x in range(n)]
        near = lambda p, q, r: sum((a - b) ** 2 for a, b in zip(p, q)) < r * r
        random = noise(1)
        cls.values = [10 + 90 * near(p, (7, 7, 7), 5) + 60 * near(p, (16, 16, 14), 5) + 0.5 * next(random) for p in voxels]
        cls.write("plain.npy", npy(cls.values, "<f4", (n, n, n)))
        cls.write("land.npy", npy([1e20 if x < 6 else v for (x, _, _), v in zip(voxels, cls.values)], "<f4", (n, n, n)))
        cls.write("padded.npy", npy([-2000 if x < 6 else round(v) - 20 + (x + y + z) % 12 for (x, y, z), v in zip(voxels, cls.values)], "<i2", (n, n, n)))
        names = [7 if near(p, (7, 7, 7), 5) else 9 if near(p, (16, 16, 14), 6) else 3 if near(p, (16, 6, 18), 4) else 0 for p in voxels]
        cls.labels = names
        cls.write("labels.npy", npy(names, "|u1", (n, n, n)))
        boxes = [1 + x // 6 + 4 * (z // 12) if x % 6 in (1, 2, 3, 4) and 2 < y < 20 and z % 12 in range(2, 10) else 0 for (x, y, z) in voxels]
        cls.write("boxes.npy", npy(boxes, "|u1", (n, n, n)))
        random = noise(2)
        noisy = [round(v + 40 * (sum(next(random) for _ in range(6)) - 3)) + 1000 for v in cls.values]
        cls.write("noisy.npy", npy(noisy, "<u2", (n, n, n)))

    @classmethod
    def write(cls, name, content):
        (cls.folder / name).write_bytes(content)

    # Geometry and units

    GEOMETRY = ["--spacing", "0.5,0.5,2", "--origin", "1,2,3", "--unit", "um", "--value-unit", "HU"]

    def test_geometry_and_units_are_those_that_the_user_gives(self):
        info = self.run_json("info", "plain.npy", *self.GEOMETRY)
        volume = info["volume"]
        self.assertEqual((volume["spacing"], volume["origin"], volume["unit"], volume["value_unit"]), ([0.5, 0.5, 2], [1, 2, 3], MICRO, "HU"))
        self.assertIn("spacing 0.5 x 0.5 x 2 as given, instead of 1 x 1 x 1", volume["notes"])
        self.assertEqual(info["units"], {"length": MICRO, "measure": MICRO + "³", "value": "HU"})
        plain, given = self.run_json("objects", "plain.npy"), self.run_json("objects", "plain.npy", *self.GEOMETRY)
        self.assertEqual([o["measure"] for o in given["objects"]], [0.5 * o["measure"] for o in plain["objects"]])
        text = self.run_ok("objects", "plain.npy", *self.GEOMETRY)
        self.assertIn(f"volume [{MICRO}³]", text.stdout)
        self.assertIn("best tau [HU]", text.stdout)
        self.assertIn("--spacing 0.5,0.5,2 --origin 1,2,3 --unit um --value-unit HU", text.stderr)
        self.run_ok("extract", "plain.npy", *self.GEOMETRY, "--tau", "50", "-o", "given.ply")
        self.assertIn(f"comment unit {MICRO}\n".encode(), (self.folder / "given.ply").read_bytes())
        for name in ("given.nrrd", "given.mha", "given.raw"):
            self.run_ok("convert", "plain.npy", *self.GEOMETRY, "-o", name)
            back = self.run_json("info", name)["volume"]
            self.assertEqual((back["spacing"], back["unit"]), ([0.5, 0.5, 2], MICRO), name)

    def test_no_unit_is_said_in_one_way(self):
        text = self.run_ok("objects", "plain.npy", "--spacing", "2")
        self.assertIn("volume [units³]", text.stdout)
        self.assertEqual(self.run_json("objects", "plain.npy", "--spacing", "2")["units"]["measure"], "units³")
        self.assertEqual(self.run_json("objects", "plain.npy")["units"]["measure"], "voxels")

    def test_stores_are_corrected_too(self):
        self.run_ok("build", "plain.npy", "-o", "plain.atlas")
        self.run_ok("build", "plain.npy", *self.GEOMETRY, "-o", "given.atlas")
        one, other = (self.run_json("objects", *source) for source in (["plain.atlas", *self.GEOMETRY], ["given.atlas"]))
        self.assertEqual(one["objects"], other["objects"])
        self.assertEqual(one["units"], other["units"])
        self.run_ok("extract", "plain.atlas", *self.GEOMETRY, "--tau", "50", "-o", "one.ply")
        self.run_ok("extract", "given.atlas", "--tau", "50", "-o", "other.ply")
        self.assertEqual((self.folder / "one.ply").read_bytes(), (self.folder / "other.ply").read_bytes())
        self.assertEqual(self.run_json("info", "plain.atlas", "--unit", "nm")["volume"]["unit"], "nm")
        self.run_ok("build", "plain.npy", "--gaussian", "1", "-o", "filtered.atlas")
        self.run_error(2, "objects", "filtered.atlas", "--spacing", "2", says="filtered")

    def test_geometry_is_part_of_the_fingerprint(self):
        self.run_ok("plain.npy", "-o", "page.html", "--top", "1")
        told = self.run_ok("plain.npy", "-o", "page.html", "--top", "1", *self.GEOMETRY).stderr
        self.assertIn("spacing 1 x 1 x 1 there, 0.5 x 0.5 x 2 here", told)
        self.assertIn("exists and is used", self.run_ok("plain.npy", "-o", "page.html", "--top", "1", *self.GEOMETRY).stderr)
        data = self.page("page.html")
        self.assertEqual((data["volume"]["unit"], data["volume"]["valueUnit"]), (MICRO, "HU"))
        self.assertTrue(any("spacing 0.5 x 0.5 x 2 as given" in note for note in data["notes"]))

    def page(self, name):
        text = (self.folder / name).read_text()
        data = json.loads(text.split('id="atlas-data" type="application/json">')[1].split("</script>")[0])
        self.assert_schema(data, "page")
        return data

    def test_units_are_text(self):
        for option in ("--unit", "--value-unit"):
            self.run_error(2, "info", "plain.npy", option, "a\nb", says="cannot be")
            self.run_error(2, "info", "plain.npy", option, "", says="empty value")

    # Fill values

    def test_fill_values_are_found_said_and_undone(self):
        found = self.run_json("objects", "land.npy")
        self.assertLess(max(o["appears"] for o in found["objects"]), 102)
        self.assertTrue(any("1e+20 looks like a fill value (25 %" in note and "--no-data none" in note for note in found["volume"]["notes"]))
        undone = self.run_json("objects", "land.npy", "--no-data", "none")
        self.assertGreater(max(o["best_tau"] for o in undone["objects"]), 1e18)
        self.assertFalse(any("fill value" in note for note in undone["volume"]["notes"]))
        said = self.run_json("objects", "land.npy", "--no-data", "1e20")
        self.assertEqual(said["objects"], found["objects"])
        self.assertIn("--no-data 1e+20", self.run_ok("objects", "land.npy").stderr.split("next:")[1])
        low = self.run_json("objects", "padded.npy")
        self.assertTrue(any("-2000 looks like a fill value" in note for note in low["volume"]["notes"]))
        info = self.run_json("info", "land.npy")
        self.assertEqual(info["survey"]["fill_value"]["samples"], 6 * self.N ** 2)
        self.assert_schema(info, "info")
        self.assertIn("fill value", self.run_ok("info", "land.npy").stdout)
        self.assertIsNone(self.run_json("info", "plain.npy")["survey"]["fill_value"])

    def test_every_verb_assumes_the_same(self):
        self.run_ok("build", "land.npy", "-o", "land.atlas")
        self.assertEqual(self.run_json("objects", "land.atlas")["objects"], self.run_json("objects", "land.npy")["objects"])
        self.run_ok("land.npy", "-o", "land.html", "--top", "1")   # the store that was built is the one that the page wants
        data = self.page("land.html")
        self.assertTrue(any("--no-data none" in note for note in data["notes"]))
        first = self.run_json("objects", "land.npy")["objects"][0]
        self.run_ok("extract", "land.npy", "--tau", str(first["best_tau"]), "-o", "land.ply")
        self.run_ok("convert", "land.npy", "-o", "same.npy")       # takes samples as they are
        self.assertEqual((self.folder / "same.npy").read_bytes()[-4 * self.N ** 3:], (self.folder / "land.npy").read_bytes()[-4 * self.N ** 3:])

    # Labels

    def test_labels_are_objects(self):
        table = self.run_json("objects", "labels.npy")
        self.assertEqual(table["schema"], "isoatlas/labels/1")
        self.assert_schema(table, "labels")
        self.assertEqual([(o["label"], o["voxels"]) for o in table["labels"]], [(k, self.labels.count(k)) for k in (3, 7, 9)])
        self.assertEqual(table["background"], self.labels.count(0))
        self.assertEqual([(o["components"], o["tunnels"], o["cavities"]) for o in table["labels"]], [(1, 0, 0)] * 3)
        self.assertIn("--labels no", self.run_ok("objects", "labels.npy").stderr)
        self.assertEqual(self.run_json("objects", "labels.npy", "--labels", "no")["schema"], "isoatlas/objects/2")
        self.assertEqual(self.run_json("objects", "plain.npy")["schema"], "isoatlas/objects/2")
        for name in ("label.ply", "label.glb"):
            document = self.run_json("extract", "labels.npy", "--object", "7", "-o", name)
            self.assert_schema(document, "extract-labels")
            self.assertEqual(document["labels"], [7])
            self.run_ok("verify", name)
        self.assertEqual(self.run_json("extract", "labels.npy", "-o", "all.ply")["labels"], [3, 7, 9])
        self.run_error(6, "extract", "labels.npy", "--object", "8", "-o", "none.ply", says="label 8")
        self.run_error(3, "objects", "plain.npy", "--labels", "yes", says="is not a label")
        self.assertIn("look like labels", self.run_ok("tree", "labels.npy").stderr)
        self.assertTrue(self.run_json("info", "labels.npy")["survey"]["labels"])

    def label_page(self, name):
        text = (self.folder / name).read_text()
        data = json.loads(text.split('id="atlas-data" type="application/json">')[1].split("</script>")[0])
        self.assert_schema(data, "label-page")
        return data

    def test_the_page_of_labels_is_written_with_its_first_pictures_first(self):
        process = subprocess.Popen([harness.CLI, "boxes.npy", "--labels", "yes", "-o", "first.html"], cwd=self.folder, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        while "has its first 5 pictures" not in (line := process.stderr.readline()):
            self.assertNotEqual(line, "", "it ended without a first page")
        early = self.label_page("first.html")
        self.assertTrue(early["complete"] or sum(label["picture"] is not None for label in early["labels"]) >= 5)
        process.communicate(timeout=600)
        self.assertEqual(process.returncode, 0)
        page = self.label_page("first.html")
        self.assertTrue(page["complete"])
        self.assertEqual(len(page["labels"]), 8)
        self.assertTrue(all(label["picture"] and label["mesh"]["keepsTopology"] for label in page["labels"]))

    def test_labels_have_a_page(self):
        document = self.run_json("labels.npy", "-o", "labels.html")
        self.assert_schema(document, "atlas")
        self.assertEqual((document["shown"], document["hidden"], document["store"]), (3, 0, None))
        page, table = self.label_page("labels.html"), self.run_json("objects", "labels.npy")
        self.assertFalse((self.folder / "labels.atlas").exists())
        largest_first = sorted(table["labels"], key=lambda one: -one["voxels"])
        for shown, listed in zip(page["labels"], largest_first, strict=True):
            for member in ("label", "name", "voxels", "measure", "components", "tunnels", "cavities"):
                self.assertEqual(shown[member], listed[member])
            self.assertTrue(shown["picture"]["image"].startswith("data:image/webp;base64,"))
        self.assertTrue(any("--labels no" in note for note in page["notes"]))
        for command in page["labels"][0]["commands"]:
            words = command["line"].split()[1:]
            self.run_ok(*words, *(["--size", "48x48", "--samples", "1"] if words[0] == "render" else []))
        few = self.run_json("labels.npy", "-o", "few.html", "--top", "1")
        self.assertEqual((few["shown"], few["hidden"]), (1, 2))
        self.assertEqual([one["picture"] is None for one in self.label_page("few.html")["labels"]], [False, True, True])
        self.run_ok("labels.npy", "--labels", "no", "-o", "values.html", "--top", "1")
        self.page("values.html")

    def test_labels_are_written_and_drawn(self):
        document = self.run_json("label", "labels.npy", "--object", "9", "--object", "3", "-o", "two.seg.nrrd")
        self.assert_schema(document, "label")
        self.assertEqual([(one["label"], one["voxels"]) for one in document["segments"]], [(k, self.labels.count(k)) for k in (3, 9)])
        for segment in document["segments"]:
            self.assertEqual(self.labels[segment["id"]], segment["label"])
        again = self.run_json("objects", "two.seg.nrrd", "--labels", "yes")
        self.assertEqual([(one["label"], one["name"], one["voxels"]) for one in again["labels"]],
                         [(k, f"label {k}", self.labels.count(k)) for k in (3, 9)])
        largest = max((3, 7, 9), key=self.labels.count)
        top = self.run_json("label", "labels.npy", "--top", "1", "-o", "top.nii.gz")
        self.assertEqual([one["label"] for one in top["segments"]], [largest])
        self.assertEqual([one["name"] for one in self.run_json("objects", "top.nii.gz", "--labels", "yes")["labels"]], [f"label {largest}"])
        whole = self.run_json("label", "labels.npy", "-o", "whole.tif")
        self.assertEqual([one["label"] for one in whole["segments"]], [3, 7, 9])
        small = ["--size", "48x48", "--samples", "1"]
        drawn = self.run_json("render", "labels.npy", "--object", "7", "-o", "seven.png", *small)
        self.assertEqual([one["name"] for one in drawn["objects"]], ["label 7"])
        self.assertEqual(len(self.run_json("render", "labels.npy", "-o", "all.png", *small)["objects"]), 3)
        named = self.run_json("render", "two.seg.nrrd", "--labels", "yes", "--object", "label 9", "-o", "nine.png", *small)
        self.assertEqual([one["name"] for one in named["objects"]], ["label 9"])
        self.run_error(6, "render", "labels.npy", "--object", "8", "-o", "none.png", says="label 8")
        self.run_error(6, "label", "labels.npy", "--object", "8", "-o", "none.nrrd", says="label 8")
        self.run_error(2, "label", "labels.npy", "--object", "liver", "-o", "none.nrrd", says="is not a label")
        self.assertIn("isovalues between them mean nothing", self.run_ok("render", "labels.npy", "--tau", "4", "-o", "tau.png", *small).stderr)
        self.assertIn("isovalues between them mean nothing", self.run_ok("label", "labels.npy", "--tau", "4", "-o", "tau.nrrd").stderr)
        self.run_error(2, "view", "labels.npy", "--no-browser", says="makes a page with a card for each label")

    def test_labels_are_measured(self):
        document, table = self.run_json("measure", "labels.npy", "--thickness"), self.run_json("objects", "labels.npy")["labels"]
        self.assert_schema(document, "measure")
        self.assertEqual(document["objects_are"], "labels")
        self.assertEqual([(o["id"], o["tau"], o["voxels"], o["tunnels"], o["cavities"]) for o in document["objects"]],
                         [(o["label"], o["label"], o["voxels"], o["tunnels"], o["cavities"]) for o in table])
        for own, other in zip(document["objects"], table):
            self.assertAlmostEqual(own["voxel_volume"], other["measure"])
        self.assertIsNone(document["percolation"])
        text = self.run_ok("measure", "labels.npy").stdout
        self.assertRegex(text, "^label +volume")
        self.assertNotIn("porosity", text)
        self.run_ok("measure", "labels.npy", "-o", "labels.csv")
        self.assertEqual(len((self.folder / "labels.csv").read_text().splitlines()), 1 + len(table))
        self.assertEqual(self.run_json("measure", "labels.npy", "--tau", "5")["objects_are"], "objects")

    def test_labels_are_printed(self):
        document = self.run_json("extract", "labels.npy", "--object", "7", "--for-print", "-o", "label.stl")
        self.assert_schema(document, "extract-labels")
        self.assertEqual((document["print"]["pieces"], document["print"]["specks"]), (1, 0))
        self.assertIn("one unit is taken as 1 mm", document["notes"][0])
        done = self.run_ok("extract", "labels.npy", "--unit", "cm", "--for-print", "-o", "labels.stl")
        self.assertIn("for printing: 3 pieces", done.stdout)
        self.assertIn("in mm", done.stdout)

    def test_labels_in_pictures(self):
        def drawn(*more):
            document = self.run_json("render", "labels.npy", "--size", "32x32", "--samples", "1", "-o", "labels.png", *more)
            self.assert_schema(document, "render")
            return [o["name"] for o in document["objects"]]

        self.assertEqual(drawn(), ["label 3", "label 7", "label 9"])
        self.assertEqual(drawn("--object", "9", "3"), ["label 9", "label 3"])
        self.assertEqual(drawn("--top", "1"), [f"label {max((3, 7, 9), key=self.labels.count)}"])
        self.assertEqual(drawn("--tau", "5"), ["isovalue 5"])
        self.assertNotIn("label 3", drawn("--labels", "no"))
        self.run_error(6, "render", "labels.npy", "--object", "8", "-o", "none.png", says="label 8")

    def test_labels_of_a_store(self):
        self.run_ok("build", "labels.npy", "-o", "labels.atlas")
        self.assertEqual(self.run_json("objects", "labels.atlas", "--labels", "yes")["labels"], self.run_json("objects", "labels.npy")["labels"])

    # Noise

    def test_strong_noise_is_said_and_smoothed(self):
        self.assertIn("--gaussian auto", self.run_ok("objects", "noisy.npy").stderr)
        self.assertNotIn("--gaussian auto", self.run_ok("objects", "plain.npy").stderr)
        info = self.run_json("info", "noisy.npy")["survey"]
        self.assertGreater(info["noise_part"], 0.03)
        sigma = info["advised_gaussian"]
        found = self.run_json("objects", "noisy.npy", "--gaussian", "auto")
        self.assertEqual(found["volume"]["gaussian"], sigma)
        self.assertEqual(found["objects"], self.run_json("objects", "noisy.npy", "--gaussian", str(sigma))["objects"])
        self.assertIn(f"--gaussian {sigma:g}", self.run_ok("objects", "noisy.npy", "--gaussian", "auto").stderr)
        self.assertIsNone(self.run_json("objects", "plain.npy", "--gaussian", "auto")["volume"]["gaussian"])
        self.run_ok("noisy.npy", "-o", "noisy.html", "--top", "1")
        smoothing = self.page("noisy.html")["smoothing"]
        self.assertEqual(smoothing["sigma"], sigma)
        shown = smoothing["comparison"]
        for name, more in (("asItIs", []), ("smooth", ["--gaussian", str(sigma)])):
            at = self.run_json("objects", "noisy.npy", "--tau", str(shown["tau"]), *more)
            self.assertEqual((shown[name]["objects"], shown[name]["tunnels"]), (at["object_count"], sum(one["b1"] for one in at["objects"])))
            self.assertEqual(shown[name]["picture"]["frames"], 1)
        self.assertLess(shown["smooth"]["objects"], shown["asItIs"]["objects"])
        self.run_ok(*smoothing["command"].split()[1:], "--top", "1")
        self.assertIsNone(self.page("noisy.smooth.html")["smoothing"])
        self.run_error(2, "noisy.atlas", "--gaussian", "auto", says="contradicts the store")

    def test_every_verb_takes_gaussian(self):
        options = ["noisy.npy", "--gaussian", "1"]
        self.run_ok("build", *options, "-o", "smooth.atlas")
        for verb, suffix, more in (("extract", ".ply", ["--tau", "1060"]), ("label", ".nrrd", ["--tau", "1060"]), ("tree", ".json", []),
                                   ("spectrum", ".csv", []), ("render", ".png", ["--tau", "1060", "--size", "32x32", "--samples", "1"])):
            self.run_ok(verb, *options, *more, "-o", "one" + suffix)
            self.run_ok(verb, "smooth.atlas", *more, "-o", "other" + suffix)
            if verb not in ("tree", "spectrum"):   # these name their source
                self.assertEqual((self.folder / ("one" + suffix)).read_bytes(), (self.folder / ("other" + suffix)).read_bytes(), verb)
        self.run_ok("handles", *options)
        self.run_ok("verify", *options)
        self.assertEqual(self.run_json("objects", *options)["objects"], self.run_json("objects", "smooth.atlas")["objects"])


main()
