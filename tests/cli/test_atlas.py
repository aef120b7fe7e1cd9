"""isoatlas FILE: a page from a volume, whole, self-contained, with data as described and commands that run."""
import json
import math
import os
import re
import shlex
import struct
import subprocess

import harness

DATA = re.compile(r'<script id="atlas-data" type="application/json">(.*?)</script>', re.S)


class Atlas(harness.CliTest):
    phantoms = {"demo.nrrd": ["demo", "--size", "40"], "flat.nrrd": ["noise", "--size", "1"], "noise.nrrd": ["noise", "--size", "16"],
                "shells.nrrd": ["nested-shells"]}

    def page(self, name):
        text = (self.folder / name).read_text()
        found = DATA.findall(text)
        self.assertEqual(len(found), 1)
        page = json.loads(found[0], parse_constant=lambda word: self.fail(f"{word} is not JSON"))
        self.assert_schema(page, "page")
        return text, page

    def test_two_volumes_of_one_name_do_not_share_a_store(self):
        for folder, seed in (("first", "1"), ("second", "2")):
            (self.folder / folder).mkdir()
            self.run_ok("phantom", "noise", "--size", "9", "--seed", seed, "-o", f"{folder}/scan.nrrd", "--quiet")
        self.run_ok("first/scan.nrrd")
        self.assertIn("exists and is used", self.run_ok("first/scan.nrrd").stderr)
        self.assertNotIn("exists and is used", self.run_ok("second/scan.nrrd").stderr)
        held = self.run_json("objects", "scan.atlas", "--all")["objects"]
        self.assertEqual(held, self.run_json("objects", "second/scan.nrrd", "--all")["objects"])

    def test_a_page_from_a_volume(self):
        told = self.run_ok("demo.nrrd", "--polarity", "high")
        self.assertIn("demo.atlas.html", told.stdout)
        text, page = self.page("demo.atlas.html")
        self.assertTrue((self.folder / "demo.atlas").is_file())
        table = self.run_json("objects", "demo.atlas", "--both")
        branches, entries = page["branches"], page["entries"]
        of_side = {side: [entry for entry in entries if branches[entry["branch"]]["side"] == side] for side in ("object", "cavity")}
        self.assertGreater(len(of_side["cavity"]), 0)
        for side, expected in (("object", table["objects"]), ("cavity", table["cavities"])):
            self.assertEqual([entry["id"] for entry in of_side[side]], [entry["id"] for entry in expected])
            self.assertEqual([entry["tunnels"] for entry in of_side[side]], [entry["tunnels"] for entry in expected])
        self.assertEqual(page["found"]["objects"]["all"], table["branches"])
        self.assertEqual(page["found"]["cavities"]["all"], table["cavity_branches"])
        for entry in entries:
            self.assertTrue(entry["picture"]["image"].startswith("data:image/webp;base64,"))
        self.assertEqual(re.findall(r"""(?:src|href)=["']?(?!data:)[a-z]+:""", text), [])
        self.assertNotRegex(text, r"""@import|url\((?!data:)""")
        samples = 1
        for size in page["volume"]["size"]:
            samples *= size
        self.assertEqual(sum(page["histogram"]["counts"]), samples)

    def test_a_page_has_surfaces_and_is_written_with_its_first_pictures_first(self):
        process = subprocess.Popen([harness.CLI, "demo.nrrd", "-o", "first.html"], cwd=self.folder, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        while "has its first 5 pictures" not in (line := process.stderr.readline()):
            self.assertNotEqual(line, "", "it ended without a first page")
        _, early = self.page("first.html")
        pictures = [entry["picture"] is not None for entry in early["entries"]]
        self.assertTrue(early["complete"] or sum(pictures) >= 5)
        self.assertEqual(pictures, sorted(pictures, reverse=True), "in the order of the page")
        process.communicate(timeout=600)
        self.assertEqual(process.returncode, 0)
        text, page = self.page("first.html")
        self.assertTrue(page["complete"])
        self.assertLessEqual(len(text), 5_000_000)
        for entry in page["entries"]:
            self.assertTrue(entry["mesh"]["keepsTopology"])
            self.assertLessEqual(entry["mesh"]["triangles"], min(30_000, entry["mesh"]["of"]))

    def test_a_page_from_a_volume_is_that_from_its_store(self):
        """The first has drawn objects of high values before there were those of low ones."""
        for top in ("3", "24"):
            told = self.run_ok("demo.nrrd", "-o", "twice.html", "--top", top, "--restart").stderr
            self.assertEqual(told.count("open it now"), 1)
            first = self.page("twice.html")[0]
            self.assertIn("exists and is used", self.run_ok("demo.nrrd", "-o", "twice.html", "--top", top).stderr)
            self.assertEqual(self.page("twice.html")[0], first)
        self.assertFalse((self.folder / "twice.atlas.build").exists())

    def test_lines_that_look_the_same_share_a_card(self):
        table = self.run_json("objects", "shells.nrrd")["objects"]
        lines = [line["like"] and line["like"]["line"] for line in table]
        self.assertEqual(lines[:5], [None, 1, 1, None, 4])
        for line in table:
            if line["like"]:
                self.assertEqual(line["like"]["overlap"], line["voxels"] / table[line["like"]["line"] - 1]["voxels"])
        self.assertIn("inside 1, like 1 (95 %)", self.run_ok("objects", "shells.nrrd").stdout)
        self.run_ok("shells.nrrd", "--polarity", "high", "-o", "shells.html")
        entries = self.page("shells.html")[1]["entries"]
        self.assertEqual([(entry["number"], entry["card"]) for entry in entries[:5]], [(1, 1), (2, 1), (3, 1), (4, 4), (5, 4)])
        both = self.run_json("objects", "shells.nrrd", "--polarity", "both")["objects"]
        for line in both:
            if line["like"]:
                other = both[line["like"]["line"] - 1]
                self.assertEqual(other["polarity"], line["polarity"])
                self.assertEqual(line["like"]["overlap"], min(line["voxels"], other["voxels"]) / max(line["voxels"], other["voxels"]))

    def test_counts_of_the_page_are_those_of_the_spectrum(self):
        self.run_ok("demo.nrrd", "-o", "counts.html", "--top", "1")
        page = self.page("counts.html")[1]
        intervals = self.run_json("spectrum", "counts.atlas", "--samples", "0", "--all")["intervals"]
        for which in ("all", "significant"):
            for name in ("objects", "contours", "tunnels", "cavities"):
                count = page["spectrum"][which][name]
                for k, (low, high) in enumerate(zip(page["spectrum"]["edges"], page["spectrum"]["edges"][1:])):
                    there = [i[which][name][0] for i in intervals if i["high"] > low and (i["low"] is None or i["low"] < high)]
                    self.assertEqual(max(there), count["max"][k])
                    self.assertEqual(min(there), count.get("min", count["max"])[k])

    def test_the_curve_says_what_every_threshold_keeps(self):
        self.run_ok("demo.nrrd", "-o", "curve.html", "--top", "1")
        page = self.page("curve.html")[1]
        self.run_ok("objects", "demo.nrrd", "--curve", "curve.json")
        full = json.loads((self.folder / "curve.json").read_text())["curves"][0]
        points = [[threshold, kept] for threshold, kept in zip(page["curve"]["threshold"], page["curve"]["kept"])]
        self.assertTrue(all(point in full["points"] for point in points))
        self.assertEqual((points[0], points[-1]), (full["points"][0], full["points"][-1]))
        self.assertEqual(page["curve"]["automaticKept"], full["automatic"]["kept"])
        self.assertEqual(page["found"]["objects"]["significant"], full["automatic"]["kept"])

    def test_objects_merge_into_others_of_the_page(self):
        self.run_ok("demo.nrrd", "-o", "merge.html")
        branches = self.page("merge.html")[1]["branches"]
        for branch in branches:
            if branch["side"] == "object":
                self.assertEqual(branch["merges"] is None, branch["parent"] == -1, branch["id"])
            if branch["parent"] >= 0:
                other = branches[branch["parent"]]
                self.assertEqual(other["side"], branch["side"])
                objects = branch["side"] == "object"
                self.assertTrue(other["merges"] is None or (other["merges"] < branch["merges"] if objects else other["merges"] > branch["merges"]))
        self.assertGreater(branches[0]["joined"], 0)

    def test_commands_of_the_page_run(self):
        self.run_ok("atlas", "demo.nrrd", "--polarity", "high", "--top", "2", "-o", "two words.html")
        page = self.page("two words.html")[1]
        cavities = [entry for entry in page["entries"] if page["branches"][entry["branch"]]["side"] == "cavity"]
        self.assertEqual(len(page["entries"]) - len(cavities), 2)
        for command in page["entries"][1]["commands"] + cavities[0]["commands"]:
            words = shlex.split(command["line"])
            self.assertEqual(words[0], "isoatlas")
            self.run_ok(*words[1:])
            self.assertTrue((self.folder / words[-1]).is_file(), command)

    def test_the_store_is_used_again(self):
        told = self.run_json("demo.nrrd", "-o", "again.html", "--top", "1")
        self.assert_schema(told, "atlas")
        self.assertEqual((told["store"], told["output"]), ("again.atlas", "again.html"))
        before = os.stat(self.folder / "again.atlas").st_mtime_ns
        self.assertIn("exists and is used", self.run_ok("demo.nrrd", "-o", "again.html", "--top", "1").stderr)
        self.assertEqual(os.stat(self.folder / "again.atlas").st_mtime_ns, before)
        self.run_ok("demo.nrrd", "-o", "again.html", "--restart", "--top", "1")
        self.assertGreater(os.stat(self.folder / "again.atlas").st_mtime_ns, before)
        self.assertEqual(self.run_json("again.atlas", "-o", "other.html", "--top", "1")["store"], "again.atlas")

    def scan(self, name, spacing):
        """A RAW volume with a sidecar."""
        (self.folder / f"{name}.raw").write_bytes(bytes(9 * (3 <= x < 9 and 3 <= y < 9 and 3 <= z < 9) for z in range(12) for y in range(12) for x in range(12)))
        (self.folder / f"{name}.raw.json").write_text(json.dumps({"dims": [12, 12, 12], "type": "uint8", "spacing": spacing, "unit": "mm"}))
        return f"{name}.raw"

    def test_a_store_of_other_options_is_made_anew_and_the_difference_is_said(self):
        def said(*options):
            return self.run_ok("demo.nrrd", "-o", "options.html", "--top", "1", *options).stderr
        said()
        for options, difference in ((["--interpolant", "faces"], "interpolant trilinear there, faces here"),
                                    ([], "interpolant faces there, trilinear here"),
                                    (["--tunnel-height", "50"], "tunnel height 0 there, 50 here"),
                                    (["--voxel"], "is rebuilt: spacing"),
                                    (["--gaussian", "1"], "is rebuilt: spacing"),
                                    (["--missing", "below"], "missing samples refused there, below all others here"),
                                    (["--gaussian", "1.5"], "Gaussian none there, 1.5 here")):
            told = said(*options)
            self.assertIn(difference, told)
            self.assertNotIn("exists and is used", told)
            self.assertIn("exists and is used", said(*options))

    def test_a_store_of_another_sidecar_is_made_anew(self):
        scan = self.scan("sidecar", [1, 1, 1])
        self.run_ok(scan)
        before = self.run_json("objects", "sidecar.atlas")["objects"]
        self.scan("sidecar", [2, 2, 2])
        self.assertIn("spacing 1 x 1 x 1 there, 2 x 2 x 2 here", self.run_ok(scan).stderr)
        after = self.run_json("objects", "sidecar.atlas")["objects"]
        self.assertEqual([entry["measure"] for entry in after], [8 * entry["measure"] for entry in before])

    def test_content_counts_and_not_age(self):
        scan = self.scan("age", [1, 1, 1])
        self.run_ok(scan)
        os.utime(self.folder / scan)   # now: newer than the store
        self.assertIn("exists and is used", self.run_ok(scan).stderr)
        changed = bytearray((self.folder / scan).read_bytes())
        changed[500] = next(value for value in changed if value != changed[500])
        (self.folder / scan).write_bytes(changed)
        os.utime(self.folder / scan, (0, 0))   # long ago
        self.assertIn("is rebuilt: other samples there", self.run_ok(scan).stderr)

    def test_what_somebody_has_built_is_not_replaced(self):
        self.run_ok("build", "demo.nrrd", "--gaussian", "1", "-o", "mine.atlas", "--quiet")
        held = (self.folder / "mine.atlas").read_bytes()
        self.run_error(2, "demo.nrrd", "-o", "mine.html", says="is not replaced: Gaussian 1 there, none here", next_says="--restart")
        self.assertEqual((self.folder / "mine.atlas").read_bytes(), held)
        self.assertFalse((self.folder / "mine.html").exists())
        self.run_ok("demo.nrrd", "--gaussian", "1", "-o", "mine.html", "--top", "1")
        self.run_ok("mine.atlas", "-o", "mine.html", "--top", "1")
        self.assertEqual((self.folder / "mine.atlas").read_bytes(), held)
        (self.folder / "letter.atlas").write_text("Dear Sir or Madam")
        self.run_error(2, "demo.nrrd", "-o", "letter.html", says="exists and is not an isoatlas store", next_says="--restart")
        self.assertEqual((self.folder / "letter.atlas").read_text(), "Dear Sir or Madam")
        self.run_ok("demo.nrrd", "-o", "mine.html", "--restart", "--top", "1")
        self.assertNotEqual((self.folder / "mine.atlas").read_bytes(), held)

    def test_an_option_that_contradicts_a_store_is_refused(self):
        self.run_ok("build", "noise.nrrd", "-o", "plain.atlas", "--quiet")
        for options in (["--interpolant", "faces"], ["--gaussian", "1"], ["--tunnel-height", "3"], ["--missing", "0"]):
            self.run_error(2, "plain.atlas", *options, says="contradicts the store")
            self.run_error(2, "view", "plain.atlas", "--no-browser", *options, says="contradicts the store")

    def test_what_is_shown_and_hidden_is_all_there_is(self):
        self.run_ok("phantom", "random-field", "--size", "48", "--noise", "0.1", "-o", "field.nrrd")
        told = self.run_json("field.nrrd")
        text, page = self.page("field.atlas.html")
        shown = {entry["branch"] for entry in page["entries"]}
        self.assertEqual(len(shown) + told["hidden"], page["found"]["objects"]["all"] + page["low"]["found"]["all"])
        self.assertEqual((told["shown"], told["bytes"]), (len(page["entries"]), len(text.encode())))
        self.assertGreater(told["hidden"], 10000)
        self.assertLess(told["bytes"], 3_000_000)
        self.assertLessEqual(len(page["branches"]), 24 + 2 * 200 + 2)
        self.assertLessEqual(len(page["spectrum"]["edges"]), 481)

    def test_the_figure_of_the_dissertation_through_noise(self):
        """Figures 3.10 and 12.1: two rings, each of two sticks that become a plate, then one body, then around a cavity."""
        self.run_ok("phantom", "figure-plateau", "--noise", "0.02", "-o", "figure.nrrd")
        self.run_ok("figure.nrrd", "--polarity", "high")
        page = self.page("figure.atlas.html")[1]
        objects = [entry for entry in page["entries"] if page["branches"][entry["branch"]]["side"] == "object"]
        self.assertEqual(len({entry["branch"] for entry in objects}), 4)  # the four sticks
        sizes = sorted((entry["voxels"], entry["tunnels"], entry["cavities"]) for entry in objects)
        sticks, plates, joined, around = [(72, 0, 0)] * 3, [(288, 0, 0)] * 2, [(768, 1, 0)], [(2784, 0, 1)]
        self.assertEqual(sizes[:-1], sticks + plates + joined + around)  # the last one is the outline
        (cavities,) = [entry for entry in page["entries"] if page["branches"][entry["branch"]]["side"] == "cavity"]
        self.assertEqual((cavities["voxels"], cavities["tunnels"], cavities["cavities"]), (288, 0, 0))
        self.assertEqual(page["entries"][cavities["around"]]["cavities"], 1)

    def test_volumes_with_nothing_in_them(self):
        self.run_ok("flat.nrrd")
        page = self.page("flat.atlas.html")[1]
        self.assertEqual(page["volume"]["low"], page["volume"]["high"])
        self.assertIsNone(page["spectrum"])
        self.run_ok("noise.nrrd", "--polarity", "high")
        page = self.page("noise.atlas.html")[1]
        self.assertEqual([branch["significant"] for branch in page["branches"]], [True] + [False] * (len(page["branches"]) - 1))
        self.assertEqual({entry["branch"] for entry in page["entries"]}, {0})
        self.write_nrrd("flat.2d.nrrd", (24, 24), bytes(9 * (8 <= x < 16 and 8 <= y < 16) for y in range(24) for x in range(24)))
        self.run_ok("flat.2d.nrrd")
        self.assertEqual(self.page("flat.2d.atlas.html")[1]["entries"][0]["picture"]["frames"], 1)

    def test_what_is_no_volume_gives_a_message_and_no_page(self):
        self.write_nrrd("empty.nrrd", (0, 8, 8), b"")
        self.run_error(3, "empty.nrrd", says="0 samples")
        self.write_nrrd("nan.nrrd", (2, 2, 2), struct.pack("<8f", *[math.nan] * 8), "float")
        self.run_error(3, "nan.nrrd", says="nan", next_says="--missing")
        for name in ("empty", "nan"):
            self.assertEqual([file.name for file in self.folder.glob(name + ".*") if file.suffix != ".nrrd"], [])
        self.run_error(2, "demo.nrrd", "-o", "page.txt", says=".txt")
        self.run_error(3, "no such file.nrrd", says="there is no such file")

    def write_nrrd(self, name, sizes, samples, kind="uint8"):
        head = f"NRRD0004\ntype: {kind}\ndimension: {len(sizes)}\nsizes: {' '.join(map(str, sizes))}\nencoding: raw\nendian: little\n\n"
        (self.folder / name).write_bytes(head.encode() + samples)


if __name__ == "__main__":
    harness.main()
