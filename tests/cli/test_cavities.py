"""Dark objects: the table, their walls, their labels."""
import gzip

import harness


class Dark(harness.CliTest):
    phantoms = {"figure.nrrd": ["figure-plateau"], "noise.nrrd": ["noise", "--size", "12", "--quantise", "64"], "one.npy": ["noise", "--size", "1"]}

    def test_the_cavity_of_the_figure(self):
        table = self.run_json("objects", "figure.nrrd", "--cavities")
        self.assert_schema(table, "cavities")
        self.assertEqual([(o["appears"], o["merges"], o["tunnels"], o["islands"]) for o in table["objects"]], [(20, 30, 0, 0)])
        cavity = table["objects"][0]
        self.assertTrue(20 < cavity["best_tau"] <= 30)
        at = self.run_json("objects", "figure.nrrd", "--tau", str(cavity["best_tau"]))
        walls = [c["id"] for o in at["objects"] for c in o["contours"] if c["shell"] == "inner" and o["id"] == cavity["object"]]
        self.assertEqual(walls, [cavity["id"]])
        self.run_ok("extract", "figure.nrrd", "--tau", str(cavity["best_tau"]), "--contour", f"v{cavity['id']}", "-o", "wall.ply")
        label = self.run_json("label", "figure.nrrd", "--tau", str(cavity["best_tau"]), "--cavities", "-o", "cavity.nii.gz")
        self.assertEqual((label["labels"], label["labels_are"]), (1, "cavities"))
        self.assertEqual(gzip.decompress((self.folder / "cavity.nii.gz").read_bytes())[352:].count(1), cavity["voxels"])

    def test_the_figure_with_noise(self):
        """Exactly the objects of figure 12.1, cavities too, when 2 % noise makes thousands."""
        self.run_ok("phantom", "figure-plateau", "--noise", "0.02", "-o", "noisy.nrrd")
        table = self.run_json("objects", "noisy.nrrd", "--both")
        self.assertGreater(table["branches"], 1000)
        self.assertEqual({o["merges"] and round(o["merges"], -1) for o in table["objects"]}, {None, 40, 50, 60})
        self.assertEqual(table["branches"] - table["hidden"], 4)
        self.assertEqual([round(o["merges"], -1) for o in table["cavities"]], [30])

    def test_both(self):
        both = self.run_json("objects", "figure.nrrd", "--both")
        self.assert_schema(both, "objects")
        self.assertEqual(both["objects"], self.run_json("objects", "figure.nrrd")["objects"])
        self.assertEqual(both["cavities"], self.run_json("objects", "figure.nrrd", "--cavities")["objects"])
        text = self.run_ok("objects", "figure.nrrd", "--both").stdout
        self.assertIn("cavities", text)
        self.assertIn("islands", text)

    def test_the_same_from_a_store_and_for_any_threads(self):
        one = self.run_json("objects", "noise.nrrd", "--cavities", "--all", "--threads", "1")
        self.assertGreater(len(one["objects"]), 5)
        self.run_ok("build", "noise.nrrd", "-o", "noise.atlas")
        for words in (["noise.nrrd", "--threads", "3"], ["noise.atlas"]):
            self.assertEqual(one["objects"], self.run_json("objects", words[0], "--cavities", "--all", *words[1:])["objects"])

    def test_every_isovalue_has_a_wall(self):
        table = self.run_json("objects", "noise.nrrd", "--cavities", "--all")
        for entry in table["objects"][:5]:
            self.assertEqual(entry["isovalues"][0]["tau"], entry["best_tau"])
            for isovalue in entry["isovalues"]:
                self.run_ok("extract", "noise.nrrd", "--tau", repr(isovalue["tau"]), "--contour", f"v{isovalue['cavity']}", "-o", "wall.ply")

    def test_no_cavities_and_errors(self):
        self.assertEqual(self.run_json("objects", "one.npy", "--cavities")["objects"], [])
        self.assertIn("no significant cavities", self.run_ok("objects", "one.npy", "--cavities").stderr)
        self.run_error(2, "objects", "noise.nrrd", "--cavities", "--both", says="--both")
        self.run_error(2, "objects", "noise.nrrd", "--cavities", "--tau", "5", says="--tau")
        self.run_error(2, "label", "noise.nrrd", "--cavities", "--zones", "-o", "x.nrrd", says="--cavities")
        self.assert_no_partial()


if __name__ == "__main__":
    harness.main()
