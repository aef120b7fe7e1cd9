"""The search methods of the literature, side by side on one volume."""
import harness


class Compare(harness.CliTest):
    phantoms = {"noise.nrrd": ["noise", "--size", "14", "--quantise", "64"], "one.npy": ["noise", "--size", "1"]}

    def test_every_method_finds_the_same_cells(self):
        for tau in ("20", "31.5", "32"):
            found = self.run_json("compare", "noise.nrrd", "--tau", tau)
            self.assertEqual(found["cells"], 13 ** 3)
            self.assertEqual(found["searches"][0]["name"], "brute-force")
            self.assertEqual(found["searches"][0]["cells"], found["cells"])
            for method in found["searches"]:
                self.assertGreaterEqual(method["cells"], found["active_cells"], method["name"])
            holes = {surface["name"]: surface["hole_edges"] for surface in found["surfaces"]}
            self.assertGreater(holes.pop("marching-cubes"), 0)
            self.assertGreater(holes.pop("connected-contours"), 0)
            self.assertEqual(set(holes.values()) if tau == "31.5" else {0}, {0})
        text = self.run_ok("compare", "noise.nrrd", "--tau", "32").stdout
        for words in ("Brute force", "Branch-on-need octree", "Kd-tree of the span space", "Six tetrahedra a cell", "edges of holes", "every method finds them all"):
            self.assertIn(words, text)

    def test_a_part_of_it_low_values_and_a_store(self):
        self.run_ok("build", "noise.nrrd", "-o", "noise.atlas")
        volume = self.run_json("compare", "noise.nrrd", "--tau", "32", "--box", "1:9,0:5,2:6")
        self.assertEqual(volume["cells"], 7 * 4 * 3)
        self.assertEqual(self.run_json("compare", "noise.atlas", "--tau", "32")["active_cells"],
                         self.run_json("compare", "noise.nrrd", "--tau", "32")["active_cells"])
        self.assertEqual(self.run_json("compare", "noise.nrrd", "--tau", "31.5", "--polarity", "low")["active_cells"],
                         self.run_json("compare", "noise.nrrd", "--tau", "31.5")["active_cells"])

    def test_errors(self):
        self.run_error(2, "compare", "noise.nrrd", says="which isovalue", next_says="isoatlas objects")
        self.run_error(2, "compare", "noise.nrrd", "--tau", "x", says="--tau")
        self.run_error(3, "compare", "none.nrrd", "--tau", "1", says="none.nrrd")


if __name__ == "__main__":
    harness.main()
