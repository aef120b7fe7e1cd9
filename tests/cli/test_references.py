"""One number for one thing: 2, c3, v218663 and names mean the same in every verb; several objects leave as one file."""
import json
import struct

import harness


def glb_nodes(path):
    data = path.read_bytes()
    length, = struct.unpack("<I", data[12:16])
    return [node["name"] for node in json.loads(data[20:20 + length]).get("nodes", []) if "mesh" in node]


class References(harness.CliTest):
    phantoms = {"demo.nrrd": ["demo", "--size", "48"], "noise.nrrd": ["noise", "--size", "12", "--quantise", "64"],
                "figure.nrrd": ["figure-plateau"]}

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        assert cls.start(["build", "demo.nrrd", "-o", "demo.atlas"]).returncode == 0

    def table(self, *words):
        return self.run_json("objects", "demo.nrrd", *words)["objects"]

    def extracted(self, *words, volume="demo.nrrd"):
        told = self.run_json("extract", volume, *words)
        self.assert_schema(told, "extract")
        return told

    def names_are_gone(self):
        (self.folder / "demo.atlas.names.json").unlink(missing_ok=True)

    def setUp(self):
        self.names_are_gone()

    # numbers

    def test_a_number_is_the_line_of_the_table(self):
        objects = self.table()
        self.assertEqual([o["number"] for o in objects], list(range(1, len(objects) + 1)))
        for o in objects:
            for volume in ("demo.nrrd", "demo.atlas"):
                told = self.extracted("--object", o["number"], "-o", "a.ply", volume=volume)
                self.assertEqual((told["tau"], told["surfaces"][0]["number"], told["surfaces"][0]["id"]), (o["best_tau"], o["number"], o["id"]))
            self.run_ok("extract", "demo.nrrd", "--object", f"v{o['id']}@{o['best_tau']!r}", "-o", "b.ply")
            self.assertEqual((self.folder / "a.ply").read_bytes(), (self.folder / "b.ply").read_bytes())
        text = self.run_ok("objects", "demo.nrrd").stdout
        self.assertIn(f"v{objects[0]['id']}", text)
        self.assertEqual(self.table("--top", "2"), objects[:2])

    def test_numbers_do_not_depend_on_what_is_listed(self):
        for volume in ("figure.nrrd", "noise.nrrd", "demo.nrrd"):
            for side in ([], ["--cavities"]):
                numbers = {(o["id"], o["best_tau"]): o["number"] for o in self.run_json("objects", volume, "--top", "1000", *side)["objects"]}
                for words in (["--all"], ["--keep", "2"], ["--persistence", "20%"]):
                    for o in self.run_json("objects", volume, *words, *side)["objects"]:
                        self.assertEqual(o["number"], numbers.get((o["id"], o["best_tau"])), (volume, words))

    def test_an_isovalue_of_its_own(self):
        objects = self.table()
        high, low = objects[1], objects[0]
        at = self.extracted("--object", f"{high['number']}@{low['best_tau']!r}", "-o", "a.ply")
        self.assertEqual(at["tau"], low["best_tau"])
        tau = self.extracted("--object", high["number"], "--tau", repr(low["best_tau"]), "-o", "a.ply")
        self.assertEqual({**at, "reads": None}, {**tau, "reads": None})

    def test_what_does_not_exist(self):
        objects, cavities = self.table(), self.table("--cavities")
        error = self.run_error(6, "extract", "demo.nrrd", "--object", len(objects) + 1, "-o", "x.ply", says="there is no object")
        self.assertIn(f"1 to {len(objects)}", error["expected"])
        self.assertIn(f"v{len(objects) + 1}", error["next"])
        self.run_error(6, "extract", "demo.nrrd", "--object", "0", "-o", "x.ply", says="there is no object 0")
        self.run_error(6, "extract", "demo.nrrd", "--object", f"c{len(cavities) + 1}", "-o", "x.ply", says="there is no cavity")
        self.run_error(6, "extract", "demo.nrrd", "--object", "v999999999", "-o", "x.ply", says="v999999999")
        self.run_error(6, "extract", "demo.nrrd", "--object", "skull", "-o", "x.ply", says='"skull"', next_says="isoatlas objects")
        self.run_error(6, "extract", "demo.nrrd", "--object", "1@1e9", "-o", "x.ply", says="above every sample")
        ring = max(objects, key=lambda o: -o["appears"])
        self.run_error(6, "extract", "demo.nrrd", "--object", f"{ring['number']}@{ring['appears'] + 1}", "-o", "x.ply", says="does not exist")
        for bad in ("1@", "1@x", "@5", "-1", "c-1", "a@b@c", "x/y", "1,", ",1"):
            self.run_error(2, "extract", "demo.nrrd", f"--object={bad}", "-o", "x.ply", says="--object")
        for verb in (["render", "-o", "x.png"], ["label", "-o", "x.nrrd"], ["handles", "--exact"]):
            self.run_error(6, verb[0], "demo.nrrd", "--object", len(objects) + 1, *verb[1:], says="there is no object")
        self.run_error(2, "extract", "demo.nrrd", "--contour", "1", "--tau", "100", "-o", "x.ply", says="contour 1")
        self.assertFalse((self.folder / "x.ply").exists())

    def test_a_voxel_of_several_lines(self):
        objects = self.table()
        own = [o["number"] for o in objects if o["id"] == objects[0]["id"]]
        self.assertGreater(len(own), 1)
        self.run_error(2, "extract", "demo.nrrd", "--object", f"v{objects[0]['id']}", "-o", "x.ply", says=", ".join(map(str, own)))
        alone = next(o for o in objects if [p["id"] for p in objects].count(o["id"]) == 1)
        self.assertEqual(self.extracted("--object", f"v{alone['id']}", "-o", "a.ply")["surfaces"][0]["number"], alone["number"])

    def test_cavities(self):
        cavities = self.table("--cavities")
        self.assertEqual([c["number"] for c in cavities], list(range(1, len(cavities) + 1)))
        self.assertIn("c1", self.run_ok("objects", "demo.nrrd", "--cavities").stdout)
        for c in cavities:
            for option in ("--object", "--contour"):
                told = self.extracted(option, f"c{c['number']}", "-o", "a.ply")
                self.assertEqual((told["tau"], told["contours"]), (c["best_tau"], 1))
            self.run_ok("extract", "demo.nrrd", "--contour", f"v{c['id']}@{c['best_tau']!r}", "-o", "b.ply")
            self.assertEqual((self.folder / "a.ply").read_bytes(), (self.folder / "b.ply").read_bytes())

    def test_pictures_and_tunnels(self):
        objects = self.table()
        drawn = self.run_json("render", "demo.nrrd", "--object", "2,5@160", "--object", "c1", "--size", "32", "--samples", "1", "-o", "a.png")
        self.assertEqual([o["tau"] for o in drawn["objects"]][:2], [objects[1]["best_tau"], 160])
        self.assertIn("object 2", drawn["objects"][0]["name"])
        self.assertIn("cavity 1", drawn["objects"][2]["name"])
        exact = [self.run_json("handles", "demo.nrrd", "--exact", "--object", word)["handles"] for word in ("4", f"v{objects[3]['id']}")]
        self.assertEqual(exact[0], exact[1])
        self.run_error(2, "handles", "demo.nrrd", "--exact", "--object", "4@3", says="isovalues")
        self.run_error(2, "handles", "demo.nrrd", "--exact", "--object", "c1", says="cavity")

    # several objects

    def test_several_objects_in_one_file(self):
        objects = self.table()
        alone = {o["number"]: self.extracted("--object", o["number"], "-o", "a.ply")["triangles"] for o in objects}
        for volume in ("demo.nrrd", "demo.atlas"):
            for extension in harness.MESHES:
                told = self.extracted("--object", "2", "--object", "5", "4", "-o", "all" + extension, volume=volume)
                self.assertEqual([s["number"] for s in told["surfaces"]], [2, 5, 4])
                self.assertEqual([s["triangles"] for s in told["surfaces"]], [alone[n] for n in (2, 5, 4)])
                self.assertEqual((told["triangles"], told["tau"]), (sum(alone[n] for n in (2, 5, 4)), None))
                self.assertEqual(self.run_json("verify", "all" + extension)["triangles"], told["triangles"])
        text = self.run_ok("extract", "demo.nrrd", "--object", "2", "5", "-o", "all.ply").stdout
        self.assertIn("object 5", text)

    def test_the_same_object_is_written_once(self):
        told = self.extracted("--object", "2@150", "--object", "3@150", "--object", "1", "-o", "all.glb")
        self.assertEqual([s["number"] for s in told["surfaces"]], [2, 1])
        self.assertEqual(len(told["notes"]), 1)

    def test_split(self):
        told = self.extracted("--top", "3", "--split", "-o", "part.stl")
        self.assertEqual([s["output"] for s in told["surfaces"]], ["part-1.stl", "part-2.stl", "part-3.stl"])
        told = self.extracted("--object", "2", "5@170", "--contour", "c1", "--split", "-o", "part.ply")
        self.assertEqual([s["output"] for s in told["surfaces"]], ["part-2.ply", "part-5-at-170.ply", "part-c1.ply"])
        for part in told["surfaces"]:
            self.assertTrue(self.run_json("verify", part["output"])["holds"])
        self.assertFalse((self.folder / "part.ply").exists())
        self.run_error(2, "extract", "demo.nrrd", "--tau", "100", "--split", "-o", "x.ply", says="--split")
        self.run_error(2, "extract", "demo.nrrd", "--tau", "100", "--top", "2", "-o", "x.ply", says="--top")

    def test_for_print(self):
        told = self.extracted("--object", "2", "--for-print", "-o", "print.stl")
        self.assertEqual((told["contours"], told["print"]["pieces"], told["print"]["specks"]), (1, 1, 0))
        self.assertIn("for printing: 1 piece", self.run_ok("extract", "demo.nrrd", "--object", "2", "--for-print", "-o", "print.stl").stdout)
        self.assertTrue(self.run_json("verify", "print.stl")["holds"])
        told = self.extracted("--tau", "0.5", "--for-print", "-o", "print.stl", volume="noise.nrrd")
        self.assertEqual(told["print"]["pieces"], told["contours"])
        self.assertIn("no unit", told["notes"][0])
        several = self.extracted("--object", "2", "5", "--for-print", "-o", "print.ply")
        self.assertEqual(several["print"]["pieces"], 2)
        for words in (["--boundary", "open"], ["--shell", "inner"]):
            self.run_error(2, "extract", "demo.nrrd", "--object", "2", "--for-print", *words, "-o", "x.stl", says="--for-print")

    def test_walls_for_print(self):
        thick = self.extracted("--object", "5", "--for-print", "-o", "print.stl")
        walls = thick["print"]["walls"]
        self.assertEqual((walls["limit"], walls["thin_part"], thick["warnings"]), (0.8, 0, [w for w in thick["warnings"] if "STL" in w]))
        self.assertLess(walls["min"], walls["median"])
        done = self.run_ok("extract", "demo.nrrd", "--object", "5", "--for-print", "--min-wall", "1000", "-o", "print.stl")
        self.assertIn("walls: ", done.stdout)
        self.assertIn("100 % of them under 1000 mm", done.stdout)
        self.assertIn("thinner than", done.stderr)
        several = self.extracted("--object", "4", "5", "--for-print", "--min-wall", "3", "-o", "print.ply")["print"]["walls"]
        alone = [self.extracted("--object", n, "--for-print", "-o", "print.ply")["print"]["walls"] for n in ("4", "5")]
        self.assertEqual(several["min"], min(one["min"] for one in alone))
        self.assertEqual(several["median"], min(one["median"] for one in alone))
        self.run_error(2, "extract", "demo.nrrd", "--object", "2", "--min-wall", "1", "-o", "x.stl", says="--min-wall")
        self.run_error(2, "extract", "demo.nrrd", "--object", "2", "--for-print", "--min-wall", "-1", "-o", "x.stl", says="--min-wall")

    # labels

    def test_labels_of_the_table(self):
        objects = self.table()
        for volume in ("demo.nrrd", "demo.atlas"):
            told = self.run_json("label", volume, "--top", "24", "-o", "l.nrrd")
            self.assert_schema(told, "label")
            self.assertEqual([s["label"] for s in told["segments"]], [o["number"] for o in objects])
            self.assertEqual([s["tau"] for s in told["segments"]], [o["best_tau"] for o in objects])
        by_number = {s["number"]: s for s in told["segments"]}
        inner = max(objects, key=lambda o: o["best_tau"])
        self.assertEqual(by_number[inner["number"]]["voxels"], inner["voxels"])
        outer = min(objects, key=lambda o: o["best_tau"])
        self.assertEqual(sum(s["voxels"] for s in told["segments"]), outer["voxels"])
        # What the file says: samples of at least N are the objects N, N + 1, ...
        self.assertEqual(self.run_json("info", "l.nrrd")["values"]["high"], len(objects))

    def test_labels_of_a_list(self):
        objects, cavity = self.table(), self.table("--cavities")[0]
        told = self.run_json("label", "demo.nrrd", "--object", "1", "5", "c1", "-o", "l.nii.gz")
        self.assert_schema(told, "label")
        self.assertEqual([(s["reference"], s["label"]) for s in told["segments"]], [("1", 1), ("5", 5), ("c1", len(objects) + 1)])
        self.assertEqual(told["segments"][2]["voxels"], cavity["voxels"])
        again = self.run_json("label", "demo.nrrd", "--object", "5", "5@170", "v0@0", "-o", "l.nrrd")
        self.assertEqual([s["label"] for s in again["segments"]], [5, len(objects) + 1, len(objects) + 2])
        text = self.run_ok("label", "demo.nrrd", "--object", "1", "5", "-o", "l.nrrd").stdout
        self.assertIn("object 5", text)
        for words in (["--top", "3", "--tau", "100"], ["--top", "3", "--zones"], ["--object", "1", "--cavities"], ["--object", "1", "--keep", "2"]):
            self.run_error(2, "label", "demo.nrrd", *words, "-o", "x.nrrd")
        self.run_error(6, "label", "demo.nrrd", "--object", "v0@250", "-o", "x.nrrd", says="v0 at 250")

    # names

    def test_a_name_is_a_reference_everywhere(self):
        for volume in ("demo.nrrd", "demo.atlas"):
            self.names_are_gone()
            told = self.run_json("name", volume, "2", "big ball")
            self.assert_schema(told, "name")
            self.assertEqual([(n["name"], n["reference"]) for n in told["names"]], [("big ball", "2")])
            self.run_ok("name", volume, "c1", "hole")
            self.assertEqual(self.run_json("objects", "demo.atlas")["objects"][1]["name"], "big ball")
            self.assertIn("big ball", self.run_ok("objects", volume).stdout)
            self.assertIn("hole", self.run_ok("objects", volume, "--both").stdout)
            told = self.extracted("--object", "big ball", "--object", "hole", "--object", "4", "-o", "all.glb", volume=volume)
            self.assertEqual([(s["name"], s["reference"]) for s in told["surfaces"]], [("big ball", "2"), ("hole", "c1"), (None, "4")])
            told = self.extracted("--object", "big ball", "--split", "-o", "part.stl", volume=volume)
            self.assertEqual(told["surfaces"][0]["output"], "part-2-big-ball.stl")
            told = self.run_json("label", volume, "--object", "big ball@60", "-o", "l.nrrd")
            self.assertEqual([(s["name"], s["tau"]) for s in told["segments"]], [("big ball", 60)])
            drawn = self.run_json("render", volume, "--object", "big ball", "--size", "32", "--samples", "1", "-o", "a.png")
            self.assertIn("big ball", drawn["objects"][0]["name"])

    def test_names_are_listed_moved_and_taken_away(self):
        self.run_ok("name", "demo.atlas", "2", "ball")
        error = self.run_error(2, "name", "demo.atlas", "3", "ball")
        table = self.table()
        for o in table[1:3]:
            self.assertIn(f"v{o['id']} at {o['best_tau']}"[:12], error["message"])
        self.run_ok("name", "demo.atlas", "2", "great ball")
        self.assertEqual([n["name"] for n in self.run_json("name", "demo.atlas")["names"]], ["great ball"])
        self.run_ok("name", "demo.atlas", "v0@1", "everything")
        self.assertEqual([n["number"] for n in self.run_json("name", "demo.atlas")["names"]], [2, None])
        self.run_error(6, "name", "demo.atlas", "--remove", "ball", says="great ball")
        self.run_error(6, "name", "demo.atlas", "--remove", "4", says="has no name")
        self.run_ok("name", "demo.atlas", "--remove", "great ball", "everything")
        self.assertFalse((self.folder / "demo.atlas.names.json").exists())
        for bad in ("2", "c1", "v3", "a@b", "a,b"):
            self.run_error(2, "name", "demo.atlas", "2", bad, says="name")
        self.run_error(2, "name", "demo.atlas", "2", says="name")

    def test_a_damaged_file_of_names(self):
        self.run_ok("name", "demo.atlas", "2", "ball")
        file = self.folder / "demo.atlas.names.json"
        self.assert_schema(json.loads(file.read_text()), "names")
        file.write_text(file.read_text()[:-9])
        self.assertIn("names are not used", self.run_ok("objects", "demo.atlas").stderr)
        self.run_error(3, "extract", "demo.atlas", "--object", "ball", "-o", "x.ply", says="names.json")
        self.run_error(3, "name", "demo.atlas", "3", "ring", says="names.json")
        self.run_ok("extract", "demo.atlas", "--object", "2", "-o", "a.ply")


if __name__ == "__main__":
    harness.main()
