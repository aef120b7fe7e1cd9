"""Objects of low values: every verb with --polarity says about a volume what it says of high values about the negated one."""
import array
import json
import re

import harness

SIZE = 11


def channel_volume():
    """Values 0 to 255, x fastest: a channel through the volume, a hole inside, a corner; some bumps."""
    values = []
    for z in range(SIZE):
        for y in range(SIZE):
            for x in range(SIZE):
                if y == 2 and z == 2:
                    value = 10 + x % 3
                elif 4 <= x <= 7 and 5 <= y <= 8 and 4 <= z <= 7:
                    value = 20 + (x * y + z) % 5
                elif x + y + z >= 28:
                    value = 30
                else:
                    value = 180 + (7 * x + 5 * y + 3 * z) % 11
                values.append(value)
    return values


class Polarity(harness.CliTest):
    phantoms = {"noise.nrrd": ["noise", "--size", "14", "--quantise", "64"]}

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        values = channel_volume()
        head = f"NRRD0004\ntype: {{}}\ndimension: 3\nsizes: {SIZE} {SIZE} {SIZE}\nspacings: 1 1 2\nencoding: ascii\n\n"
        (cls.folder / "v.nrrd").write_text(head.format("uchar") + "\n".join(map(str, values)) + "\n")
        (cls.folder / "minus.nrrd").write_text(head.format("short") + "\n".join(str(-v) for v in values) + "\n")
        for arguments in (["build", "v.nrrd", "--polarity", "both", "-o", "both.atlas"], ["build", "v.nrrd", "--polarity", "low", "-o", "low.atlas"],
                          ["build", "v.nrrd", "-o", "high.atlas"]):
            done = cls.start(arguments)
            assert done.returncode == 0, done.stderr

    def low(self, verb, file, *more):
        """Of the volume, of the store of both and of that of one polarity: the same."""
        documents = [self.run_json(verb, name, *(["--polarity", "low"] if name != "low.atlas" else []), *more)
                     for name in ([file, "both.atlas", "low.atlas"] if file == "v.nrrd" else [file])]
        for document in documents:
            self.assertEqual(document["polarity"], "low")
        return documents

    def test_the_table_is_that_of_the_negated_volume(self):
        for more in ([], ["--all"], ["--keep", "3"]):
            minus = self.run_json("objects", "minus.nrrd", *more)["objects"]
            for document in self.low("objects", "v.nrrd", *more):
                self.assert_schema(document, "objects")
                self.assertEqual(len(document["objects"]), len(minus))
                for own, other in zip(document["objects"], minus):
                    self.assertEqual((own["id"], own["voxels"], own["tunnels"], own["cavities"]),
                                     (other["id"], other["voxels"], other["tunnels"], other["cavities"]))
                    self.assertAlmostEqual(own["hypervolume"], other["hypervolume"])
                    self.assertAlmostEqual(own["best_tau"], -other["best_tau"])
                    self.assertEqual(own["appears"], -other["appears"])

    def test_the_border_is_told(self):
        sides = {o["appears"]: o["border"]["sides"] for o in self.low("objects", "v.nrrd")[0]["objects"]}
        self.assertEqual((sides[10], sides[20], sides[30]), ("-x +x", "", "+x +y +z"))
        text = self.run_ok("objects", "v.nrrd", "--polarity", "low").stdout
        self.assertIn("reaches the border at -x +x", text)
        self.assertIn("cavity", text)

    def test_cut_extract_label(self):
        at = self.run_json("objects", "minus.nrrd", "--tau", "-100")
        for document in self.low("objects", "v.nrrd", "--tau", "100"):
            self.assert_schema(document, "objects-at")
            self.assertEqual(document["objects"], at["objects"])
        self.run_ok("label", "minus.nrrd", "--tau", "-100", "-o", "minus.tif")
        self.run_ok("extract", "minus.nrrd", "--tau", "-100", "-o", "minus.stl")
        for name in ("v.nrrd", "both.atlas"):
            label = self.run_json("label", name, "--polarity", "low", "--tau", "100", "-o", "low.tif")
            self.assertEqual((label["labels"], label["polarity"]), (3, "low"))
            surface = self.run_json("extract", name, "--polarity", "low", "--tau", "100", "-o", "low.stl")
            self.assertEqual((surface["objects"], surface["closed"], surface["tau"]), (3, True, 100))
            # STL: 80 bytes of header, then the same triangles, normals too
            self.assertEqual((self.folder / "low.stl").read_bytes()[80:], (self.folder / "minus.stl").read_bytes()[80:])
            self.run_ok("verify", "low.stl")
        for name in ("low.ply", "low.obj", "low.vtp", "low.glb"):
            self.run_ok("extract", "v.nrrd", "--polarity", "low", "--tau", "100", "-o", name)
            self.assertRegex((self.folder / name).read_bytes(), rb"(?i)polarity")

    def test_measures_have_the_values_of_the_file(self):
        for more, minus_more in ((["--tau", "100"], ["--tau", "-100"]), ([], [])):
            minus = self.run_json("measure", "minus.nrrd", *minus_more)
            for document in self.low("measure", "v.nrrd", *more):
                self.assert_schema(document, "measure")
                self.assertEqual(len(document["objects"]), len(minus["objects"]))
                for own, other in zip(document["objects"], minus["objects"]):
                    for name in ("id", "voxels", "voxel_volume", "euler", "tunnels", "cavities", "touches_border", "centroid", "axes"):
                        self.assertEqual(own[name], other[name], name)
                    for name in ("volume", "area", "sphericity", "equivalent_diameter"):
                        self.assertAlmostEqual(own[name], other[name], delta=1e-9 * other[name])
                    values, mirrored = own["values"], other["values"]
                    self.assertAlmostEqual(values["mean"], -mirrored["mean"], delta=1e-9)
                    self.assertEqual((values["min"], values["max"]), (-mirrored["max"], -mirrored["min"]))
                    self.assertEqual(values["sum"], -mirrored["sum"])
                    self.assertAlmostEqual(own["tau"], -other["tau"])
                    self.assertLessEqual(values["max"], own["tau"])
                for axis in range(3):   # of the file's values: high is high
                    self.assertAlmostEqual(document["percolation"]["high"][axis], -minus["percolation"]["low"][axis], delta=1e-9)
                    self.assertAlmostEqual(document["percolation"]["low"][axis], -minus["percolation"]["high"][axis], delta=1e-9)
            self.assertEqual(self.run_json("measure", "v.nrrd", *more)["porosity"]["below"], document["porosity"]["below"])
        self.run_ok("measure", "both.atlas", "--polarity", "low", "--tau", "100", "-o", "low.csv")
        rows = (self.folder / "low.csv").read_text().splitlines()
        self.assertTrue(rows[0].endswith(",polarity") and all(row.endswith(",low") for row in rows[1:]) and len(rows) == 4, rows)
        text = self.run_ok("measure", "v.nrrd", "--polarity", "low", "--top", "3").stdout
        self.assertIn("reaches the border", text)
        self.assertEqual(text.count("reaches the border, reaches"), 0)

    def test_every_best_isovalue_reads_back(self):
        for document in self.low("objects", "v.nrrd", "--all"):
            for o in document["objects"]:
                at = self.run_json("objects", "v.nrrd", "--polarity", "low", "--tau", repr(o["best_tau"]))
                self.assertIn((o["id"], o["voxels"]), [(p["id"], p["voxels"]) for p in at["objects"]])
        text = self.run_ok("objects", "noise.nrrd", "--polarity", "low", "--all", "--top", "12").stdout
        for line in text.splitlines()[1:]:
            number, voxel, appears, merges, tau, voxels = line.split()[:6]
            self.assertRegex(voxel, "^v[0-9]+$")
            at = self.run_json("objects", "noise.nrrd", "--polarity", "low", "--tau", tau)
            self.assertIn((int(voxel[1:]), int(voxels.replace(",", ""))), [(p["id"], p["voxels"]) for p in at["objects"]])
            if merges != "never":   # at that isovalue it is part of another one, just below it is not
                joined = self.run_json("objects", "noise.nrrd", "--polarity", "low", "--tau", merges)["objects"]
                self.assertGreater(max(p["voxels"] for p in joined), int(voxels.replace(",", "")))

    def test_tree_and_spectrum(self):
        for document in self.low("tree", "v.nrrd", "--all"):
            self.assert_schema(document, "tree-events")
            events = [dict(zip(document["columns"], row)) for row in document["events"]]
            self.assertEqual((events[-1]["parent"], events[-1]["tau_low"]), (None, None))
            self.assertEqual({e["kind"] for e in events if not e["children"]}, {"minimum"})
            for e in events[:-1]:   # the zone is [value, value of the parent)
                self.assertLess(e["value"], events[e["parent"]]["value"])
                self.assertEqual(e["tau_low"], events[e["parent"]]["value"])
        for name in ("tree.csv", "tree.graphml", "tree.vtu"):
            self.run_ok("tree", "v.nrrd", "--polarity", "low", "-o", name)
            self.assertRegex((self.folder / name).read_bytes(), rb"(?i)polarity")
        for document in self.low("spectrum", "v.nrrd", "--samples", "3"):
            self.assert_schema(document, "spectrum")
            for interval in document["intervals"]:
                self.assertTrue(interval["high"] is None or interval["low"] < interval["high"])
        for name in ("curve.csv", "curve.svg"):
            self.run_ok("spectrum", "v.nrrd", "--polarity", "low", "-o", name)
        self.low("tree", "v.nrrd", "--keep", "2")
        self.low("handles", "v.nrrd")
        self.assertIn("up to", self.run_ok("tree", "v.nrrd", "--polarity", "low").stdout)

    def test_both_in_one_list(self):
        documents = [self.run_json("objects", name, "--polarity", "both") for name in ("v.nrrd", "both.atlas")]
        for document in documents:
            self.assert_schema(document, "objects")
            self.assertEqual(document["polarity"], "both")
            self.assertEqual({o["polarity"] for o in document["objects"]}, {"high", "low"})
            hole = [o for o in document["objects"] if o["polarity"] == "low" and o["appears"] == 20]
            self.assertTrue(hole and "cavity" in hole[0]["note"], document["objects"])
            self.assertEqual(document["objects"][hole[0]["cavity_of"] - 1]["polarity"], "high")
        self.assertEqual([(o["polarity"], o["id"], o["note"]) for o in documents[0]["objects"]],
                         [(o["polarity"], o["id"], o["note"]) for o in documents[1]["objects"]])
        text = self.run_ok("objects", "v.nrrd", "--polarity", "both").stdout
        self.assertIn("polarity", text)
        self.assertEqual(len(self.run_json("objects", "v.nrrd", "--polarity", "both", "--top", "3")["objects"]), 3)

    def test_the_first_of_both_are_written_together(self):
        for name in ("v.nrrd", "both.atlas"):
            both = [name, "--polarity", "both"]
            listed = [o["reference"] for o in self.run_json("objects", *both)["objects"]][:3]
            self.assertTrue(any(r.startswith("low") for r in listed) and not all(r.startswith("low") for r in listed), listed)
            for words in (["--top", "3"], ["--top", "2", "--object", listed[2]]):
                found = self.run_json("extract", *both, *words, "-o", "three.glb")["surfaces"]
                self.assertEqual(sorted(s["reference"] for s in found), sorted(listed))
            labels = self.run_json("label", *both, "--top", "3", "-o", "three.seg.nrrd")["segments"]
            self.assertEqual(sorted(s["reference"] for s in labels), sorted(listed))
            self.run_ok("render", *both, "--top", "3", "-o", "three.png")
            for verb, words in (("extract", ["--tau", "100"]), ("label", ["--zones"]), ("label", ["--tau", "100"]),
                                ("render", ["--tau", "100"]), ("extract", ["--contour", "c1", "--top", "3"])):
                self.run_error(2, verb, *both, *words, "-o", {"extract": "x.ply", "label": "x.nrrd", "render": "x.png"}[verb],
                               says="the list of objects of both polarities")
        self.run_ok("build", "v.nrrd", "-o", "high.atlas")
        self.run_error(4, "extract", "high.atlas", "--polarity", "both", "--top", "3", "-o", "x.glb", says="low")

    def test_numbers_and_names_of_a_polarity(self):
        tables = {side: self.run_json("objects", "both.atlas", "--polarity", side)["objects"] for side in ("high", "low")}
        for side, table in tables.items():
            self.assertEqual([o["number"] for o in table], list(range(1, len(table) + 1)))
            for name in ("v.nrrd", "both.atlas"):
                surface = self.run_json("extract", name, "--polarity", side, "--object", "1", "-o", "one.ply")
                self.assertEqual((surface["surfaces"][0]["id"], surface["tau"]), (table[0]["id"], table[0]["best_tau"]))
        for o in self.run_json("objects", "both.atlas", "--polarity", "both")["objects"]:
            self.assertEqual(tables[o["polarity"]][o["number"] - 1]["id"], o["id"])
        hole = next(o["number"] for o in tables["low"] if o["appears"] == 20)
        error = self.run_error(6, "extract", "v.nrrd", "--polarity", "low", "--object", f"{hole}@15", "-o", "one.ply")
        self.assertIn("at least 20", error["expected"])

        self.run_ok("name", "both.atlas", "1", "channel", "--polarity", "low")
        self.run_ok("name", "both.atlas", "1", "block")
        self.assertTrue((self.folder / "both.atlas.names.json").exists())
        self.assertTrue((self.folder / "both.low.atlas.names.json").exists())
        for side, name in (("low", "channel"), ("high", "block")):
            self.assertEqual(self.run_json("objects", "both.atlas", "--polarity", side)["objects"][0]["name"], name)
            names = self.run_json("name", "both.atlas", "--polarity", side)
            self.assert_schema(names, "name")
            self.assertEqual([n["name"] for n in names["names"]], [name])
        self.assertIn("channel", self.run_ok("objects", "both.atlas", "--polarity", "both").stdout)
        for name, side in (("channel", "low"), ("block", "high")):   # a name is looked for on both sides
            surface = self.run_json("extract", "both.atlas", "--object", name, "-o", "one.ply")
            self.assertEqual((surface["surfaces"][0]["id"], surface["polarity"]), (tables[side][0]["id"], side))
        self.run_error(2, "name", "both.atlas", "low2", "block", says="of high values has the name")
        self.run_ok("name", "both.atlas", "--remove", "channel", "--polarity", "low")
        self.run_ok("name", "both.atlas", "--remove", "block")

    def test_measures(self):
        high = self.run_json("measure", "v.nrrd")
        for document in self.low("measure", "v.nrrd"):
            self.assert_schema(document, "measure")
            self.assertEqual(document["porosity"], high["porosity"])
            for side in ("high", "low"):
                for own, other in zip(document["percolation"][side], high["percolation"][side]):
                    self.assertAlmostEqual(own, other)
            for o in document["objects"]:
                values = o["values"]
                self.assertLessEqual(values["min"], values["mean"])
                self.assertLessEqual(values["max"], o["tau"])
                self.assertAlmostEqual(values["sum"], values["mean"] * o["voxels"])
        for document in self.low("measure", "v.nrrd", "--tau", "100"):
            self.assertEqual(document["below_tau"], sum(value < 100 for value in channel_volume()))
        self.run_ok("measure", "v.nrrd", "--polarity", "low", "-o", "low.csv")
        self.assertTrue((self.folder / "low.csv").read_text().splitlines()[0].endswith(",polarity"))

    def test_segmentations_and_fill_values(self):
        for name in ("v.nrrd", "both.atlas"):
            self.run_ok("label", name, "--polarity", "low", "--top", "2", "-o", "low.seg.nrrd")
            self.assertIn(b"isoatlas.polarity:low", (self.folder / "low.seg.nrrd").read_bytes())
        values = [-9999 if i < 200 else value for i, value in enumerate(channel_volume())]
        head = f"NRRD0004\ntype: short\ndimension: 3\nsizes: {SIZE} {SIZE} {SIZE}\nencoding: ascii\n\n"
        (self.folder / "fill.nrrd").write_text(head + "\n".join(map(str, values)) + "\n")
        for side, tau in (("high", "11"), ("low", "190")):
            at = self.run_json("objects", "fill.nrrd", "--polarity", side, "--tau", tau)
            self.assertLessEqual(sum(o["voxels"] for o in at["objects"]), SIZE ** 3 - 200)
        for o in self.run_json("objects", "fill.nrrd", "--polarity", "both")["objects"]:
            self.assertGreaterEqual(o["best_tau"], 0)
        self.run_error(2, "build", "fill.nrrd", "--polarity", "both", "-o", "fill.atlas", says="fill value")
        self.run_ok("build", "fill.nrrd", "--polarity", "both", "--no-data", "none", "-o", "fill.atlas")
        self.run_error(2, "objects", "v.nrrd", "--labels", "yes", "--polarity", "low", says="labels")

    def test_stores_and_convert(self):
        self.run_error(4, "objects", "high.atlas", "--polarity", "low", next_says="--polarity both")
        self.run_error(4, "objects", "low.atlas", "--polarity", "high", says="high")
        for name in ("both.atlas", "low.atlas"):
            self.run_ok("convert", name, "-o", "back.raw")
            self.assertEqual(list((self.folder / "back.raw").read_bytes()), channel_volume())
            self.run_ok("verify", name, "--full", "--polarity", "low")
            self.assertIn("low values", self.run_ok("info", name).stdout)
            self.run_ok("dump", name, "low/elements/place")
        self.run_ok("verify", "both.atlas", "--full")
        self.run_ok("verify", "v.nrrd", "--polarity", "low")
        for name in ("v.nrrd", "both.atlas"):
            checks = [check["name"] for check in self.run_json("verify", name, "--polarity", "both")["checks"]]
            low = [check for check in checks if check.endswith("_of_low_values")]
            self.assertEqual([check + "_of_low_values" for check in checks if check not in low], low)
        self.assertEqual(self.run_json("info", "both.atlas")["values"]["low"], 10)
        text = self.run_ok("info", "low.atlas").stdout
        self.assertRegex(text, r"values +10 \.\. 190")
        self.assertEqual((self.folder / "high.atlas").read_bytes()[:16], (self.folder / "both.atlas").read_bytes()[:16])

    def test_a_page_of_the_low_side(self):
        self.run_ok("v.nrrd", "--polarity", "low", "--top", "3")
        page = (self.folder / "v.low.atlas.html").read_text()
        self.assertTrue((self.folder / "v.low.atlas").exists())
        data = json.loads(re.search(r'<script id="atlas-data" type="application/json">(.*?)</script>', page, re.S)[1])
        self.assertEqual(data["polarity"], "low")
        self.assertEqual((data["axis"]["low"], data["axis"]["high"]), (10, 190))
        for edges in (data["histogram"]["edges"], data["spectrum"]["edges"]):
            self.assertEqual(edges, sorted(edges))
        self.assertEqual(sum(data["histogram"]["counts"]), SIZE ** 3)
        for entry in data["entries"]:
            self.assertTrue(entry["low"] <= entry["tau"] <= entry["high"])
        self.assertIn("exists and is used", self.run_ok("v.nrrd", "--polarity", "low", "--top", "3").stderr)

    def test_isovalues_outside_the_range(self):
        error = self.run_error(6, "objects", "v.nrrd", "--polarity", "low", "--tau", "5", says="below every sample")
        self.assertEqual(error["expected"], "10 .. 190")
        self.run_error(6, "objects", "v.nrrd", "--polarity", "low", "--tau", "200", says="above every sample")

    def test_missing_samples_are_in_no_object(self):
        values = [float("nan") if 2 <= i % 5 <= 3 else float(i % 7) for i in range(125)]
        (self.folder / "gaps.raw").write_bytes(array.array("f", values).tobytes())
        words = ["gaps.raw", "--dims", "5x5x5", "--type", "float32", "--missing", "below"]
        for polarity, tau in (("high", "0"), ("low", "6")):
            at = self.run_json("objects", *words, "--polarity", polarity, "--tau", tau)
            self.assertEqual(sum(o["voxels"] for o in at["objects"]), sum(v == v for v in values))
        self.run_error(2, "build", *words, "--polarity", "both", "-o", "gaps.atlas", says="--missing below")

    def test_a_picture(self):
        picture = self.run_json("render", "v.nrrd", "--polarity", "low", "--top", "2", "--size", "64x64", "-o", "low.png")
        self.assertEqual(picture["polarity"], "low")
        self.run_ok("render", "v.nrrd", "--polarity", "low", "--slice", "z=2", "--flat", "--size", "64x64", "-o", "low_slice.png")
        self.run_ok("render", "v.nrrd", "--slice", "z=2", "--flat", "--size", "64x64", "-o", "slice.png")
        self.assertEqual((self.folder / "low_slice.png").read_bytes(), (self.folder / "slice.png").read_bytes())
        self.run_ok("animate", "v.nrrd", "--polarity", "low", "--from", "12", "--to", "120", "--steps", "2", "--size", "32x32", "-o", "low.gif")


if __name__ == "__main__":
    harness.main()
