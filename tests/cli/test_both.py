"""Objects of high and of low values together: references such as low2 in every verb, one page, one viewer."""
import json
import re
import shlex
import struct

import harness
import served

SIZE = 20


def body(x, y, z):
    """A block of 200 with a hole of 40 in it and a channel of 10 through it, in air of 100; x fastest."""
    if y in (4, 5) and z in (4, 5):
        return 10
    if 12 <= x <= 14 and 11 <= y <= 14 and 11 <= z <= 14:
        return 40
    inside = all(2 <= c <= 17 for c in (x, y, z))
    return 200 if inside else 100


def glb_nodes(path):
    data = path.read_bytes()
    length, = struct.unpack("<I", data[12:16])
    return [node["name"] for node in json.loads(data[20:20 + length]).get("nodes", []) if "mesh" in node]


class Both(harness.CliTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        values = [body(x, y, z) + (x * y + z) % 3 for z in range(SIZE) for y in range(SIZE) for x in range(SIZE)]
        head = f"NRRD0004\ntype: uchar\ndimension: 3\nsizes: {SIZE} {SIZE} {SIZE}\nspacings: 1 1 1\nencoding: ascii\n\n"
        (cls.folder / "v.nrrd").write_text(head + "\n".join(map(str, values)) + "\n")
        for words in (["build", "v.nrrd", "--polarity", "both", "-o", "both.atlas"], ["build", "v.nrrd", "-o", "high.atlas"]):
            done = cls.start(words)
            assert done.returncode == 0, done.stderr

    def listed(self, file="v.nrrd"):
        return self.run_json("objects", file, "--polarity", "both")["objects"]

    def page(self, name):
        text = (self.folder / name).read_text()
        return json.loads(re.search(r'<script id="atlas-data" type="application/json">(.*?)</script>', text, re.S)[1])

    def test_every_reference_of_the_list_works(self):
        objects = self.listed()
        self.assertEqual({o["reference"].startswith("low") for o in objects}, {True, False})
        for o in objects:
            for volume in ("v.nrrd", "both.atlas"):
                told = self.run_json("extract", volume, "--object", o["reference"], "-o", "a.ply")
                self.assert_schema(told, "extract")
                self.assertEqual((told["tau"], told["surfaces"][0]["id"], told["polarity"]), (o["best_tau"], o["id"], o["polarity"]))
                self.assertEqual(told["surfaces"][0]["reference"], o["reference"])
            side = ["--polarity", o["polarity"]]
            self.run_ok("extract", "v.nrrd", *side, "--object", o["number"], "-o", "b.ply")
            self.assertEqual((self.folder / "a.ply").read_bytes(), (self.folder / "b.ply").read_bytes())
        text = self.run_ok("objects", "v.nrrd", "--polarity", "both").stdout
        self.assertIn("low1", text)

    def test_both_in_one_command(self):
        for volume in ("v.nrrd", "both.atlas"):
            told = self.run_json("extract", volume, "--object", "1@150", "--object", "low1@50", "-o", "scene.glb")
            self.assertEqual([(s["reference"], s["tau"]) for s in told["surfaces"]], [("1", 150), ("low1", 50)])
            self.assertEqual(glb_nodes(self.folder / "scene.glb"), ["object 1", "object low1"])
            self.run_ok("extract", volume, "--object", "1@150,low1@50", "--split", "-o", "s.ply")
            self.assertTrue((self.folder / "s-low1-at-50.ply").exists())
            label = self.run_json("label", volume, "--object", "1@150,low1@50", "-o", "l.nrrd")
            self.assert_schema(label, "label")
            high, low = (self.run_json("objects", volume, "--tau", t, "--polarity", p)["objects"] for t, p in (("150", "high"), ("50", "low")))
            voxels = {s["reference"]: s["voxels"] for s in label["segments"]}
            self.assertEqual(voxels["1"], high[0]["voxels"])
            self.assertIn(voxels["low1"], [o["voxels"] for o in low])
            self.assertIn("low", (self.folder / "l.csv").read_text())
            self.run_ok("render", volume, "--object", "1@150", "--object", "low1@50", "--size", "64x64", "-o", "r.png")
        self.run_error(4, "extract", "high.atlas", "--object", "low1", "-o", "a.ply", says="low values", next_says="--polarity both")
        self.run_error(6, "extract", "v.nrrd", "--object", "low99", "-o", "a.ply", says="low99")
        self.run_error(2, "name", "v.nrrd", "1", "low2", says="number of an object")

    def test_an_overlap_belongs_to_the_smaller_object(self):
        label = self.run_json("label", "v.nrrd", "--object", "1@12", "--object", "low1@50", "-o", "l.seg.nrrd")
        voxels = {s["reference"]: s["voxels"] for s in label["segments"]}
        (high,), low = (self.run_json("objects", "v.nrrd", "--tau", t, "--polarity", p)["objects"] for t, p in (("12", "high"), ("50", "low")))
        self.assertIn(voxels["low1"], [o["voxels"] for o in low])     # all of the smaller one
        self.assertLess(voxels["1"], high["voxels"])                  # the other one has lost what is in it
        self.assertLess(voxels["low1"], voxels["1"])

    def test_verbs_about_one_polarity_run_for_each(self):
        verbs = [(["tree"], "tree-events"), (["tree", "--detail", "levels"], "tree-levels"), (["tree", "--keep", "2"], "simplified-tree"),
                 (["objects", "--tau", "50"], "objects-at"), (["objects", "--cavities"], "cavities"), (["objects", "--both"], "objects"),
                 (["measure"], "measure"), (["measure", "--tau", "50"], "measure"), (["spectrum"], "spectrum"), (["handles"], "handles"),
                 (["handles", "--exact"], "handles"), (["table131"], "table131")]
        for (verb, *options), schema in verbs:
            for volume in ("v.nrrd", "both.atlas"):
                if verb == "table131" and volume == "both.atlas":
                    continue
                both = self.run_json(verb, volume, *options, "--polarity", "both")
                self.assert_schema(both, "both")
                self.assertEqual(both["verb"], verb)
                for polarity in ("high", "low"):
                    one = self.run_json(verb, volume, *options, "--polarity", polarity)
                    self.assert_schema(both[polarity], schema)
                    self.assertEqual(both[polarity], one, (verb, options, volume, polarity))
            text = [self.run_ok(verb, "v.nrrd", *options, "--polarity", p).stdout for p in ("high", "low", "both")]
            self.assertEqual(text[2], f"high values\n{text[0]}\nlow values\n{text[1]}")

    def test_files_of_each_polarity(self):
        for words, name in ((["tree"], "t.csv"), (["measure"], "m.csv"), (["spectrum"], "s.svg")):
            self.run_ok(words[0], "v.nrrd", "--polarity", "both", "-o", name)
            stem, extension = name.split(".")
            for polarity in ("high", "low"):
                self.run_ok(words[0], "v.nrrd", "--polarity", polarity, "-o", name)
                own = self.folder / f"{stem}-{polarity}.{extension}"
                self.assertEqual((self.folder / name).read_bytes(), own.read_bytes())
        self.run_ok("objects", "v.nrrd", "--polarity", "both", "--curve", "c.csv")
        self.assertNotEqual((self.folder / "c-high.csv").read_bytes(), (self.folder / "c-low.csv").read_bytes())

    def test_half_an_answer_is_none(self):
        self.run_error(4, "tree", "high.atlas", "--polarity", "both", "-o", "new.csv", says="low values")
        (self.folder / "new-low.csv").mkdir()
        self.run_error(5, "tree", "v.nrrd", "--polarity", "both", "-o", "new.csv", says="new-low.csv")
        (self.folder / "new-low.csv").rmdir()
        self.run_error(6, "measure", "v.nrrd", "--polarity", "both", "--tau", "9", "-o", "new.csv", says="9")
        self.assertEqual([path.name for path in self.folder.glob("new*")], [])
        self.run_error(2, "handles", "v.nrrd", "--polarity", "both", "--exact", "--object", "low1", next_says="reference")
        self.run_error(2, "extract", "v.nrrd", "--polarity", "both", "--tau", "50", "-o", "a.ply", says="--polarity both")
        self.run_error(2, "animate", "v.nrrd", "--polarity", "both", "--from", "50", "--to", "20", "-o", "a.gif", says="--polarity both")

    def test_an_animation_of_both(self):
        self.run_ok("animate", "v.nrrd", "--polarity", "both", "--top", "3", "--steps", "2", "--size", "48x48", "-o", "a.gif")

    def test_measures_of_references_of_both(self):
        for side in ([], ["--polarity", "both"]):
            told = self.run_json("measure", "v.nrrd", *side, "--object", "low1@50,1@150", "-o", "m.csv")
            self.assert_schema(told, "measure")
            self.assertEqual(told["polarity"], "both")
            lines = [line.split(",") for line in (self.folder / "m.csv").read_text().splitlines()]
            for o, line, polarity, reference in zip(told["objects"], lines[1:], ("low", "high"), ("low1@50", "1@150")):
                self.assertEqual((o["polarity"], o["reference"]), (polarity, reference))
                (own,) = self.run_json("measure", "v.nrrd", "--object", reference)["objects"]
                self.assertEqual({**own, "polarity": polarity}, o)
                at = dict(zip(lines[0], line))
                self.assertEqual((at["polarity"], float(at["tau"]), int(at["voxels"])), (polarity, o["tau"], o["voxels"]))

    def test_names_of_both(self):
        self.run_ok("name", "both.atlas", "low1", "channel")
        self.run_ok("name", "both.atlas", "1", "block")
        names = self.run_json("name", "both.atlas")
        self.assert_schema(names, "name")
        self.assertEqual(self.run_json("name", "both.atlas", "--polarity", "both"), names)
        self.assertEqual([(n["reference"], n["name"]) for n in names["names"]], [("1", "block"), ("low1", "channel")])
        told = self.run_json("extract", "both.atlas", "--object", "channel", "--object", "block", "-o", "a.glb")
        self.assertEqual([s["reference"] for s in told["surfaces"]], ["low1", "1"])
        for name in ("channel", "block"):
            self.run_ok("name", "both.atlas", "--remove", name)

    def test_one_page(self):
        told = self.run_json("v.nrrd")
        self.assert_schema(told, "atlas")
        self.assertEqual(told["polarity"], "both")
        page = self.page("v.atlas.html")
        self.assert_schema(page, "page")
        self.assertEqual(page["polarity"], "both")
        self.assertEqual([e["reference"] for e in page["entries"]], [o["reference"] for o in self.listed()])
        branches, entries = page["branches"], page["entries"]
        self.assertEqual({b["side"] for b in branches}, {"object"})   # cavities are objects of low values
        self.assertEqual(told["shown_low"], sum(branches[e["branch"]]["polarity"] == "low" for e in entries))
        hole = next(e for e in entries if e["enclosed"])
        self.assertEqual(branches[hole["branch"]]["polarity"], "low")
        self.assertEqual(branches[entries[hole["around"]]["branch"]]["polarity"], "high")
        channel = next(e for e in entries if "-x +x" in e["border"])
        self.assertFalse(channel["enclosed"])
        for entry in (hole, channel, entries[0]):
            self.assertTrue(entry["picture"]["image"].startswith("data:image/webp"))
            for command in entry["commands"]:
                words = shlex.split(command["line"])
                self.run_ok(*words[1:])
                self.assertTrue((self.folder / words[-1]).is_file(), command)
        self.assertIn("exists and is used", self.run_ok("v.nrrd").stderr)
        self.run_ok("v.nrrd", "--polarity", "high", "-o", "h.html")
        high = self.page("h.html")
        self.assertEqual((high["polarity"], "low" in high), ("high", False))
        self.assertGreater(sum(b["side"] == "cavity" for b in high["branches"]), 0)

    def test_what_is_built_of_one_polarity_is_shown_as_it_is(self):
        self.run_ok("high.atlas", "-o", "own.html")
        self.assertEqual(self.page("own.html")["polarity"], "high")
        self.run_ok("v.nrrd", "-o", "high.html")   # beside high.atlas, which somebody has built
        self.assertEqual(self.page("high.html")["polarity"], "high")

    def test_fill_values_leave_high_values_alone(self):
        values = [-9999 if x < 4 else body(x, y, z) + (7 * x + 5 * y + 3 * z) % 11 for z in range(SIZE) for y in range(SIZE) for x in range(SIZE)]
        head = f"NRRD0004\ntype: short\ndimension: 3\nsizes: {SIZE} {SIZE} {SIZE}\nencoding: ascii\n\n"
        (self.folder / "fill.nrrd").write_text(head + "\n".join(map(str, values)) + "\n")
        self.assertIn("objects of high values alone", self.run_ok("fill.nrrd").stderr)
        page = self.page("fill.atlas.html")
        self.assertEqual(page["polarity"], "high")
        self.assertTrue(any("high values alone" in note for note in page["notes"]))
        self.run_error(2, "fill.nrrd", "--polarity", "both", "--restart", says="fill value")

    def test_the_viewer_answers_for_both(self):
        viewer = served.Viewer(self.folder, "both.atlas")
        try:
            viewer.until("open")
            def json_of(path):
                status, _, body = viewer.ask(path)
                self.assertEqual(status, 200, body)
                return json.loads(body)
            atlas = json_of("/api/atlas")
            self.assert_schema(atlas, "page")
            low = next(i for i, e in enumerate(atlas["entries"]) if e["reference"] == "low1")
            entry = atlas["entries"][low]
            tau, voxel = entry["tau"], entry["id"]
            for path in (f"/api/surface?tau={tau!r}&object=v{voxel}&format=ply&polarity=low", f"/api/surface?tau={tau!r}&object=low1&polarity=low&format=ply"):
                status, _, mesh = viewer.ask(path)
                self.assertEqual(status, 200, mesh)
                self.run_ok("extract", "both.atlas", "--object", "low1", "-o", "x.ply")
                self.assertEqual(mesh, (self.folder / "x.ply").read_bytes())
            self.assertEqual(viewer.ask(f"/api/surface?tau={tau!r}&object=low1")[0], 400)
            self.assertEqual(json_of(f"/api/preview?tau={tau!r}&object=v{voxel}&polarity=low")["object"]["id"], voxel)
            self.assertEqual(json_of(f"/api/measures?tau={tau!r}&object=v{voxel}&polarity=low")["objects"][0]["id"], voxel)
            self.assertIsNotNone(json_of(f"/api/card?entry={low}&frames=1")["picture"])
            z, rest = divmod(voxel, SIZE * SIZE)
            at = json_of(f"/api/at?voxel={rest % SIZE},{rest // SIZE},{z}&object=lowv{voxel}@{tau!r},1")
            self.assertEqual(at["objects"][0], True)
            self.assertIn(low, at["entries"])
            words = ["1@150", "low1@50"]
            for kind, format in (("surfaces", "glb"), ("segmentation", "seg.nrrd")):
                status, _, body = viewer.ask(f"/api/{kind}?object={','.join(words)}&format={format}")
                verb = "extract" if kind == "surfaces" else "label"
                self.run_ok(verb, "both.atlas", "--object", *words, "-o", "y." + format)
                self.assertEqual((status, body), (200, (self.folder / ("y." + format)).read_bytes()), kind)
            self.assertGreater(json_of("/api/branches?top=5&polarity=low")["all"], 0)
        finally:
            self.assertEqual(viewer.stop()[0], 0)


if __name__ == "__main__":
    harness.main()
