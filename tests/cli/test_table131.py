"""Table 13.1, and what --gaussian and --box do to a volume."""
import harness


class Table131(harness.CliTest):
    phantoms = {"figure.nrrd": ["figure-plateau"], "noise.nrrd": ["noise", "--size", "12", "--quantise", "64"], "one.npy": ["noise", "--size", "1"]}

    def test_the_figure(self):
        table = self.run_json("table131", "figure.nrrd", "--box", "2:22,2:22,2:22")
        self.assert_schema(table, "table131")
        self.assertEqual((table["cells"], table["zones"], table["isovalues"]), (19 ** 3, 14, 14))
        self.assertEqual(table["volume"]["dims"], [20, 20, 20])
        self.assertEqual(table["volume"]["origin"], [2, 2, 2])
        for way in ("zone_files", "bricks"):
            for most in ("max", "average", "min"):
                self.assertLessEqual(table["active_cells"][most], table[way]["cells_visited"][most])
                self.assertLessEqual(table[way]["cells_visited"][most], table[way]["cells_loaded"][most])
        text = self.run_ok("table131", "figure.nrrd", "--box", "2:22,2:22,2:22").stdout
        for words in ("points in a zone", "load utility", "travel utility", "zone files", "bricks", "6,859 cells, 14 zones, 14 isovalues"):
            self.assertIn(words, text)

    def test_the_same_numbers_for_any_threads_and_from_a_store(self):
        one = self.run_json("table131", "noise.nrrd", "--threads", "1")
        self.assertEqual(one, self.run_json("table131", "noise.nrrd", "--threads", "3"))
        self.run_ok("build", "noise.nrrd", "-o", "noise.atlas")
        store = self.run_json("table131", "noise.atlas")
        for name in ("cells", "zones", "isovalues", "zone_points", "active_cells", "zone_files", "bricks"):
            self.assertEqual(one[name], store[name], name)

    def test_a_volume_without_cells(self):
        table = self.run_json("table131", "one.npy")
        self.assert_schema(table, "table131")
        self.assertEqual((table["cells"], table["isovalues"]), (0, 0))
        self.assertIn("0 cells", self.run_ok("table131", "one.npy").stdout)

    def test_gaussian_is_part_of_what_a_store_says(self):
        self.run_ok("build", "noise.nrrd", "-o", "smooth.atlas", "--gaussian", "1.5")
        for verb in ("info", "objects"):
            self.assertEqual(self.run_json(verb, "smooth.atlas")["volume"]["gaussian"], 1.5)
            self.assertIsNone(self.run_json(verb, "noise.nrrd")["volume"]["gaussian"])
        self.assertEqual(self.run_json("table131", "smooth.atlas")["zones"],
                         self.run_json("table131", "noise.nrrd", "--gaussian", "1.5")["zones"])
        self.assertLess(self.run_json("table131", "smooth.atlas")["zones"], self.run_json("table131", "noise.nrrd")["zones"])

    def test_errors(self):
        self.run_error(2, "table131", "noise.nrrd", "--gaussian", "0", says="--gaussian")
        self.run_error(2, "table131", "noise.nrrd", "--gaussian", "1e9", says="sigma", next_says="spacing")
        self.run_error(2, "table131", "noise.nrrd", "--box", "0:13,0:1,0:1", says="0:13")
        for box in ("0:1", "1,2,3", "3:3,0:1,0:1", "a:b,0:1,0:1"):
            self.run_error(2, "table131", "noise.nrrd", "--box", box, says="--box")
        self.run_error(2, "build", "noise.nrrd", "-o", "x.atlas", "--gaussian", "-1", says="--gaussian")
        self.run_error(2, "build", "noise.nrrd", "-o", "x.atlas", "--gaussian", "1e9", says="sigma", next_says="spacing")
        self.assertFalse((self.folder / "x.atlas.build").exists())
        self.assert_no_partial()


if __name__ == "__main__":
    harness.main()
