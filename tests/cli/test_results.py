"""What every verb prints and writes, on volumes whose topology is known."""
import json
import math
import re
import struct

from harness import MESHES, CliTest, main


class Results(CliTest):
    phantoms = {
        "shells.nrrd": ["nested-shells", "--size", "32", "--shells", "2"],
        "chain.nrrd": ["torus-chain", "--size", "32", "--genus", "3"],
        "figure.nrrd": ["figure-plateau"],
        "noise.nrrd": ["noise", "--size", "10"],
    }

    # phantom

    def test_phantom_list_names_what_can_be_made(self):
        names = [phantom["name"] for phantom in self.run_json("phantom", "--list")["phantoms"]]
        self.assertIn("torus-chain", names)
        text = self.run_ok("phantom", "--list").stdout
        for name in names:
            self.assertRegex(text, rf"(?m)^{name} ")

    def test_phantom_is_written_in_every_format_and_read_back(self):
        for name in ("p.nrrd", "p.npy", "p.raw", "p.mha", "p.nii"):
            made = self.run_json("phantom", "gyroid", "--size", "8", "-o", name)
            self.assertEqual(made["output"], name)
            info = self.run_json("info", name)
            self.assertEqual(info["volume"]["dims"], [8, 8, 8], name)
            self.assertAlmostEqual(info["values"]["high"], made["values"]["high"])

    # info

    def test_info(self):
        info = self.run_json("info", "figure.nrrd")
        self.assertEqual(info["schema"], "isoatlas/info/2")
        self.assertEqual(info["volume"]["dims"], [24, 24, 24])
        self.assertEqual(info["volume"]["type"], "uint8")
        self.assertEqual(info["voxels"], 24 ** 3)
        self.assertEqual((info["values"]["low"], info["values"]["high"]), (0, 100))
        low, high = (info["estimate"]["memory_bytes"][data] for data in ("smooth", "noise"))
        self.assertGreaterEqual(low, 24 ** 3 * 13)
        self.assertLess(low, high)
        text = self.run_ok("info", "figure.nrrd")
        for words in ("NRRD", "24 x 24 x 24", "uint8", "0 .. 100", "less than a second", "13,824 voxels"):
            self.assertIn(words, text.stdout)
        self.assertIn("next: isoatlas objects figure.nrrd", text.stderr)

    def test_info_reports_missing_samples_and_analysis_needs_a_policy(self):
        values = [0.0] * 27
        values[4], values[9], values[13] = math.nan, math.inf, 5.0
        (self.folder / "holes_3x3x3_float32.raw").write_bytes(struct.pack("<27f", *values))
        info = self.run_json("info", "holes_3x3x3_float32.raw")
        self.assertEqual((info["missing_samples"], info["values"]["high"]), (2, 5))
        self.run_error(3, "objects", "holes_3x3x3_float32.raw", next_says="--missing")
        for policy in ("below", "-1"):
            at = self.run_json("objects", "holes_3x3x3_float32.raw", "--missing", policy, "--tau", "5")
            self.assertEqual([o["id"] for o in at["objects"]], [13])

    # objects

    def test_objects_at_tau_have_the_known_topology(self):
        at = self.run_json("objects", "shells.nrrd", "--tau", "0.5")
        self.assertEqual((at["schema"], at["interpolant"], at["boundary"]), ("isoatlas/objects/2", "trilinear", "closed"))
        self.assertEqual([(o["chi"], o["b1"], o["b2"]) for o in at["objects"]], [(2, 0, 1)] * 2)
        for o in at["objects"]:
            self.assertEqual([(c["genus"], c["shell"]) for c in o["contours"]], [(0, "outer"), (0, "inner")])
            self.assertEqual(o["contours"][0]["id"], o["id"])
            self.assertGreater(o["measure"], 0)
            self.assertTrue(all(low <= high for low, high in zip(o["box"]["low"], o["box"]["high"])))
        self.assertEqual([o["voxels"] for o in at["objects"]], sorted((o["voxels"] for o in at["objects"]), reverse=True))
        chain = self.run_json("objects", "chain.nrrd", "--tau", "0.5")["objects"]
        self.assertEqual([(o["chi"], o["b1"], o["b2"], [c["genus"] for c in o["contours"]]) for o in chain], [(-2, 3, 0, [3])])

    def test_objects_at_tau_text(self):
        done = self.run_ok("objects", "shells.nrrd", "--tau", "0.5")
        head, *rows = done.stdout.splitlines()
        for title in ("id", "voxels", "tunnels", "cavities", "contours", "box"):
            self.assertIn(title, head)
        self.assertEqual(len(rows), 2)
        self.assertIn("2 objects with 4 contours at 0.5", done.stderr)
        self.assertIn("and 1 more", self.run_ok("objects", "shells.nrrd", "--tau", "0.5", "--top", "1").stderr)

    def test_objects_table(self):
        table = self.run_json("objects", "figure.nrrd", "--all")
        self.assertIsNone(table["tau"])
        self.assertEqual(table["branches"], 4)
        self.assertGreaterEqual(len(table["objects"]), 4)
        for entry in table["objects"]:
            keys = {"id", "number", "reference", "name", "event", "appears", "merges", "best_tau", "chi", "b1", "b2", "tunnels", "cavities",
                    "voxels", "measure", "hypervolume", "position", "position_physical", "note", "reason", "isovalues", "like"}
            self.assertEqual(set(entry), keys)
            at = self.run_json("objects", "figure.nrrd", "--tau", entry["best_tau"])["objects"]
            found = [o for o in at if o["id"] == entry["id"]]
            self.assertEqual(len(found), 1, "the id of the table is an object at its best isovalue")
            self.assertEqual((found[0]["b1"], found[0]["b2"], found[0]["voxels"]), (entry["tunnels"], entry["cavities"], entry["voxels"]))
        text = self.run_ok("objects", "figure.nrrd", "--all").stdout.splitlines()
        self.assertEqual(len(text), 1 + len(table["objects"]))
        for title in ("id", "appears", "merges", "best tau", "voxels", "tunnels", "cavities", "note"):
            self.assertIn(title, text[0])
        self.assertEqual(len(self.run_json("objects", "figure.nrrd", "--top", "2", "--all")["objects"]), 2)

    # tree

    def test_tree_of_the_dissertations_figure_has_14_events(self):
        tree = json.loads(self.run_ok("tree", "figure.nrrd", "--json").stdout)
        self.assertEqual(tree["schema"], "isoatlas/tree/2")
        events = [dict(zip(tree["columns"], row)) for row in tree["events"]]
        self.assertEqual([e["value"] for e in events], [100, 90, 80, 70, 60, 58, 56, 50, 48, 46, 40, 38, 30, 20])
        keys = {"value", "x", "y", "z", "kind", "parent", "lows_out", "b1", "b2", "zone_voxels", "object_voxels"}
        for event in events:
            self.assertEqual(keys, set(event))
        whole = json.loads(self.run_ok("tree", "figure.nrrd", "--json", "--all").stdout)
        self.assert_schema(whole, "tree-events")
        self.assertEqual(whole["columns"][11:], ["id", "children", "tau_low", "delta_chi", "chi", "contours", "genera"])
        self.assertEqual([row[:11] for row in whole["events"]], tree["events"])

    def test_tree_details_and_files(self):
        for detail in ("events", "levels", "elements", "contours"):
            document = json.loads(self.run_ok("tree", "figure.nrrd", "--detail", detail, "--json").stdout)
            self.assertGreater(len(document[detail]), 0)
            self.assertIn("14 events", self.run_ok("tree", "figure.nrrd", "--detail", detail).stdout)
        for name in ("t.json", "t.graphml", "t.csv", "t.vtu"):
            told = self.run_json("tree", "figure.nrrd", "-o", name)
            self.assertEqual((told["output"], told["events"]), (name, 14))
            self.assertGreater((self.folder / name).stat().st_size, 100)
        self.assertEqual(json.loads((self.folder / "t.json").read_text())["events"],
                         json.loads(self.run_ok("tree", "figure.nrrd", "--json").stdout)["events"])

    def test_tree_summary(self):
        done = self.run_ok("tree", "figure.nrrd")
        self.assertRegex(done.stdout, r"(?m)^maximum +4$")
        self.assertRegex(done.stdout, r"(?m)^merge +3$")
        self.assertIn("zones with most voxels", done.stdout)
        self.assertIn("next: isoatlas", done.stderr)

    # extract

    def test_extract_writes_every_format_and_each_verifies(self):
        for extension in MESHES:
            told = self.run_json("extract", "chain.nrrd", "--tau", "0.5", "-o", "chain" + extension)
            self.assertEqual((told["objects"], told["contours"], told["closed"]), (1, 1, True))
            verified = self.run_json("verify", "chain" + extension)
            self.assertTrue(verified["holds"])
            self.assertEqual(verified["triangles"], told["triangles"])
            self.assertIn("genus 3 in all", [c["detail"] for c in verified["checks"] if c["name"] == "euler_numbers_are_even"][0])

    def test_extract_chooses_objects_contours_shells(self):
        objects = self.run_json("objects", "shells.nrrd", "--tau", "0.5")["objects"]
        everything = self.run_json("extract", "shells.nrrd", "--tau", "0.5", "-o", "s.ply")
        self.assertEqual((everything["objects"], everything["contours"]), (2, 4))
        one = self.run_json("extract", "shells.nrrd", "--tau", "0.5", "--object", f"v{objects[1]['id']}", "-o", "s.ply")
        self.assertEqual((one["objects"], one["contours"]), (1, 2))
        both = self.run_json("extract", "shells.nrrd", "--tau", "0.5", "--object", f"v{objects[0]['id']}", f"v{objects[1]['id']}", "-o", "s.ply")
        self.assertEqual(both["triangles"], everything["triangles"])
        wall = self.run_json("extract", "shells.nrrd", "--tau", "0.5", "--contour", f"v{objects[0]['contours'][1]['id']}", "-o", "s.ply")
        self.assertEqual(wall["contours"], 1)
        outer = self.run_json("extract", "shells.nrrd", "--tau", "0.5", "--shell", "outer", "-o", "s.ply")
        inner = self.run_json("extract", "shells.nrrd", "--tau", "0.5", "--shell", "inner", "-o", "s.ply")
        self.assertEqual((outer["contours"], inner["contours"]), (2, 2))
        self.assertEqual(outer["triangles"] + inner["triangles"], everything["triangles"])
        full = self.run_json("extract", "shells.nrrd", "--tau", "0.5", "--style", "full", "-o", "s.ply")
        self.assertGreater(full["triangles"], everything["triangles"])
        self.assertTrue(self.run_json("verify", "s.ply")["holds"])

    def test_extract_open_boundary(self):
        told = self.run_json("extract", "noise.nrrd", "--tau", "0.5", "--boundary", "open", "-o", "open.ply")
        self.assertEqual((told["closed"], told["boundary"]), (False, "open"))
        self.assertIn("open at the border", self.run_ok("extract", "noise.nrrd", "--tau", "0.5", "--boundary", "open", "-o", "open.ply").stdout)

    def test_extract_best(self):
        best = self.run_json("objects", "figure.nrrd")["objects"][0]
        for choice in (["--best"], ["--object", "1"]):
            told = self.run_json("extract", "figure.nrrd", *choice, "-o", "best.ply")
            self.assertEqual((told["tau"], told["objects"]), (best["best_tau"], 1))

    def test_the_printed_next_commands_run(self):
        for arguments in (["objects", "figure.nrrd"], ["objects", "chain.nrrd", "--tau", "0.5"], ["tree", "figure.nrrd"], ["info", "noise.nrrd"]):
            commands = re.findall(r"(?m)^next: isoatlas ([^#\n]*)", self.run_ok(*arguments).stderr)
            self.assertGreater(len(commands), 0)
            for command in commands:
                self.run_ok(*command.split())

    # label

    def test_labels_count_the_voxels_of_objects_and_zones(self):
        objects = self.run_json("objects", "shells.nrrd", "--tau", "0.5")["objects"]
        for name in ("l.nrrd", "l.nii", "l.nii.gz", "l.tif"):
            told = self.run_json("label", "shells.nrrd", "--tau", "0.5", "-o", name)
            self.assertEqual((told["labels"], told["labels_are"]), (2, "objects"))
            info = self.run_json("info", name)
            self.assertEqual((info["volume"]["dims"], info["volume"]["type"], info["values"]["high"]), ([32, 32, 32], "uint8", 2))
        # Label 2 is the second object: it is alone at 2.
        alone = self.run_json("objects", "l.nrrd", "--tau", "2")["objects"]
        self.assertEqual(sum(o["voxels"] for o in alone), objects[1]["voxels"])
        told = self.run_json("label", "figure.nrrd", "--zones", "-o", "z.nrrd")
        self.assertEqual((told["labels"], told["labels_are"]), (14, "zones"))
        self.assertEqual(self.run_json("info", "z.nrrd")["values"]["high"], 14)

    # verify

    def test_verify_volume(self):
        for name in ("shells.nrrd", "chain.nrrd", "figure.nrrd", "noise.nrrd"):
            verified = self.run_json("verify", name, "--levels", "6")
            self.assertTrue(verified["holds"], verified)
            names = [check["name"] for check in verified["checks"]]
            for check in ("join_tree_is_valid", "zones_partition_voxels", "euler_sums_hold", "contour_tree_is_a_tree", "levels_match_events",
                          "tree_equals_cut", "cut_equals_mesh", "surface_is_closed", "surface_is_manifold", "surface_is_oriented",
                          "surface_has_no_zero_area"):
                self.assertIn(check, names)
        self.assertRegex(self.run_ok("verify", "figure.nrrd").stdout, r"(?m)^holds  tree_equals_cut ")

    def test_trilinear(self):
        elements = {}
        for name, more in {"faces": [], "trilinear": [], "low": ["--tunnel-height", "1%"], "none": ["--tunnel-height", "100%"]}.items():
            interpolant = "faces" if name == "faces" else "trilinear"
            tree = self.run_json("tree", "noise.nrrd", "--detail", "elements", "--interpolant", interpolant, *more)
            self.assertEqual(tree["interpolant"], interpolant)
            self.assertEqual("tunnel_height" in tree, interpolant == "trilinear")
            elements[name] = [tuple(e["position"]) for e in tree["elements"]]
            bodies = [p for p in elements[name] if all(x % 1 == 0.5 for x in p)]
            self.assertEqual(len(bodies) > 0, name in ("trilinear", "low"))
        self.assertGreater(len(elements["trilinear"]), len(elements["low"]))
        self.assertEqual(elements["none"], elements["faces"])
        verified = self.run_json("verify", "noise.nrrd", "--interpolant", "trilinear")
        self.assertTrue(verified["holds"], verified)
        told = self.run_json("extract", "noise.nrrd", "--tau", "0.5", "--interpolant", "trilinear", "-o", "tunnels.ply")
        self.assertEqual(told["interpolant"], "trilinear")
        self.run_ok("verify", "tunnels.ply")

    def test_every_document_file_and_text_says_the_interpolant(self):
        tau = ["--tau", "0.5"]
        runs = [["objects", "noise.nrrd"], ["objects", "noise.nrrd", *tau], ["tree", "noise.nrrd"], ["verify", "noise.nrrd", "--levels", "2"]]
        runs += [["extract", "noise.nrrd", *tau, "-o", "i" + extension] for extension in MESHES]
        runs += [["tree", "noise.nrrd", "-o", "i" + extension] for extension in (".json", ".graphml", ".csv", ".vtu")]
        runs += [["label", "noise.nrrd", what, *value, "-o", "i" + extension] for extension in (".nrrd", ".nii", ".tif")
                 for what, *value in (tau, ["--zones"])]
        for name, more in (("faces", []), ("trilinear", []), ("trilinear", ["--tunnel-height", "0.25"])):
            codes = " ".join(str(ord(letter)) for letter in name)   # how VTK writes a text
            for run in runs:
                arguments = [*run, "--interpolant", name, *more]
                document = self.run_json(*arguments)
                self.assertEqual(document["interpolant"], name, arguments)
                self.assertEqual(document.get("tunnel_height"), None if name == "faces" else 0.25 if more else 0, arguments)
                done = self.run_ok(*arguments)
                self.assertRegex(done.stdout + done.stderr, f"interpolant {name}" + (", tunnel height 0.25" if more else "") + "\n")
                if "-o" in run:
                    head = (self.folder / run[-1]).read_bytes().decode("latin-1")
                    self.assertIn(codes if run[-1] in ("i.vtp", "i.vtu") else name, head, arguments)
                    if more:
                        self.assertRegex(head, "(tunnel.height\\W*|TunnelHeight|,trilinear,)" + ("" if codes in head else "0.25"), arguments)

    def test_verify_finds_a_hole(self):
        self.run_ok("extract", "chain.nrrd", "--tau", "0.5", "-o", "whole.obj")
        lines = (self.folder / "whole.obj").read_text().splitlines()
        faces = [i for i, line in enumerate(lines) if line.startswith("f ")]
        del lines[faces[len(faces) // 2]]
        (self.folder / "hole.obj").write_text("\n".join(lines) + "\n")
        verified = self.run_json("verify", "hole.obj", code=7)
        self.assertFalse(verified["holds"])
        self.assertIn("surface_is_closed", [check["name"] for check in verified["checks"] if not check["holds"]])
        done = self.start(["verify", "hole.obj"])
        self.assertEqual(done.returncode, 7)
        self.assertRegex(done.stdout, r"(?m)^FAILS  surface_is_closed +3 open edges")

    def test_threads_change_nothing(self):
        one = self.run_ok("tree", "noise.nrrd", "--json", "--threads", "1").stdout
        self.assertEqual(one, self.run_ok("tree", "noise.nrrd", "--json", "--threads", "3").stdout)
        self.run_ok("extract", "noise.nrrd", "--tau", "0.5", "--threads", "1", "-o", "a.ply")
        self.run_ok("extract", "noise.nrrd", "--tau", "0.5", "--threads", "3", "-o", "b.ply")
        self.assertEqual((self.folder / "a.ply").read_bytes(), (self.folder / "b.ply").read_bytes())


if __name__ == "__main__":
    main()
