"""The tunnels of a volume and the isovalues between which they are open."""
import harness


class Handles(harness.CliTest):
    phantoms = {"figure.nrrd": ["figure-plateau"], "noise.nrrd": ["noise", "--size", "12"], "flat.npy": ["noise", "--size", "1"]}

    def test_the_figure(self):
        document = self.run_json("handles", "figure.nrrd")
        self.assert_schema(document, "handles")
        self.assertEqual(document["pairs"], "approximate")
        self.assertEqual([(h["opens"], h["closes"]) for h in document["handles"]], [(38, 30), (58, 56), (48, 46)])
        text = self.run_ok("handles", "figure.nrrd")
        self.assertIn("approximate", text.stderr)
        self.assertIn("58", text.stdout)

    def test_choices_stores_and_edges(self):
        self.assertEqual(len(self.run_json("handles", "noise.nrrd", "--top", "5")["handles"]), 5)
        long = self.run_json("handles", "noise.nrrd", "--persistence", "50%", "--top", "100000")
        self.assertEqual(long["tunnels"], len(long["handles"]))
        self.assertTrue(all(h["opens"] - h["closes"] >= 0.4 for h in long["handles"]))
        self.run_ok("build", "noise.nrrd", "-o", "noise.atlas")
        self.assertEqual(self.run_json("handles", "noise.atlas")["handles"], self.run_json("handles", "noise.nrrd")["handles"])
        self.assertEqual(self.run_json("handles", "flat.npy")["handles"], [])
        self.run_error(2, "handles", "noise.nrrd", "--persistence", "x", says="--persistence")
        self.run_error(2, "handles", "noise.nrrd", "--top", "5%", says="--top")

    def test_exact_pairs(self):
        document = self.run_json("handles", "figure.nrrd", "--exact")
        self.assert_schema(document, "handles")
        self.assertEqual(document["pairs"], "exact")
        self.assertEqual([(h["opens"], h["closes"]) for h in document["handles"]], [(38, 30), (58, 56), (48, 46)])
        self.assertIn("exact", self.run_ok("handles", "figure.nrrd", "--exact").stderr)
        quick, exact = (self.run_json("handles", "noise.nrrd", "--top", "100000", *more)["handles"] for more in ([], ["--exact"]))
        self.assertNotEqual(quick, exact)
        total = [sum(h["opens"] - h["closes"] for h in handles) for handles in (quick, exact)]
        self.assertAlmostEqual(total[0], total[1])
        self.run_ok("build", "noise.nrrd", "-o", "exact.atlas")
        self.assertEqual(self.run_json("handles", "exact.atlas", "--exact", "--top", "100000")["handles"], exact)
        self.assertEqual(self.run_json("handles", "flat.npy", "--exact")["handles"], [])

    def test_exact_pairs_of_one_object(self):
        ids = {o["appears"]: f"v{o['id']}" for o in self.run_json("objects", "figure.nrrd", "--all")["objects"]}
        document = self.run_json("handles", "figure.nrrd", "--exact", "--object", ids[80])
        self.assert_schema(document, "handles")
        self.assertEqual([(h["opens"], h["closes"]) for h in document["handles"]], [(48, 46)])
        self.run_error(6, "handles", "figure.nrrd", "--exact", "--object", "v0", says="isoatlas objects")
        self.run_error(2, "handles", "figure.nrrd", "--object", "0", says="--exact")
        self.run_error(2, "handles", "figure.nrrd", "--exact", "--object", "0", "--object", "1", says="once")


if __name__ == "__main__":
    harness.main()
